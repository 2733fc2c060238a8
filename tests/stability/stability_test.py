"""Drives every trial of `sweep --preset stability` and holds the thresholds against thresholds.csv beside this file.

A threshold may only move outward. Where a method gets better, write the new value there; where it must get worse, write the
new value and its reason (column `why`)."""
from __future__ import annotations

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HYBRIDRT = sys.argv.pop(1)
KEPT = pathlib.Path(__file__).with_name("thresholds.csv")
SLACK = 1.08  # bisection stops within 5 %; rays in single precision differ a little between processors


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class StabilityTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        done = subprocess.run([HYBRIDRT, "sweep", "--preset", "stability", "--gl", "off", "-o", cls.folder, "-q", "--no-charts"],
                              capture_output=True, text=True, timeout=900, check=False)
        assert (done.returncode, done.stdout, done.stderr) == (0, "", ""), done
        cls.trials = {trial["name"]: trial for trial in json.loads((cls.folder / "stability.json").read_text())["trials"]}
        cls.points = rows_of(cls.folder / "stability.csv")
        cls.found = {(row["trial"], row["contender"]): row for row in rows_of(cls.folder / "thresholds.csv")}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_no_threshold_moves_inward(self):
        kept = rows_of(KEPT)
        self.assertEqual([(row["trial"], row["contender"]) for row in kept], list(self.found))
        for row in kept:
            with self.subTest(trial=row["trial"], contender=row["contender"]):
                found = self.found[row["trial"], row["contender"]]["holds_to"]
                if row["holds_to"]:
                    self.assertNotEqual(found, "", "fails from the start")
                    self.assertTrue(self.is_as_far(row["trial"], float(found), float(row["holds_to"])),
                                    f"held to {row['holds_to']}, now to {found}")

    def is_as_far(self, trial, found, kept):
        """Whether `found` lies no nearer to the harmless end."""
        first, *_, last = self.trials[trial]["values"]
        if abs(last) < abs(first):
            return abs(found) <= abs(kept) * SLACK
        return abs(found) >= abs(kept) / SLACK

    def test_exact_shadows_and_triangles_are_never_wrong(self):
        checked = 0
        for row in self.points:
            if row["contender"] in ("hybrid exact", "hybrid rays"):
                self.assertEqual([int(row[name]) for name in ("false_lit", "false_shadow")], [0, 0], row)
                if self.trials[row["trial"]]["truth"] == "of each value":  # else vertices are rounded a little differently
                    self.assertEqual(row["other_triangle"], "0", row)
                checked += 1
        self.assertGreater(checked, 250)

    def test_every_picture_holds_numbers(self):
        for row in self.points:
            self.assertEqual(row["non_finite"], "0", row)

    def test_where_the_papers_method_fails(self):
        """It must: thin casters, small maps. Else nothing is measured."""
        for trial in ("thin-casters", "flicker"):
            blur = self.found[trial, "hybrid blur"]
            self.assertNotEqual(blur["fails_from"], "", trial)
        self.assertNotEqual(self.found["map-size", "raster map"]["fails_from"], "")

    def test_what_it_writes_belongs_together(self):
        for (trial, contender), row in self.found.items():
            points = {point["value"]: float(point["percent_bad"]) for point in self.points
                      if (point["trial"], point["contender"]) == (trial, contender)}
            for value in self.trials[trial]["values"]:
                self.assertIn(f"{value:.12g}", points)
            if row["holds_to"]:
                self.assertLessEqual(points[row["holds_to"]], 1)
            if row["fails_from"]:
                self.assertGreater(points[row["fails_from"]], 1)
                self.assertAlmostEqual(float(row["percent_bad"]), points[row["fails_from"]], delta=1e-4 * points[row["fails_from"]])
                for name in ("picture", "truth", "difference"):
                    self.assertTrue((self.folder / row[name]).is_file(), row)

    def fail_with(self, code, *arguments, says):
        done = subprocess.run([HYBRIDRT, "sweep", *arguments], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(says, done.stderr)

    def test_refuses_what_it_sets_itself(self):
        preset = ("--preset", "stability", "-o", str(self.folder / "none"))
        self.fail_with(2, *preset, "--method", "raster", says="--method")
        self.fail_with(2, *preset, "--over", "samples=1,2", says="--over")
        self.fail_with(2, "scene:chess", *preset, says="scene:wires")
        self.fail_with(2, "-o", str(self.folder / "none"), "--over", "samples=1,2", says="SCENE")
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main()
