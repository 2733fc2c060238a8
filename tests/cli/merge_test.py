"""Shards of a sequence in one folder: joined, they are what one run writes, and what does not fit is said."""

import csv
import itertools
import json
import os
import pathlib
import shutil
import signal
import time
import unittest

from cli_test_case import SCENE, CliTestCase

RENDER = ("render", SCENE, "-q", "--size", "96x72", "--gl", "off")
SHARDS = ("1-8", "9-16", "17-24")
WHOLE = ("--sequence", "1-24")
# Fields of run.json that no two runs share.
MACHINE = ("load_ms", "accel_build_ms", "ready_ms", "rendering_ms", "waited_ms", "drain_ms", "write_ms", "frames_per_second",
           "rendered_per_second", "written_per_second", "peak_memory_mib", "date")


def untimed(rows):
    """Rows of a timings CSV without what a clock told."""
    return [{name: value for name, value in row.items() if not name.endswith("_ms")} for row in rows]


class MergeTest(CliTestCase):
    def shard(self, frames, *arguments, sequence=WHOLE, output="out/x.####.png", usual=RENDER):
        return self.succeed(*usual, *arguments, "-o", output, "--frames", frames, *sequence)

    def pictures(self, folder):
        return {path.name: path.read_bytes() for path in pathlib.Path(self.path(folder)).glob("**/*.png")}

    def rows(self, name):
        with open(self.path(name), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def facts(self, name):
        return json.loads(self.read(name))

    def merge(self, folder="out"):
        done = self.succeed("merge", folder)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def assert_same_run(self, folder, whole):
        """Pictures to the byte; tables, but for clocks."""
        self.assertEqual(self.pictures(folder), self.pictures(whole))
        self.assertEqual(untimed(self.rows(f"{folder}/timings.csv")), untimed(self.rows(f"{whole}/timings.csv")))
        texts = []
        for name in (folder, whole):
            facts = self.facts(f"{name}/run.json")
            self.assertEqual(facts.pop("missing", None), None)
            facts.pop("shards", None)
            for field in MACHINE:
                self.assertIsInstance(facts[field], (int, float, str))
                facts[field] = 0
            texts.append(json.dumps(facts, indent=1).replace(f'"{name}/', '"FOLDER/'))
        self.assertEqual(texts[0], texts[1])

    def test_three_shards_in_any_order_are_one_run(self):
        self.succeed(*RENDER, "-o", "whole/x.####.png", "--frames", "1-24")
        for order in itertools.permutations(SHARDS):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            for frames in order:
                self.shard(frames)
            self.assertIn("24 of 24 frames of 1-24, by 3 runs", self.merge())
            self.assert_same_run("out", "whole")
        shards = self.facts("out/run.json")["shards"]
        self.assertEqual([shard["frames"] for shard in shards], [8, 8, 8])
        self.assertEqual([shard["file"] for shard in shards],
                         ["run.0001-0008.json", "run.0009-0016.json", "run.0017-0024.json"])
        self.assert_same_run("out", "whole")
        self.merge()  # once more: the joined run.json is no part
        self.assert_same_run("out", "whole")

    def test_one_is_killed_and_resumed(self):
        # Slow enough to be killed in the middle.
        usual = ("render", SCENE, "-q", "--size", "400x300", "--gl", "off", "--threads", "1")
        self.succeed(*usual, "-o", "whole/x.####.png", "--frames", "1-24")
        self.shard("17-24", usual=usual)
        self.shard("1-8", usual=usual)
        killed = self.start(*usual, "-o", "out/x.####.png", "--frames", "9-16", *WHOLE)
        deadline = time.monotonic() + 60
        table = "out/timings.0009-0016.csv"  # there from the start, with its rows from the first frame
        while not (os.path.exists(self.path(table)) and self.rows(table)) and time.monotonic() < deadline:
            time.sleep(0.002)
        killed.send_signal(signal.SIGKILL)
        killed.communicate(timeout=60)
        self.assertFalse(os.path.exists(self.path("out/run.0009-0016.json")), "it was killed in the middle")

        done = self.fail_with_gaps()
        self.assertIn("8 of 24 frames are missing: 9-16", done.stderr)
        self.assertEqual(self.run_binary("merge", "out", "--missing").stdout, "9-16\n")
        timed = {int(row["frame"]) for row in self.rows(table)}
        self.assertTrue(timed)
        self.shard("9-16", "--existing", "resume", usual=usual)
        self.assertEqual(self.facts("out/run.0009-0016.json")["kept_frames"], len(timed))
        self.merge()
        self.assert_same_run("out", "whole")

    def fail_with_gaps(self, *arguments):
        done = self.run_binary("merge", "out", *arguments)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done

    def test_gaps_are_listed_and_can_be_rendered_as_listed(self):
        self.shard("1-8")
        self.shard("9-16")
        for frame in (3, 5, 6):
            os.unlink(self.path(f"out/x.{frame:04}.png"))
        with open(self.path("out/x.0009.png"), "r+b") as file:
            file.truncate(200)
        done = self.fail_with_gaps()
        self.assertIn("12 of 24 frames are missing: 3,5-6,9,17-24", done.stderr)
        self.assertIn("--frames 3,5-6,9,17-24 --sequence 1-24 --resume", done.stderr)
        self.assertEqual(len(self.rows("out/timings.csv")), 12)
        self.assertEqual(self.facts("out/run.json")["missing"], "3,5-6,9,17-24")
        missing = self.run_binary("merge", "out", "--missing").stdout.strip()
        self.shard(missing, "--resume")
        self.assertIn("out/run.0003+0005-0006+0009+0017-0024.json", ["out/" + name for name in self.files("out")])
        self.succeed(*RENDER, "-o", "whole/x.####.png", "--frames", "1-24")
        self.merge()
        self.assert_same_run("out", "whole")

    def test_interleaved_shards_have_tables_of_their_own(self):
        for first in (1, 2, 3):
            self.shard(f"{first}-10:3", sequence=("--sequence", "1-10"))
        self.succeed(*RENDER, "-o", "whole/x.####.png", "--frames", "1-10")
        self.assertIn("timings.0001-0010x3.csv", self.files("out"))
        self.merge()
        self.assert_same_run("out", "whole")
        self.shard("1-9:2", sequence=("--sequence", "1-10"))
        self.assertIn("run.0001-0009x2.json", self.files("out"), "not the name of 1-9")
        self.merge()
        self.assert_same_run("out", "whole")

    def test_what_does_not_belong_together_is_refused(self):
        for other, says in ((("--size", "64x48"), "settings: width is 96 and 64"), (("--light", "1,2,3"), "lights"),
                            (("--reflection-percent", "30"), "scenes"), (("--fov", "20"), "cameras"),
                            (("--background", "1,0,0"), "backgrounds"), (("--samples", "2"), "settings: samples is 1 and 2"),
                            (("--aov", "id"), "settings: aovs")):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            self.shard("1-8")
            replaced = tuple(word for word in RENDER if word not in ("--size", "96x72")) if "--size" in other else RENDER
            self.shard("9-16", *other, usual=replaced)
            before = self.files("out")
            self.fail_with(3, "merge", "out", says=("run.0001-0008.json", "run.0009-0016.json", says, "render one of them again"))
            self.assertEqual(self.files("out"), before, "nothing was written")
        shutil.rmtree(self.path("out"))
        self.shard("1-8")
        self.shard("9-16", sequence=("--sequence", "1-16"))
        self.fail_with(3, "merge", "out", says="settings: sequence is [1,24] and [1,16]")

    def test_frames_of_another_form_are_listed(self):
        self.shard("1-8")
        self.shard("9-16", "--accel", "kdtree")
        self.shard("17-24")
        done = self.fail_with_gaps()
        self.assertIn("8 of 24 frames were made otherwise than the rest: 9-16", done.stderr)
        self.assertIn("rays by kdtree", done.stderr)
        event = json.loads(self.fail_with_gaps("--json").stdout)
        self.assertEqual([made["frames"] for made in event["made_otherwise"]], ["9-16"])
        self.assertEqual((event["frames"], event["missing"], event["runs"]), (24, "", 3))
        self.shard("9-16", "--resume")
        self.merge()

    def test_frames_of_another_renderer_are_listed(self):
        if self.run_binary("doctor").returncode != 0:
            self.skipTest("there is no OpenGL here")
        for frames, gl in (("1-10", "off"), ("11-12", "egl"), ("13-24", "off")):
            usual = tuple(word if word != "off" else gl for word in RENDER)
            self.shard(frames, usual=usual)
        done = self.fail_with_gaps()
        self.assertIn("2 of 24 frames were made otherwise than the rest: 11-12 by hybridrt=", done.stderr)
        self.assertIn("form=gl, ", done.stderr)

    def test_a_moving_light_and_aovs(self):
        path = {"keyframes": [{"frame": 1, "eye": [2, 1, 5], "target": [0, 0, 0], "light": [1, 2, 1]},
                              {"frame": 24, "eye": [5, 2, 0], "target": [0, 0, 0], "light": [-1, 2, 1]}]}
        self.write("path.json", json.dumps(path))
        more = ("--camera", "path.json", "--aov", "id,depth")
        for frames in SHARDS:
            self.shard(frames, *more, output="deep/{frame}/x.####.png")
        self.succeed(*RENDER, *more, "-o", "whole/{frame}/x.####.png", "--frames", "1-24")
        self.assertEqual(len(self.pictures("deep")), 72)
        self.merge("deep")
        self.assert_same_run("deep", "whole")
        os.unlink(self.path("deep/7/x.depth.0007.png"))
        done = self.run_binary("merge", "deep", "--missing")
        self.assertEqual((done.returncode, done.stdout), (1, "7-7\n"))

    def test_two_sequences_in_one_folder(self):
        for name, frames in (("x", "1-12"), ("y", "1-12"), ("x", "13-24"), ("y", "13-24")):
            self.shard(frames, output=f"out/{name}.####.png")
        self.assertIn("x.0001.png", self.files("out"))
        self.assertIn("y.run.0001-0012.json", self.files("out"), "the other's tables are kept")
        self.assertEqual(self.merge().count("24 of 24 frames"), 2)
        self.assertEqual(self.facts("out/run.json")["outputs"]["pattern"], "out/x.####.png")
        self.assertEqual(self.facts("out/y.run.json")["outputs"]["pattern"], "out/y.####.png")
        self.assertEqual(len(self.rows("out/y.timings.csv")), 24)
        self.fail_with(2, "merge", "out", "--missing", says="2 sequences")

    def test_a_folder_that_was_moved(self):
        for frames in SHARDS:
            self.shard(frames, output=self.path("out/x.####.png"))
        os.rename(self.path("out"), self.path("elsewhere"))
        self.assertIn("24 of 24", self.merge("elsewhere"))
        self.assertEqual(len(self.rows("elsewhere/timings.csv")), 24)

    def test_lost_rows_are_said(self):
        for frames in SHARDS:
            self.shard(frames)
        lines = self.read("out/timings.0009-0016.csv").decode().splitlines(keepends=True)
        self.write("out/timings.0009-0016.csv", "".join(lines[:3] + lines[5:]))
        done = self.succeed("merge", "out")
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("warning: out/timings.csv lacks the times of frames 11-12", done.stderr)
        self.assertTrue(done.stderr.endswith(" [times-missing]\n"), done.stderr)

    def test_no_parts(self):
        self.fail_with(3, "merge", "nowhere", says="nowhere")
        os.makedirs(self.path("out"))
        self.fail_with(3, "merge", "out", says=("no run.A-B.json", "--sequence"))
        self.succeed(*RENDER, "-o", "out/x.png")
        self.fail_with(3, "merge", "out", says="no run.A-B.json")
        for text in ("", "{}", "[1]", '{"outputs":{"part":"x"}}', "null"):
            self.write("out/run.0001-0002.json", text)
            self.fail_with(3, "merge", "out", says=("run.0001-0002.json", "not a run file"))


if __name__ == "__main__":
    unittest.main()
