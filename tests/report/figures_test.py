"""Tests of scripts/report without its charts: figures against ones worked out by hand, and bad input."""
from __future__ import annotations

import math
import subprocess
import sys
import unittest

from make_sweep import Sweep, make_sweep
from report_case import REPORT, ReportTestCase

from report.pareto_front import pareto_front, truth_groups
from report.quartiles import Quartiles, quartiles, root_mean_square
from report.read_sweep import read_sweep
from report.report_error import ReportError


class FiguresTest(ReportTestCase):
    def test_quartiles(self):
        self.assertEqual(quartiles([7.0]), Quartiles(7, 7, 7))
        self.assertEqual(quartiles([4.0, 2.0]), Quartiles(2.5, 3, 3.5))
        self.assertEqual(quartiles([5.0, 1.0, 2.0, 4.0, 3.0]), Quartiles(2, 3, 4))

    def test_root_mean_square(self):
        self.assertEqual(root_mean_square([3.0, 4.0, 0.0, 0.0]), 2.5)

    def test_medians_over_rounds_and_frames(self):
        self.write([{"setting": 1, "round": 1 + place // 2, "frame": 1 + place % 2, "wall_ms": wall, "trace_ms": 2 * wall,
                     "pixels": 100, "pixels_reflective": 10 + place} for place, wall in enumerate([10, 30, 20, 90])])
        summary, = self.summaries()
        self.assertEqual(summary.wall, Quartiles(17.5, 25, 45))
        self.assertEqual(summary.passes["trace_ms"], 50)
        self.assertEqual(summary.pass_quartiles["trace_ms"], Quartiles(35, 50, 90))
        self.assertEqual(summary.passes["id_ms"], 0)
        self.assertAlmostEqual(summary.reflective_percent, 11.5)
        self.assertIsNone(summary.accuracy)

    def test_accuracy_over_frames(self):
        self.write([{"setting": 1, "frame": 1, "wall_ms": 1, "rmse": 0.03, "psnr_db": 30.46, "ssim": 0.9, "max_error": 0.5,
                     "false_lit": 4},
                    {"setting": 1, "frame": 2, "wall_ms": 1, "rmse": 0.04, "psnr_db": 27.96, "ssim": 0.8, "max_error": 0.7,
                     "false_lit": 7}])
        accuracy = self.summaries()[0].accuracy
        self.assertAlmostEqual(accuracy.rmse, 0.025 * math.sqrt(2))
        self.assertAlmostEqual(accuracy.psnr_db, 29.0309, 4)
        self.assertAlmostEqual(accuracy.ssim, 0.85)
        self.assertEqual((accuracy.max_error, accuracy.false_lit, accuracy.other_triangle), (0.7, 5.5, None))
        self.assertFalse(accuracy.equal)

    def test_equal_to_the_last_bit_is_every_frame_and_every_pixel(self):
        equal = {"wall_ms": 1, "rmse": 0, "psnr_db": "inf", "pixels_different": 0, "non_finite": 0}
        self.write([{"setting": 1, **equal}, {"setting": 2, **equal}, {"setting": 2, **equal, "frame": 2, "rmse": 1e-9},
                    {"setting": 3, **equal, "pixels_different": 1}, {"setting": 4, **equal, "non_finite": 1},
                    {"setting": 5, **equal, "rmse": "nan"}])
        found = [(summary.accuracy.equal, summary.accuracy.sound) for summary in self.summaries()]
        self.assertEqual(found, [(True, True), (False, True), (False, False), (False, False), (False, False)])

    def test_pareto_front(self):
        points = {1: (10, 0.5), 2: (20, 0.1), 3: (20, 0.2), 4: (15, 0.5), 5: (40, 0), 6: (50, 0), 7: (30, 0.05), 8: (20, 0.1)}
        self.write([{"setting": number, "wall_ms": time, "rmse": error} for number, (time, error) in points.items()])
        front = [summary.setting.number for summary in pareto_front(self.summaries())]
        self.assertEqual(front, [1, 2, 8, 7, 5])

    def test_a_front_for_each_truth(self):
        axes = [{"name": "triangles", "column": "triangles", "values": ["10", "20"], "changes_truth": True},
                {"name": "kind", "column": "kind", "values": ["1", "2"], "changes_truth": False}]
        self.write([{"setting": 1, "triangles": 10, "wall_ms": 1, "rmse": 0.1},
                    {"setting": 2, "triangles": 10, "wall_ms": 2, "rmse": 0.2},
                    {"setting": 3, "triangles": 20, "wall_ms": 9, "rmse": 0.3}], axes)
        named, groups = truth_groups(read_sweep(self.folder).axes, self.summaries())
        self.assertEqual([axis.name for axis in named], ["triangles"])
        self.assertEqual({key: [summary.setting.number for summary in pareto_front(group)] for key, group in groups.items()},
                         {("10",): [1], ("20",): [3]})


class BadInputTest(ReportTestCase):
    def refused(self, *words):
        """The command's one line on standard error, with these words; exit code 3."""
        done = self.run_report(self.folder)
        self.assertEqual((done.returncode, done.stdout), (3, ""), done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse((self.folder / "report.html").exists())

    def test_no_folder(self):
        self.folder = self.folder / "nowhere"
        self.refused("nowhere", "not a folder")

    def test_no_json(self):
        self.refused("sweep.json", "run `hybridrt sweep` first")

    def test_broken_json(self):
        (self.folder / "sweep.json").write_text("{")
        self.refused("sweep.json", "not JSON")

    def test_json_of_something_else(self):
        for text in ("[]", '{"axes": 3, "settings": []}', '{"axes": [], "settings": [{}]}', '{"settings": []}'):
            with self.subTest(text):
                self.write([{"setting": 1, "wall_ms": 1}])
                (self.folder / "sweep.json").write_text(text)
                self.refused("sweep.json", "run the sweep again")

    def test_no_csv(self):
        self.write([{"setting": 1, "wall_ms": 1}])
        (self.folder / "sweep.csv").unlink()
        self.refused("sweep.csv", "run `hybridrt sweep` first")

    def test_csv_that_is_not_one(self):
        for text, word in (("", "no column setting"), ("setting,round,frame,wall_ms\n", "no column error"),
                           ("setting,round,frame,wall_ms,error\n1,1,1,abc,\n", "line 2: wall_ms is 'abc'"),
                           ("setting,round,frame,wall_ms,rmse,error\n1,1,1,1,abc,\n", "line 2: rmse is 'abc'"),
                           ("setting,round,frame,wall_ms,error\n1,1,1,inf,\n", "line 2: wall_ms is 'inf'"),
                           ("setting,round,frame,wall_ms,error\n1,1,1,,\n", "line 2: neither"),
                           ("setting,round,frame,wall_ms,error\n1,1,1\n", "line 2: not as many cells"),
                           ("setting,round,frame,wall_ms,error\n9,1,1,1,\n", "has setting 9")):
            with self.subTest(text):
                self.write([{"setting": 1, "wall_ms": 1}])
                (self.folder / "sweep.csv").write_text(text)
                self.refused("sweep.csv", word)

    def test_csv_in_another_encoding(self):
        self.write([{"setting": 1, "wall_ms": 1}])
        (self.folder / "sweep.csv").write_bytes("setting,round,frame,wall_ms,error\n1,1,1,1,\xfc\n".encode("latin-1"))
        self.refused("sweep.csv", "UTF-8")

    def test_quoting(self):
        self.write([{"setting": 1, "round": 1, "frame": "", "error": 'no "GL",\nat all'}, {"setting": 2, "wall_ms": 1}])
        sweep = read_sweep(self.folder)
        self.assertEqual(sweep.settings[0].errors, ('no "GL", at all',))

    def test_a_setting_that_was_not_reached(self):
        self.write([{"setting": 1, "wall_ms": 1}], settings=[{"number": 1, "label": "a"}, {"number": 2, "label": "b"}])
        self.assertIn("not measured", read_sweep(self.folder).settings[1].errors[0])

    def test_a_number_twice(self):
        self.write([{"setting": 1, "wall_ms": 1}], settings=[{"number": 1, "label": "a"}, {"number": 1, "label": "b"}])
        with self.assertRaisesRegex(ReportError, "twice"):
            read_sweep(self.folder)

    def test_no_matplotlib(self):
        make_sweep(self.folder, Sweep({"shadows": ["map", "exact"]}, pictures=False))
        blocked = ("import runpy, sys; sys.modules['matplotlib'] = None; sys.argv = sys.argv[1:]; "
                   "runpy.run_path(sys.argv[0], run_name='__main__')")
        done = subprocess.run([sys.executable, "-c", blocked, str(REPORT), str(self.folder)], capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (3, "", 1), done.stderr)
        for word in ("python3-matplotlib", "pip install matplotlib", "sweep.csv"):
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
