"""A small sweep of the real binary from end to end: rows, charts, and a page that a browser opens.

    real_sweep_test.py BINARY
"""
from __future__ import annotations

import csv
import os
import statistics
import subprocess
import sys
import unittest

from browser import BrowserTestCase
from report_case import Page, needs_matplotlib

from report.number_text import ms_text, small_text  # noqa: E402, report_case says where it is

BINARY = os.path.abspath(sys.argv.pop(1))


@needs_matplotlib
class RealSweepTest(BrowserTestCase):
    def run_binary(self, *arguments):
        done = subprocess.run([BINARY, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=250)
        self.assertEqual(done.returncode, 0, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def rows(self):
        with open(self.folder / "sweep" / "sweep.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_rows_charts_page(self):
        self.run_binary("sweep", "scene:spheres,triangles=500", "--size", "160x120", "--over", "shadows=map,exact,rays",
                        "--over", "reflection-percent=0:100:50", "--over", "threads=1,2", "--truth-samples", "1", "-o", "sweep")
        rows = self.rows()
        self.assertEqual(len(rows), 3 * 3 * 2 * 3)
        for name in ("pareto", "scaling", "passes-reflection-percent", "passes-shadows", "error-reflection-percent"):
            for kind in ("svg", "png"):
                self.assertGreater((self.folder / "sweep" / f"{name}.{kind}").stat().st_size, 2000, name)
        page = self.folder / "sweep" / "report.html"
        self.check(page, "page")

        table = Page(page.read_text(encoding="utf-8")).rows
        self.assertEqual(len(table), 2 * (1 + 18))  # settings, then their passes
        table = table[:1 + 18]
        for number in (1, 10):
            mine = [row for row in rows if row["setting"] == str(number)]
            cells, = (cells for cells in table[1:] if cells[0] == str(number))
            self.assertIn(ms_text(statistics.median(float(row["wall_ms"]) for row in mine)), cells)
            self.assertIn(small_text(float(mine[0]["max_error"])), cells)

        before = page.read_bytes()
        page.unlink()
        self.run_binary("report", "sweep")
        self.assertEqual(page.read_bytes(), before)

        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([BINARY, "report", "sweep"], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True,
                                  timeout=250)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (5, 1), done.stderr)


if __name__ == "__main__":
    unittest.main()
