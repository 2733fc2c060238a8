"""Runs at the same time: no file is written by two of them, and disjoint frames may be rendered in parallel."""

import glob
import os
import signal
import time
import unittest

from cli_test_case import SCENE, SMALL, CliTestCase

CPU = (SCENE, "--threads", "1", "-q")
QUICK = (*CPU, *SMALL, "--method", "raytrace")


class TwoRunsTest(CliTestCase):
    def setUp(self):
        super().setUp()
        self.running = []
        self.addCleanup(self.stop_all)

    def stop_all(self):
        for process in self.running:
            process.kill()
            process.communicate(timeout=60)

    def start_run(self, *arguments, until):
        """A run that has written such a file."""
        process = self.start("render", *arguments)
        self.running.append(process)
        deadline = time.monotonic() + 60
        while not glob.glob(self.path(until)):
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return process

    def start_long(self, *arguments):
        return self.start_run(*QUICK, "--frames", "1-1000000", *arguments, until="out/x.0001.png")

    def refuse(self, *arguments, says):
        done = self.fail_with(5, "render", *QUICK, *arguments, says=("another run is writing", says, "; wait for it"))
        return done.stderr

    def test_the_same_frames_are_refused(self):
        self.start_long("-o", "out/x.####.png")
        os.symlink("out", self.path("alias"))
        for frames, pattern in (("1-5", "out/x.####.png"), ("999999-1000001", "out/x.####.png"),
                                ("7-99:3", "./out/../out/x.#.png"), ("5-5", "alias/x.####.png"),
                                ("2000000-2000001,77", "out/x.png")):
            self.refuse("--frames", frames, "-o", pattern, says="alias/x.#" if "alias" in pattern else "out/x.#.png")

    def test_the_same_files_under_other_names_are_refused(self):
        self.start_long("-o", "out/x.####.png", "--aov", "depth", "--contact-sheet", "out/sheet.png")
        for frames, name in (("1-1", "out/x.0007.png"), ("1-3", "out/x.000#.png"), ("70-72", "out/x.0{frame}.png"),
                             ("9-9", "out/x.depth.0009.png"), ("1-1", "out/sheet.png")):
            self.refuse("--frames", frames, "-o", name, says=name.replace("000#", "000").split(".0")[0])
        self.refuse("-o", "o/y.png", "--contact-sheet", "out/x.0003.png", says="out/x.0003.png")
        for frames, name in (("1-1", "out/x2.0007.png"), ("1-1", "out/x.2000007.png"), ("1-3", "out/x_v2.####.png"),
                             ("1-3", "out/y.####.exr")):
            self.succeed("render", *QUICK, "--frames", frames, "-o", name)

    def test_disjoint_frames_are_fine(self):
        part = ("--sequence", "1-3000000", "-o", "out/x.####.png")
        self.start_long(*part)
        done = self.succeed("render", *QUICK, "--frames", "1000001-1000003", *part)
        self.assertEqual(done.stderr, "")
        self.assertIn("out/timings.1000001-1000003.csv", self.files())

    def test_interleaved_frames_are_fine(self):
        self.start_run(*QUICK, "--frames", "1-1001:2", "--sequence", "1-2000", "-o", "out/x.####.png",
                       until="out/x.0001.png")
        self.succeed("render", *QUICK, "--frames", "2-8:2", "--sequence", "1-2000", "-o", "out/x.####.png")
        self.refuse("--frames", "2-9:7", "--sequence", "1-2000", "-o", "out/x.####.png", says="out/x.#.png")

    def test_tables_make_way(self):
        # Without --sequence both runs would write timings.csv and run.json: the second one's get its frames' range.
        self.start_long("-o", "out/x.####.png")
        for frames, name in (("1000001-1000002", "out/x.####.png"), ("1-2", "out/y.####.png")):
            done = self.succeed("render", *QUICK, "--frames", frames, "-o", name)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn("warning: another run is writing out/run.json or its timings", done.stderr)
            self.assertTrue(done.stderr.endswith(" [tables-renamed]\n"), done.stderr)
            tables = {"out/timings.{:04}-{:04}.csv", "out/run.{:04}-{:04}.json"}
            self.assertTrue({t.format(*map(int, frames.split("-"))) for t in tables} <= set(self.files()), self.files())

    def test_files_asked_for_by_name_are_refused(self):
        self.start_long("-o", "out/x.####.png", "--timings", "t.csv", "--contact-sheet", "s.png")
        self.refuse("-o", "a/y.png", "--timings", "t.csv", says="t.csv")
        self.refuse("-o", "a/y.png", "--contact-sheet", "./s.png", says="s.png")
        self.succeed("render", *QUICK, "-o", "a/y.png")

    def test_one_picture_without_a_number(self):
        self.start_run(*CPU, "--size", "2000x2000", "--method", "reference", "--frames", "7-7", "-o", "out/x.png",
                       until="out/.timings.csv.*")
        self.refuse("--frames", "8-8", "-o", "out/x.png", says="out/x.png")

    def test_nothing_is_left(self):
        for number in (signal.SIGTERM, signal.SIGKILL):
            process = self.start_long("-o", "out/x.####.png")
            process.send_signal(number)
            process.communicate(timeout=60)
            self.assertEqual(os.path.exists(self.path("out/.hybridrt.lock")), number == signal.SIGKILL)
            self.succeed("render", *QUICK, "--frames", "3", "-o", "out/x.####.png")
            self.assertFalse(os.path.exists(self.path("out/.hybridrt.lock")), "a killed run's lock does not stop others")
            os.remove(self.path("out/x.0001.png"))

    def as_nobody(self, picture):
        return self.run_binary("render", *QUICK, "-o", picture, user=65534, group=65534, extra_groups=[])

    @unittest.skipUnless(os.geteuid() == 0, "needs another user to be")
    def test_another_users_lock(self):
        os.chmod(self.folder, 0o755)
        if self.run_binary("--help", user=65534, group=65534, extra_groups=[]).returncode != 0:
            self.skipTest("another user cannot start the program")
        os.makedirs(self.path("out"))
        os.chmod(self.path("out"), 0o777)
        lock = self.write("out/.hybridrt.lock", "")
        os.chmod(lock, 0o644)
        done = self.as_nobody("out/y.png")
        self.assertEqual((done.returncode, done.stderr), (0, ""), "nobody holds it: it goes")
        self.assertFalse(os.path.exists(lock))
        # In use: both users' runs share it.
        self.start_long("-o", "out/x.####.png")
        self.assertEqual(self.as_nobody("out/z.png").returncode, 0)
        done = self.as_nobody("out/x.0007.png")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("another run is writing out/x.0007.png", done.stderr)
        # In use and closed to others, as older versions made it; or in a folder where only owners remove.
        os.chmod(lock, 0o644)
        for mode in (0o777, 0o1777):
            os.chmod(self.path("out"), mode)
            done = self.as_nobody("out/z.png")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (5, 1), done.stderr)
            self.assertIn(".hybridrt.lock beside it belongs to a run of another user (number 0)", done.stderr)

    def test_temporary_files_of_killed_runs_go(self):
        os.makedirs(self.path("out"))
        stale = ("x.0002.png", "x.depth.0003.png", "timings.csv", "run.json")
        kept = ("x.0009.png", "y.0002.png", "x.depth.0009.png")
        for name in (*stale, *kept):
            self.write(f"out/.{name}.tmp-99999999-7", "half")
        self.succeed("render", *QUICK, "--frames", "3", "--aov", "depth", "-o", "out/x.####.png")
        self.assertEqual([name for name in self.files("out") if name.startswith(".")],
                         sorted(f".{name}.tmp-99999999-7" for name in kept))

    def test_many_short_runs_in_one_folder(self):
        # Runs come and go, and the lock file with them; each has its own frames.
        runs = [self.start("render", *CPU, "--size", "8x8", "--method", "raytrace", "--frames", f"{n}-{n}",
                           "--sequence", "1-40", "-o", "out/x.####.png") for n in range(1, 13)]
        for run in runs:
            _, errors = run.communicate(timeout=120)
            self.assertEqual((run.returncode, errors), (0, ""))
        self.assertEqual(len(self.files("out")), 36)


if __name__ == "__main__":
    unittest.main()
