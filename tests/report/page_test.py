"""Opens made-up reports in Chromium."""
from __future__ import annotations

import subprocess
import sys
import unittest

from browser import BrowserTestCase
from make_sweep import PRESETS, make_sweep
from report_case import REPORT, needs_matplotlib


class PageTest(BrowserTestCase):
    @needs_matplotlib
    def test_reports(self):
        for preset in ("pareto", "many", "paper", "growth", "long"):
            folder = self.folder / preset
            make_sweep(folder, PRESETS[preset])
            subprocess.run([sys.executable, str(REPORT), str(folder)], check=True, capture_output=True)
            self.check(folder / "report.html", preset)

    def test_that_faults_are_seen(self):
        page = self.folder / "faulty.html"
        page.write_text('<!DOCTYPE html><main><div class="broad" style="width:500px">a</div></main><script>unknown();</script>')
        self.assertIn("unknown is not defined", " ".join(self.console(page)))
        found = self.measured(page, 390)
        self.assertGreater(found["scrollWidth"], 390)
        self.assertEqual(found["wide"], ["DIV.broad"])


if __name__ == "__main__":
    unittest.main()
