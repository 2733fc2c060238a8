"""Opens reports in Chromium: what the console says, and what reaches out of the window."""
from __future__ import annotations

import html
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
WIDTHS_PX = (390, 1280)

MEASURE = """<script>addEventListener("load", () => {
  const page = document.documentElement, wide = [];
  for (const element of document.querySelectorAll("main *"))
    if (!element.closest(".sideways, svg") && element.getBoundingClientRect().right > page.clientWidth + 0.5)
      wide.push(element.tagName + "." + element.className);
  const unseen = [...document.images].filter(image => image.loading != "lazy" && !image.naturalWidth).length;
  parent.postMessage(JSON.stringify({clientWidth: page.clientWidth, scrollWidth: page.scrollWidth, wide, unseen}), "*"); });
</script>"""
FRAME = """<!DOCTYPE html><title>frame</title><body style="margin:0"><pre id="found"></pre>
<script>addEventListener("message", event => document.getElementById("found").textContent = event.data);</script>
<iframe src="%s" style="width:%dpx;height:3000px;border:0"></iframe>"""


@unittest.skipUnless(BROWSER, "no Chromium was found")
class BrowserTestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def browse(self, page, *options):
        command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--enable-logging=stderr",
                   "--v=0", f"--user-data-dir={self.folder / 'profile'}", "--virtual-time-budget=5000", *options, page.as_uri()]
        return subprocess.run(command, capture_output=True, text=True, timeout=120, check=True,
                              env={**os.environ, "HOME": str(self.folder)})

    def console(self, page):
        """What the page has to say on the console."""
        return re.findall(r"CONSOLE.*", self.browse(page, "--dump-dom").stderr)

    def measured(self, page, width_px):
        """Widths of the page in a window of that width, and what reaches out of it."""
        copy, frame = page.with_name("copy.html"), page.with_name("frame.html")
        copy.write_text(page.read_text(encoding="utf-8") + MEASURE, encoding="utf-8")
        frame.write_text(FRAME % (copy.name, width_px), encoding="utf-8")
        document = self.browse(frame, "--dump-dom", "--window-size=1400,3200").stdout
        return json.loads(html.unescape(re.search(r'<pre id="found">([^<]*)</pre>', document).group(1)))

    def check(self, page, what):
        """No error on the console, no sideways scrolling on a phone or a desk."""
        with self.subTest(what):
            self.assertEqual(self.console(page), [])
        for width in WIDTHS_PX:
            with self.subTest(what, width=width):
                self.assertEqual(self.measured(page, width),
                                 {"clientWidth": width, "scrollWidth": width, "wide": [], "unseen": 0})
