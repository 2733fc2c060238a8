"""hybridrt render through the real binary: the files of a run and their contents."""

import csv
import json
import os
import statistics
import subprocess
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase, Png

COLUMNS = ("frame,shadow_map_ms,id_ms,mark_ms,readback_ms,trace_ms,upload_ms,shade_ms,download_ms,write_ms,wall_ms,"
           "pixels_hit,pixels_marked,pixels_reflective,pixels_refractive,shadow_rays,reflection_rays,"
           "refraction_rays,shadow_cpu_ms,secondary_cpu_ms").split(",")


class RenderTest(CliTestCase):
    def rows(self, name):
        with open(self.path(name), newline="", encoding="ascii") as file:
            lines = list(csv.reader(file))
        self.assertEqual(lines[0][:len(COLUMNS)], COLUMNS)
        self.assertTrue(all(len(line) == len(lines[0]) for line in lines))
        return [{name: float(value) for name, value in zip(lines[0], line)} for line in lines[1:]]

    def test_one_frame_by_default(self):
        done = self.succeed("render", SCENE, *SMALL)
        self.assertEqual(self.files(), ["out/run.json", "out/spheres.0001.png", "out/timings.csv"])
        picture = Png.read(self.path("out/spheres.0001.png"))
        self.assertEqual((picture.width, picture.height), (96, 72))
        self.assertGreater(len({picture.pixel(x, y) for x in range(96) for y in range(72)}), 50)
        for part in ("light buffer", "out/spheres.0001.png", "out/timings.csv", "frames/s"):
            self.assertIn(part, done.stdout)

    def test_the_closing_table_tells_the_first_frame_from_the_others(self):
        done = self.succeed("render", SCENE, *SMALL, "--frames", "5")
        rows = self.rows("out/timings.csv")
        for label, column in (("1 light buffer", "shadow_map_ms"), ("4 rays on the CPU", "trace_ms"),
                              ("from frame to frame", "wall_ms")):
            line, = (line for line in done.stdout.splitlines() if line.startswith(label))
            first, median = (float(word) for word in line[len(label):].split())
            self.assertAlmostEqual(first, rows[0][column], delta=0.006)
            self.assertAlmostEqual(median, statistics.median(row[column] for row in rows[1:]), delta=0.006)

    def test_a_still_camera_is_rendered_once(self):
        still = ("--eye", "3,4,9", "--target", "0,0,0")
        done = self.succeed("render", SCENE, *SMALL, *still, "--frames", "4", "--aov", "shadow", "-o", "s.####.png")
        self.assertIn("4 frames (3 show what the one before shows)", done.stdout)
        self.assertEqual(json.loads(self.read("run.json"))["repeated_frames"], 3)
        rows = self.rows("timings.csv")
        self.assertGreater(rows[0]["trace_ms"], 0)
        for row in rows[1:]:
            self.assertEqual((row["trace_ms"], row["wall_ms"], row["shadow_rays"]), (0, 0, 0))
            self.assertEqual(row["pixels_hit"], rows[0]["pixels_hit"])
        self.render(*still, "--frames", "9-9", "-o", "alone.png", "--aov", "shadow")
        for frame in range(1, 5):
            self.assertEqual(self.read(f"s.000{frame}.png"), self.read("alone.png"))
            self.assertEqual(self.read(f"s.shadow.000{frame}.png"), self.read("alone.shadow.png"))

    def test_default_size(self):
        self.succeed("render", SCENE, "-q", "--method", "raster")
        picture = Png.read(self.path("out/spheres.0001.png"))
        self.assertEqual((picture.width, picture.height), (1024, 768))

    def test_obj_gives_its_name(self):
        self.write("my scene.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.succeed("render", "my scene.obj", *SMALL, "-q")
        self.assertIn("out/my scene.0001.png", self.files())

    def test_one_frame_to_standard_output(self):
        self.render("--frames", "3-3", "-o", "file.png")
        done = subprocess.run([BINARY, "render", SCENE, *SMALL, "--frames", "3-3", "-o", "-"], cwd=self.path("."),
                              capture_output=True, timeout=120)
        self.assertEqual((done.returncode, done.stdout), (0, self.read("file.png")))
        self.assertEqual(self.files(), ["file.png", "run.json", "timings.csv"], "no tables that nobody asked for")
        for wrong in (("--timings", "-"), ("--json",), ("--aov", "id")):
            self.fail_with(2, "render", SCENE, *SMALL, "-o", "-", *wrong, says="-o -")

    def test_another_render_into_a_folder_keeps_the_first_ones_tables(self):
        self.render("-o", "out/a.####.png")
        first = self.read("out/timings.csv"), self.read("out/run.json")
        other = ("render", "scene:chess,triangles=10000", *SMALL, "-q", "-o", "out/b.####.png")
        for _ in range(2):  # the second time they are its own
            done = self.succeed(*other)
            self.assertEqual(done.stderr, "")
        self.assertEqual((self.read("out/timings.csv"), self.read("out/run.json")), first)
        self.assertEqual(self.files("out"), ["a.0001.png", "b.0001.png", "b.run.json", "b.timings.csv", "run.json",
                                             "timings.csv"])
        self.assertEqual(self.render("-o", "out/a.####.png", "--samples", "2").stderr, "", "its own are replaced")
        self.assertNotEqual(self.read("out/run.json"), first[1])

    def test_run_json_can_make_the_pictures_again(self):
        self.render("-o", "a.####.png", "--frames", "2", "--fov", "30", "--background", "0,0,1")
        run = json.loads(self.read("run.json"))
        self.assertEqual(run["command_line"][1:], ["render", SCENE, *SMALL, "-q", "-o", "a.####.png", "--frames", "2",
                                                   "--fov", "30", "--background", "0,0,1"])
        first = {name: self.read(name) for name in ("a.0001.png", "a.0002.png")}
        for name in first:
            os.remove(self.path(name))
        self.succeed(*run["command_line"][1:])
        self.assertEqual({name: self.read(name) for name in first}, first)
        self.assertEqual(list(run["fingerprints"]), ["1", "2"])
        for frame, number in run["fingerprints"].items():
            self.assertIn(b"fingerprint=" + number.encode(), self.read(f"a.000{frame}.png"))
        self.assertEqual(run["background"], [0, 0, 1])
        self.assertAlmostEqual(run["camera"]["first"]["fov_y_deg"], 30)
        self.assertEqual(run["outputs"]["pattern"], "a.####.png")

    def test_sequence_and_its_timings(self):
        self.render("--frames", "8-12:2,3", "-o", "pictures/x.###.png")
        self.assertEqual(self.files("pictures"),
                         ["run.json", "timings.csv", "x.003.png", "x.008.png", "x.010.png", "x.012.png"])
        rows = self.rows("pictures/timings.csv")
        self.assertEqual([row["frame"] for row in rows], [8, 10, 12, 3])
        for row in rows:
            self.assertTrue(all(value >= 0 for value in row.values()))
            self.assertLessEqual(row["pixels_hit"], 96 * 72)
            self.assertLessEqual(row["pixels_marked"], row["pixels_hit"])
            self.assertLessEqual(row["pixels_reflective"], row["pixels_hit"])
            self.assertGreaterEqual(row["reflection_rays"], row["pixels_reflective"])
            self.assertLessEqual(row["pixels_refractive"] + row["refraction_rays"], 0)
            self.assertGreater(row["shadow_rays"], 0)
            self.assertGreater(row["wall_ms"], 0)
            self.assertGreater(row["write_ms"], 0)
            self.assertGreater(row["id_ms"], 0)
        self.assertGreater(rows[0]["shadow_map_ms"], 0)
        self.assertEqual([row["shadow_map_ms"] for row in rows[1:]], [0, 0, 0], "the light stands still")

    def test_pixels_hit_are_those_that_are_not_background(self):
        self.render()
        picture = Png.read(self.path("out/spheres.0001.png"))
        background = picture.pixel(0, 0)
        seen = sum(picture.pixel(x, y) != background for x in range(96) for y in range(72))
        self.assertAlmostEqual(self.rows("out/timings.csv")[0]["pixels_hit"], seen, delta=5)

    def test_run_facts(self):
        self.render("--frames", "3", "--threads", "2", "--reflection-depth", "1")
        report = json.loads(self.read("out/run.json"))
        for key in ("version", "commit", "scene", "settings", "gl", "processor", "threads", "load_ms", "accel",
                    "accel_build_ms", "drain_ms", "frames", "frames_per_second", "peak_memory_mib", "warnings"):
            self.assertIn(key, report)
        self.assertEqual(report["scene"]["triangles"], 500)
        self.assertEqual(report["frames"], 3)
        self.assertEqual(report["threads"], 2)
        self.assertEqual(report["settings"]["reflection_depth"], 1)
        self.assertEqual(report["passes"]["form"], "gl" if report["gl"] else "cpu")
        self.assertGreater(report["frames_per_second"], 0)

    def test_parts_of_a_sequence_carry_their_range(self):
        self.render("--frames", "3-4", "--sequence", "1-10")
        self.assertEqual(self.files("out"), ["run.0003-0004.json", "spheres.0003.png", "spheres.0004.png",
                                             "timings.0003-0004.csv"])

    def test_parts_are_the_wholes_frames(self):
        self.render("--frames", "6", "-o", "whole/x.png")
        self.render("--frames", "4-5", "--sequence", "1-6", "-o", "part/x.png")
        for name in ("x.0004.png", "x.0005.png"):
            self.assertEqual(self.read("whole/" + name), self.read("part/" + name))

    def test_patterns(self):
        self.render("-o", "one.png")
        self.assertIn("one.png", self.files())
        self.render("--frames", "2", "-o", "two.png")
        self.assertTrue({"two.0001.png", "two.0002.png"} <= set(self.files()))
        self.render("--frames", "7-7", "-o", "a{frame:06}b.png")
        self.assertIn("a000007b.png", self.files())
        self.render("--frames", "2", "-o", "shots/{frame}/p.png")
        self.assertEqual(self.files("shots"), ["1/p.png", "2/p.png", "run.json", "timings.csv"])
        self.render("--frames", "3-3", "-o", "shots/{frame}/q.png")
        self.assertEqual(self.files("shots"), ["1/p.png", "2/p.png", "3/q.png", "q.run.json", "q.timings.csv", "run.json", "timings.csv"])

    def test_contact_sheet(self):
        self.render("--frames", "5", "--contact-sheet", "sheet.png")
        sheet = Png.read(self.path("sheet.png"))
        self.assertGreaterEqual(sheet.width, 4 * 320)
        self.assertGreater(sheet.height, 2 * 200)

    def test_aovs(self):
        self.render("--aov", "id,shadow,marked,traced,depth,normal")
        for name in ("id", "shadow", "marked", "traced", "depth", "normal"):
            picture = Png.read(self.path(f"out/spheres.{name}.0001.png"))
            self.assertGreater(len({picture.pixel(x, y) for x in range(96) for y in range(72)}), 1, name)

    def test_other_formats(self):
        for extension, magic in (("exr", b"\x76\x2f\x31\x01"), ("jpg", b"\xff\xd8"), ("tif", b"II"), ("bmp", b"BM"),
                                 ("hdr", b"#?")):
            self.render("-o", "x." + extension)
            self.assertTrue(self.read("x." + extension).startswith(magic), extension)

    def test_timings_elsewhere_and_on_standard_output(self):
        self.render("--timings", "deep/down/t.csv", "--frames", "2")
        self.assertEqual(len(self.rows("deep/down/t.csv")), 2)
        for quiet in ((), ("-q",)):
            done = self.succeed("render", SCENE, *SMALL, "--timings", "-", "--frames", "2", *quiet)
            lines = done.stdout.splitlines()
            self.assertEqual(lines[0].split(",")[:len(COLUMNS)], COLUMNS)
            self.assertEqual([line.split(",")[0] for line in lines[1:]], ["1", "2"], "nothing but the CSV")

    def test_json_events(self):
        done = self.succeed("render", SCENE, *SMALL, "--json", "--frames", "3")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([event["event"] for event in events], ["start", "frame", "frame", "frame", "end"])
        self.assertEqual([event["frame"] for event in events[1:4]], [1, 2, 3])
        for event in events[1:4]:
            self.assertTrue(os.path.exists(self.path(event["path"])))
        self.assertEqual(events[0]["frames"], 3)
        self.assertEqual([(event["done"], event["of"]) for event in events[1:4]], [(1, 3), (2, 3), (3, 3)])
        self.assertEqual((events[4]["frames"], events[4]["stopped"]), (3, False))
        self.assertEqual((events[4]["state"], events[4]["exit_code"]), ("done", 0))
        self.assertEqual(done.stderr, "")

    def test_json_ends_with_an_event_whatever_happens(self):
        done = self.run_binary("render", "gone.obj", "--json")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([event["event"] for event in events], ["end"])
        self.assertEqual((events[0]["state"], events[0]["exit_code"]), ("failed", 3))
        self.assertIn("gone.obj", events[0]["message"])
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (3, 1))

    def test_json_warnings_are_events(self):
        self.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n")
        done = self.succeed("render", "odd.obj", *SMALL, "--json")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([event["event"] for event in events], ["warning", "start", "frame", "end"])
        warning = {"code": "triangle-degenerate",
                   "message": "odd.obj: 1 triangles that repeat a vertex were left out (first at line 5)"}
        self.assertEqual(events[0], {"event": "warning", **warning})
        with open(self.path("out/run.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file)["warnings"], [warning])
        done = self.succeed("render", "odd.obj", *SMALL, "-q")
        self.assertEqual(done.stderr, f"hybridrt: warning: {warning['message']} [{warning['code']}]\n")

    def test_quiet_is_silent_and_talk_goes_to_standard_error(self):
        done = self.render("--frames", "2")
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        done = self.succeed("render", SCENE, *SMALL, "--frames", "2", "-v")
        self.assertIn("frame 2", done.stderr)
        self.assertNotIn("\r", done.stderr, "no progress bar without a terminal")

    def test_methods(self):
        pictures = {}
        for method in ("hybrid", "raster", "raytrace", "reference"):
            self.render("--method", method, "-o", method + ".png")
            pictures[method] = self.read(method + ".png")
            self.assertEqual(len(self.rows("timings.csv")), 1)
        for method in ("raytrace", "reference"):
            self.succeed("compare", method + ".png", "hybrid.png", "--fail-percent", "2", "--hard-fail", "1")
        self.assertNotEqual(pictures["raster"], pictures["hybrid"])


class SameBytesTest(CliTestCase):
    def pictures(self, *arguments, **keywords):
        self.render("--frames", "4", "--aov", "id,shadow", "-o", "x.####.png", *arguments, **keywords)
        names = [name for name in self.files() if name.endswith(".png")]
        self.assertEqual(len(names), 12)
        return {name: self.read(name) for name in names}

    def test_same_command_same_bytes(self):
        expected = self.pictures()
        self.assertEqual(self.pictures(), expected)
        for threads in ("1", "3"):
            for slots in ("1", "3"):
                self.assertEqual(self.pictures("--threads", threads, "--frames-in-flight", slots), expected)

    def test_locale_changes_nothing(self):
        expected = self.pictures("--light", "1,2.5,0.5", "--fov", "33.5")
        german = {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}
        self.assertEqual(self.pictures("--light", "1,2.5,0.5", "--fov", "33.5", env=german), expected)
        self.assertNotIn(b";", self.read("timings.csv"))

    def test_light_and_camera_change_the_picture(self):
        expected = self.pictures()
        for change in (("--light", "1,1,1"), ("--fov", "30"), ("--eye", "5,4,3"), ("--reflection-depth", "0")):
            self.assertNotEqual(self.pictures(*change), expected, change)

    def test_length_of_the_light_does_not_matter(self):
        expected = self.pictures("--light", "1,2,3")
        for light in ("2,4,6", "1e200,2e200,3e200", "1e-200,2e-200,3e-200"):
            self.assertEqual(self.pictures("--light", light), expected, light)


if __name__ == "__main__":
    unittest.main()
