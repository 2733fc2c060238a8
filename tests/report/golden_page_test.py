"""The report of golden pictures, as a browser shows it: on a phone and a desk, and after its folder was moved.

    golden_page_test.py BINARY
"""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import unittest

from browser import BrowserTestCase

BINARY = os.path.abspath(sys.argv.pop(1))
SMALL = ["--size", "120x90", "--frames", "1", "--gl", "off"]


class GoldenPageTest(BrowserTestCase):
    def golden(self, action, *arguments):
        return subprocess.run([BINARY, "golden", action, "--list", "list.json", *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=120).returncode

    def test_in_a_browser(self):
        cases = [{"name": name, "scene": "scene:spheres,triangles=500", "options": SMALL, "reason": "long" * 40}
                 for name in ("fine", "wrong & <odd>")]
        list_file = self.folder / "list.json"
        list_file.write_text(json.dumps({"cases": cases}), encoding="utf-8")
        self.assertEqual(self.golden("update"), 0)
        cases[1]["options"] = [*SMALL, "--light", "1,0.2,0"]
        cases.append(dict(cases[0], name="gone", scene="gone.obj"))
        list_file.write_text(json.dumps({"cases": cases}), encoding="utf-8")
        self.assertEqual(self.golden("check", "-o", "report"), 3)
        shutil.move(self.folder / "report", self.folder / "elsewhere")
        for picture in self.folder.glob("*.png"):
            picture.unlink()
        page = self.folder / "elsewhere" / "report.html"
        self.check(page, "page")
        shown = self.browse(page, "--dump-dom").stdout
        self.assertLess(shown.index("wrong &amp; &lt;odd&gt; <small>failed"), shown.index("fine <small>passed"))
        self.assertEqual(shown.count('type="range"'), 1)


if __name__ == "__main__":
    unittest.main()
