"""hybridrt sweep: what it measures, that its errors are the pictures' own, and that it goes on where it was stopped."""

import csv
import json
import math
import os
import signal
import time
import unittest

from cli_test_case import SCENE, CliTestCase, Png

SMALL = ("--size", "96x72")

# Columns whose values may differ from run to run.
TIMED = ("_ms",)


class SweepTestCase(CliTestCase):
    def sweep(self, *arguments, folder="sweep", scene=SCENE, expect=0, truth_samples=1):
        done = self.run_binary("sweep", scene, *SMALL, "--truth-samples", str(truth_samples), "--no-charts", "-o", folder,
                               *arguments)
        self.assertEqual(done.returncode, expect, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def rows(self, folder="sweep"):
        with open(self.path(folder, "sweep.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def facts(self, folder="sweep"):
        return json.loads(self.read(os.path.join(folder, "sweep.json")))

    @staticmethod
    def untimed(rows):
        """What must be equal in every run, in an order of its own."""
        kept = [{name: value for name, value in row.items() if not name.endswith(TIMED)} for row in rows]
        return sorted(kept, key=lambda row: (int(row["setting"]), int(row["round"]), row["frame"]))


class Rows(SweepTestCase):
    def test_one_per_setting_round_and_frame(self):
        self.sweep("--over", "shadows=none,exact", "--over", "reflection-depth=0:2", "--frames", "1-2", "--rounds", "2")
        rows = self.rows()
        keys = {(row["setting"], row["round"], row["frame"]) for row in rows}
        self.assertEqual(keys, {(str(s), str(r), str(f)) for s in range(1, 7) for r in (1, 2) for f in (1, 2)})
        self.assertEqual(len(rows), 24)
        for row in rows:
            self.assertEqual((row["width_px"], row["height_px"], row["method"]), ("96", "72", "hybrid"))
            self.assertGreater(float(row["wall_ms"]), 0)
            self.assertGreater(float(row["first_frame_ms"]), 0)
            self.assertEqual(row["error"], "")
        self.assertEqual({row["reflection_depth"] for row in rows}, {"0", "1", "2"})
        self.assertEqual([s["label"] for s in self.facts()["settings"]][:2],
                         ["shadows=none reflection-depth=0", "shadows=none reflection-depth=1"])

    def test_rounds_take_turns(self):
        self.sweep("--over", "shadows=none,exact", "--rounds", "3")
        self.assertEqual([(row["setting"], row["round"]) for row in self.rows()],
                         [(s, r) for r in "123" for s in "12"])

    def test_combinations_that_render_refuses_are_left_out_and_told(self):
        done = self.sweep("--over", "method=hybrid,raytrace", "--over", "shadows=none,exact")
        self.assertEqual([(row["method"], row["shadows"]) for row in self.rows() if row["round"] == "1"],
                         [("hybrid", "none"), ("hybrid", "exact"), ("raytrace", "none")])
        self.assertIn("method=raytrace shadows=exact", done.stderr)

    def test_the_share_of_mirrors_grows_with_what_is_asked(self):
        self.sweep("--over", "reflection-percent=0:100:50", "--rounds", "1")
        reflective = [int(row["pixels_reflective"]) for row in self.rows()]
        self.assertEqual(reflective[0], 0)
        self.assertGreater(reflective[1], 0)
        self.assertEqual(reflective[2], int(self.rows()[2]["pixels_hit"]))
        self.assertEqual([row["reflection_percent"] for row in self.rows()], ["0", "50", "100"])

    def test_parameters_of_a_procedural_scene(self):
        self.sweep("--over", "triangles=500,2k", "--over", "reflective=0,100", "--rounds", "1")
        rows = self.rows()
        self.assertLess(int(rows[0]["triangles"]), int(rows[2]["triangles"]))
        self.assertEqual([row["reflective"] for row in rows], ["0", "100"] * 2)

    def test_scenes_are_an_axis(self):
        self.sweep("--over", "shadows=none,exact", "--over",
                   "scene=scene:spheres,triangles=500;scene:chess,triangles=10k", "--rounds", "1")
        self.assertEqual([(row["scene"][:10], row["shadows"]) for row in self.rows()],
                         [("scene:sphe", "none"), ("scene:sphe", "exact"), ("scene:ches", "none"), ("scene:ches", "exact")])
        self.assertEqual(len({s["truth"] for s in self.facts()["settings"]}), 2)

    def test_files_of_options_are_an_axis_whatever_they_hold(self):
        self.write("matt.json", '{"reflection-percent": 0}')
        self.write("mirrors.json", '{"reflection-percent": 100, "shadows": "none"}')
        self.sweep("--over", "config=matt.json,mirrors.json", "--rounds", "1")
        matt, mirrors = self.rows()
        self.assertEqual((matt["pixels_reflective"], matt["shadows"]), ("0", "exact"))
        self.assertEqual((mirrors["pixels_reflective"], mirrors["shadows"]), (mirrors["pixels_hit"], "none"))
        self.assertEqual(len({s["truth"] for s in self.facts()["settings"]}), 2)

    def test_threads_are_an_axis(self):
        self.sweep("--over", "threads=1,2", "--rounds", "1")
        self.assertEqual([row["threads"] for row in self.rows()], ["1", "2"])


class Errors(SweepTestCase):
    """Accuracy columns."""

    def test_are_those_of_the_pictures(self):
        self.sweep("--over", "shadows=none,map,exact", "--rounds", "1")
        for row, setting in zip(self.rows(), self.facts()["settings"]):
            picture = Png.read(self.path("sweep", setting["picture"]))
            truth = Png.read(self.path("sweep", setting["truth"]))
            off = [abs(a - b) / 255 for r, s in zip(picture.rows, truth.rows) for a, b in zip(r, s)]
            rmse = math.sqrt(sum(d * d for d in off) / len(off))
            self.assertAlmostEqual(float(row["rmse"]), rmse, delta=1e-5 * max(rmse, 1e-3))
            self.assertAlmostEqual(float(row["max_error"]), max(off), places=5)
            pixels = list(zip(off[0::3], off[1::3], off[2::3]))
            self.assertEqual(int(row["pixels_different"]), sum(any(p) for p in pixels))
            if rmse:
                self.assertAlmostEqual(float(row["psnr_db"]), -20 * math.log10(rmse), places=2)
            else:
                self.assertEqual(row["psnr_db"], "inf")

    def test_exact_shadows_are_exact_and_the_reference_is_the_truth(self):
        self.sweep("--over", "method=hybrid,reference", "--reflection-depth", "64", "--rounds", "1")
        hybrid, reference = self.rows()
        for column in ("false_lit", "false_shadow", "other_triangle", "non_finite"):
            self.assertEqual(hybrid[column], "0", column)
        self.assertEqual((reference["rmse"], reference["psnr_db"], reference["pixels_different"]), ("0", "inf", "0"))
        self.assertEqual(float(reference["ssim"]), 1)

    def test_a_wrong_shadow_is_found(self):
        self.sweep("--over", "shadow-map=16,2048", "--shadows", "map", "--rounds", "1")
        coarse, fine = self.rows()
        wrong = [int(row["false_lit"]) + int(row["false_shadow"]) for row in (coarse, fine)]
        self.assertGreater(wrong[0], 2 * wrong[1])
        self.assertGreater(float(coarse["rmse"]), float(fine["rmse"]))

    def test_more_samples_are_nearer_to_a_truth_of_many(self):
        self.sweep("--over", "samples=1,16", "--rounds", "1", truth_samples=64)
        one, many = self.rows()
        self.assertLess(float(many["rmse"]), 0.5 * float(one["rmse"]))
        self.assertEqual(many["false_lit"], "")  # known at pixels' centres only

    def test_against_pictures_of_the_users(self):
        self.succeed("render", SCENE, *SMALL, "-q", "--frames", "1-2", "-o", "mine/f.####.png")
        self.sweep("--over", "reflection-depth=0,4", "--frames", "1-2", "--truth", "mine", "--rounds", "1")
        shallow, deep = self.rows()[0], self.rows()[2]
        self.assertEqual((deep["rmse"], deep["pixels_different"]), ("0", "0"))
        self.assertGreater(float(shallow["rmse"]), 0)
        self.assertEqual(deep["false_lit"], "")

    def test_pictures_of_a_folder_are_the_truth_of_every_scene(self):
        self.succeed("render", SCENE, *SMALL, "-q", "-o", "mine/f.0001.png")
        for truth, changes in (((), True), (("--truth", "mine"), False)):
            folder = "with" + "".join(truth).strip("-")
            self.sweep("--over", f"scene={SCENE};{SCENE},reflective=0", "--rounds", "1", *truth, folder=folder)
            self.assertEqual(json.loads(self.read(f"{folder}/sweep.json"))["axes"][0]["changes_truth"], changes)

    def test_without_a_truth_there_are_none(self):
        self.sweep("--over", "shadows=none,exact", "--rounds", "1", truth_samples=0)
        self.assertEqual({row["rmse"] for row in self.rows()}, {""})
        self.assertFalse(os.listdir(self.path("sweep", "truth")) if os.path.exists(self.path("sweep", "truth")) else [])


class GoingOn(SweepTestCase):
    ARGUMENTS = ("--over", "shadows=none,exact,rays", "--over", "reflection-depth=0:3", "--rounds", "3")

    def start_sweep(self, folder):
        return self.start("sweep", SCENE, *SMALL, "--truth-samples", "1", "--no-charts", "-o", folder,
                          *self.ARGUMENTS)

    def wait_for_rows(self, folder, count):
        for _ in range(600):
            if os.path.exists(self.path(folder, "sweep.csv")) and len(self.rows(folder)) >= count:
                return
            time.sleep(0.02)
        self.fail("no rows")

    def test_killed_midway_ends_in_the_same_rows(self):
        self.sweep(*self.ARGUMENTS, folder="whole")
        for stop in (signal.SIGKILL, signal.SIGINT):
            folder = f"stopped{stop}"
            running = self.start_sweep(folder)
            self.wait_for_rows(folder, 5)
            running.send_signal(stop)
            running.communicate()
            self.assertLess(len(self.rows(folder)), 36)
            before = self.rows(folder)
            self.sweep(*self.ARGUMENTS, folder=folder)
            self.assertEqual(self.rows(folder)[:len(before)], before)  # nothing is measured twice
            self.assertEqual(self.untimed(self.rows(folder)), self.untimed(self.rows("whole")))
            self.assertEqual(self.facts(folder)["settings"], self.facts("whole")["settings"])

    def test_a_stopped_one_says_so(self):
        running = self.start_sweep("sweep")
        self.wait_for_rows("sweep", 2)
        running.send_signal(signal.SIGTERM)
        _, errors = running.communicate()
        self.assertEqual(running.returncode, 143)
        self.assertIn("goes on", errors)

    def test_a_whole_one_is_not_measured_again(self):
        self.sweep("--over", "shadows=none,exact")
        before = self.read("sweep/sweep.csv")
        self.sweep("--over", "shadows=none,exact")
        self.assertEqual(self.read("sweep/sweep.csv"), before)
        self.sweep("--over", "shadows=none,exact", "--rounds", "4")
        self.assertEqual(len(self.rows()), 8)
        self.assertTrue(self.read("sweep/sweep.csv").startswith(before))

    def test_another_sweep_in_the_folder_is_refused(self):
        self.sweep("--over", "shadows=none,exact", "--rounds", "1")
        before = self.read("sweep/sweep.csv")
        for axis, options, samples in (("none,rays", (), 1), ("none,exact", ("--fov", "20"), 1), ("none,exact", (), 2)):
            done = self.sweep("--over", f"shadows={axis}", "--rounds", "1", *options, expect=3, truth_samples=samples)
            self.assertIn("choose another folder", done.stderr)
        self.assertEqual(self.read("sweep/sweep.csv"), before)


class Failures(SweepTestCase):
    def test_a_setting_that_fails_is_a_row(self):
        done = self.sweep("--over", "up-axis=y,z", "--rounds", "2", expect=1)  # made scenes are y up
        rows = self.rows()
        self.assertEqual([row["error"] == "" for row in rows], [False, True, True])
        failed = rows[0]
        self.assertEqual((failed["up_axis"], failed["wall_ms"], failed["frame"]), ("z", "", ""))
        self.assertIn("failed", done.stderr)

    def test_messages(self):
        for arguments, words in (
                ((), "say what over"),
                (("--over", "colour=1"), "there is no axis 'colour'"),
                (("--over", "shadows"), "has no values"),
                (("--over", "shadows="), "has no values"),
                (("--over", "shadows=soft"), "--shadows soft: not known"),
                (("--over", "samples=5:1"), "FIRST <= LAST"),
                (("--over", "samples=1:5:0"), "step above 0"),
                (("--over", "shadow-map=0:8:*2"), "step above 0"),
                (("--over", "shadows=none", "--over", "shadows=exact"), "given twice"),
                (("--over", "shadows=none", "--shadows", "exact"), "give one of them"),
                (("--over", "frames=1,2"), "there is no axis"),
                (("--preset", "cinema"), "must be one of"),
                (("--over", "method=raster", "--over", "shadows=rays"), "does not take")):
            done = self.sweep(*arguments, expect=2)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(self.files(), [])

    def test_parameters_are_of_procedural_scenes_only(self):
        mesh = self.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertIn("there is no axis", self.sweep("--over", "triangles=10,20", scene=mesh, expect=2).stderr)
        self.assertIn("one size only", self.sweep("--preset", "growth", scene=mesh, expect=2).stderr)

    def test_peaks_of_memory(self):
        """Of each setting by itself: the small scene after the large one takes little again."""
        self.sweep("--over", "triangles=300000,2000", "--rounds", "2", "--memory", scene="scene:spheres")
        peaks = {row["triangles"]: float(row["peak_memory_mib"]) for row in self.rows() if row["round"] == "2"}
        large, small = (peaks[count] for count in sorted(peaks, key=int, reverse=True))
        self.assertGreater(large, small + 40)
        self.sweep("--over", "shadows=none", "--rounds", "1", folder="without")
        self.assertEqual({row["peak_memory_mib"] for row in self.rows("without")}, {""})

    def test_a_truth_that_lacks_a_frame(self):
        os.mkdir(self.path("mine"))
        done = self.sweep("--over", "shadows=none", "--truth", "mine", "--rounds", "1", expect=1)
        self.assertIn("holds no picture of frame 1", done.stderr)
        self.assertEqual(self.sweep("--over", "shadows=none", "--truth", "none", folder="b", expect=3).returncode, 3)

    def test_a_report_of_nothing(self):
        done = self.run_binary("report", "nowhere")
        self.assertEqual(done.returncode, 3)
        self.assertIn("sweep.csv", done.stderr)


if __name__ == "__main__":
    unittest.main()
