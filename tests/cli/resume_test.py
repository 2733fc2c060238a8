"""--existing: frames that are there are kept if this run would write them again, byte for byte; never else."""

import csv
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import unittest

from cli_test_case import SCENE, CliTestCase

KILLS = int(os.environ.get("HYBRIDRT_KILLS", "100"))
FRAMES = 24
RENDER = ("render", SCENE, "-q", "--size", "96x72", "--gl", "off")


def with_usual(*arguments):
    """The command with what `arguments` do not say themselves."""
    usual = [pair for pair in (("--size", "96x72"), ("--gl", "off")) if pair[0] not in arguments]
    return ("render", SCENE, "-q", *(word for pair in usual for word in pair), *arguments)


class ResumeTest(CliTestCase):
    def render(self, *arguments, frames=8, output="out/x.####.png", **more):
        return self.succeed(*with_usual("--frames", str(frames), "-o", output, *arguments), **more)

    def files(self, folder="out"):
        """Of pictures, by name."""
        return {path.name: path.read_bytes() for path in pathlib.Path(self.path(folder)).iterdir()
                if path.suffix not in (".csv", ".json") and not path.name.startswith(".")}

    def run_facts(self, name="out/run.json"):
        with open(self.path(name), encoding="utf-8") as file:
            return json.load(file)

    def rows(self, folder="out"):
        with open(self.path(folder, "timings.csv"), encoding="utf-8", newline="") as file:
            return [int(row["frame"]) for row in csv.DictReader(file)]

    def kept_by(self, *arguments, **more):
        self.render("--resume", *arguments, **more)
        return self.run_facts()["kept_frames"]

    def test_what_is_there_is_kept_and_what_is_missing_comes_back(self):
        self.render()
        whole = self.files()
        self.assertEqual(self.rows(), list(range(1, 9)))
        stamps = {name: os.stat(self.path("out", name)).st_mtime_ns for name in whole}
        for missing in ([], [3], [1, 8], [2, 4, 6], list(range(1, 9))):
            for frame in missing:
                os.unlink(self.path(f"out/x.{frame:04}.png"))
            self.assertEqual(self.kept_by(), 8 - len(missing))
            facts = self.run_facts()
            self.assertEqual((facts["frames"], sorted(map(int, facts["fingerprints"]))), (len(missing), list(range(1, 9))))
            self.assertEqual(self.files(), whole)
            self.assertEqual(self.rows(), list(range(1, 9)))
            for name, stamp in stamps.items():
                if int(name[2:6]) not in missing:
                    self.assertEqual(os.stat(self.path("out", name)).st_mtime_ns, stamp, "written again")
            stamps = {name: os.stat(self.path("out", name)).st_mtime_ns for name in whole}

    def test_a_frame_without_its_row_comes_back(self):
        self.render()
        whole = self.files()
        with open(self.path("out/timings.csv"), encoding="utf-8") as file:
            lines = file.readlines()
        for keep, kept in ((lines[:5] + lines[6:], 7), (lines[:1], 0), (lines, 8), (lines[:-1] + ["8,1"], 7)):
            self.write("out/timings.csv", "".join(keep))
            self.assertEqual(self.kept_by(), kept)
            self.assertEqual(self.rows(), list(range(1, 9)))
            self.assertEqual(self.files(), whole)
        os.unlink(self.path("out/timings.csv"))
        self.assertEqual(self.kept_by(), 8, "somebody removed the table: no reason to render all again")
        self.assertEqual(self.rows(), [])

    def test_numbers_of_an_exr_decide_pixels_and_packing_does_not(self):
        self.render(output="out/x.####.exr", frames=2)
        floats = self.files()
        self.assertEqual(self.kept_by("--compression", "small", output="out/x.####.exr", frames=2), 2)
        self.assertEqual(self.kept_by("--exr", "half", output="out/x.####.exr", frames=2), 0)
        self.assertLess(len(self.files()["x.0001.exr"]), len(floats["x.0001.exr"]))
        self.assertEqual(self.kept_by("--exr", "half", output="out/x.####.exr", frames=2), 2)
        self.assertEqual(self.kept_by(output="out/x.####.exr", frames=2), 0)
        self.assertEqual(self.files(), floats)

    def test_anything_that_decides_pixels_renders_again(self):
        self.render(frames=2)
        for change in (("--light", "1,2,3"), ("--fov", "30"), ("--method", "raytrace"), ("--shadows", "rays"),
                       ("--reflection-depth", "1"), ("--size", "50x40"), ("--background", "1,0,0"), ("--samples", "2"),
                       ("--samples", "2", "--adaptive"),
                       ("--alpha",), ("--ground",), ("--accel", "kdtree"), ("--reflection-percent", "50"), ("--gl", "egl"),
                       ("--up-axis", "y", "--crop", "1,2,9,9")):
            with self.subTest(change=change):
                self.render(frames=2)  # as at first
                os.unlink(self.path("out/x.0002.png"))
                kept = self.kept_by(*change, frames=2)
                self.assertEqual(kept, 0)
                again = self.files()
                self.render(*change, frames=2, output="fresh/x.####.png")
                self.assertEqual(again, self.files("fresh"))

    def test_what_does_not_decide_pixels_keeps(self):
        self.render(frames=2)
        for change in (("--threads", "1"), ("--frames-in-flight", "1"), ("--max-memory", "2G"), ("--sequence", "1-2")):
            self.assertEqual(self.kept_by(*change, frames=2), 2, change)

    def test_a_picture_that_is_not_whole_or_not_ours_renders_again(self):
        self.render(frames=1, output="out/x.png")
        whole = self.files()
        path = self.path("out/x.png")
        for damage in (whole["x.png"][:-20], whole["x.png"][:100], b"", b"GIF89a", whole["x.png"].replace(b"IDAT", b"IDAX", 1)):
            with open(path, "wb") as file:
                file.write(damage)
            self.assertEqual(self.kept_by(frames=1, output="out/x.png"), 0)
            self.assertEqual(self.files(), whole)

    def test_formats_without_metadata_have_a_record_beside_them(self):
        for extension in ("bmp", "hdr", "tga", "ppm"):
            output = f"{extension}/x.####.{extension}"
            self.render(frames=3, output=output)
            whole = self.files(extension)
            self.assertEqual(len(whole), 6, list(whole))
            os.unlink(self.path(extension, f"x.0002.{extension}"))
            self.render("--resume", frames=3, output=output)
            self.assertEqual(self.run_facts(f"{extension}/run.json")["kept_frames"], 2)
            with open(self.path(extension, f"x.0001.{extension}"), "ab") as file:
                file.write(b"\0")  # no longer what the record vouches for
            self.render("--resume", frames=3, output=output)
            self.assertEqual(self.run_facts(f"{extension}/run.json")["kept_frames"], 2)
            self.assertEqual(self.files(extension), whole)
        for extension in ("png", "exr", "tif", "jpg"):
            output = f"{extension}/x.####.{extension}"
            self.render(frames=2, output=output)
            self.assertEqual(len(self.files(extension)), 2)
            self.render("--resume", frames=2, output=output)
            self.assertEqual(self.run_facts(f"{extension}/run.json")["kept_frames"], 2, extension)

    def test_every_aov_counts(self):
        self.render("--aov", "id,depth", frames=2)
        whole = self.files()
        self.assertEqual(self.kept_by("--aov", "id,depth", frames=2), 2)
        self.assertEqual(self.kept_by("--aov", "id", frames=2), 2)
        self.assertEqual(self.kept_by("--aov", "id,normal", frames=2), 0)
        os.unlink(self.path("out/x.depth.0001.png"))
        self.assertEqual(self.kept_by("--aov", "id,depth", frames=2), 1)
        self.assertLessEqual(whole.items(), self.files().items())

        self.render("--aov", "id", frames=1, output="layers/x.exr")
        for layers, kept in (("id", 1), ("depth", 0), ("depth", 1)):
            self.render("--resume", "--aov", layers, frames=1, output="layers/x.exr")
            self.assertEqual(self.run_facts("layers/run.json")["kept_frames"], kept, layers)

    def test_the_contact_sheet_is_the_same(self):
        self.render("--contact-sheet", "out/sheet.png", frames=30)
        whole = self.files()
        for frame in (1, 2, 17):
            os.unlink(self.path(f"out/x.{frame:04}.png"))
        os.unlink(self.path("out/sheet.png"))
        self.assertGreater(self.kept_by("--contact-sheet", "out/sheet.png", frames=30), 5)
        self.assertEqual(self.files(), whole)

    def test_a_sequence_in_another_order_and_a_still_camera(self):
        still = ("--eye", "3,2,5", "--target", "0,0,0")
        self.succeed(*RENDER, "--frames", "7,1-3,5", "-o", "out/x.####.png", *still)
        whole = self.files()
        os.unlink(self.path("out/x.0001.png"))
        os.unlink(self.path("out/x.0003.png"))
        self.succeed(*RENDER, "--frames", "7,1-3,5", "-o", "out/x.####.png", *still, "--resume")
        self.assertEqual(self.run_facts()["kept_frames"], 3)
        self.assertEqual(self.files(), whole)
        self.assertEqual(self.rows(), [7, 1, 2, 3, 5])

    def test_refuse_names_the_first(self):
        self.succeed(*RENDER, "--frames", "4-4", "-o", "out/x.0004.png")
        before = self.files()
        self.fail_with(2, *RENDER, "--frames", "6", "-o", "out/x.####.png", "--existing", "refuse", says="out/x.0004.png")
        self.assertEqual(self.files(), before)
        self.succeed(*RENDER, "--frames", "1-3", "-o", "out/x.####.png", "--existing", "refuse")
        self.fail_with(2, *RENDER, "--existing", "maybe", says="resume")
        self.fail_with(2, *RENDER, "-o", "-", "--resume", says="-o -")

    def test_events_and_the_closing_line_tell(self):
        self.render(frames=3)
        os.unlink(self.path("out/x.0002.png"))
        done = self.succeed("render", SCENE, "--size", "96x72", "--gl", "off", "--frames", "3", "-o", "out/x.####.png", "--resume", "--json")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([event["frame"] for event in events if event["event"] == "kept"], [1, 3])
        self.assertEqual([(e["frames"], e["kept"]) for e in events if e["event"] == "end"], [(1, 2)])
        done = self.succeed("render", SCENE, "--size", "96x72", "--gl", "off", "--frames", "3", "-o", "out/x.####.png", "--resume")
        self.assertIn("0 frames, 3 kept", done.stdout)

    def test_a_full_disk_then_space_again(self):
        self.render()
        whole = self.files("out")

        def little_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        self.fail_with(5, *RENDER, "--frames", "8", "-o", "disk/x.####.png", preexec_fn=little_room)
        self.assertEqual(self.files("disk") if os.path.exists(self.path("disk")) else {}, {})
        self.render("--resume", output="disk/x.####.png")
        self.assertEqual(self.files("disk"), whole)

    def test_killed_at_any_moment_it_goes_on(self):
        """Killed at random moments until it is through; then every byte is that of a run nobody disturbed."""
        self.render(frames=FRAMES, output="whole/x.####.png")
        whole = self.files("whole")
        rng = random.Random(5)
        kills = resumed = 0
        run = 0
        while kills < KILLS:
            run += 1
            output = f"killed{run}/x.####.png"
            while True:
                process = self.start(*RENDER, "--frames", str(FRAMES), "-o", output, "--resume")
                try:
                    process.communicate(timeout=rng.uniform(0, 0.6))
                except subprocess.TimeoutExpired:
                    process.send_signal(rng.choice((signal.SIGKILL, signal.SIGTERM)))
                    process.communicate(timeout=60)
                if process.returncode == 0:
                    break
                kills += 1
                self.assertIn(process.returncode, (-signal.SIGKILL, -signal.SIGTERM, 143))
            done = self.succeed(*RENDER, "--frames", str(FRAMES), "-o", output, "--resume")
            self.assertEqual(done.stderr, "")
            resumed += 1
            self.assertEqual(self.files(f"killed{run}"), whole)
            self.assertEqual(self.rows(f"killed{run}"), list(range(1, FRAMES + 1)))
        self.assertGreater(resumed, 0)


if __name__ == "__main__":
    unittest.main()
