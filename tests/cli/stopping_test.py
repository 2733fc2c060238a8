"""Signals, closed pipes and endless sequences: finished files are complete, no file is torn."""

import json
import os
import signal
import subprocess
import time
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase, Png


class StoppingTest(CliTestCase):
    def start_long(self, *arguments, **keywords):
        return self.start("render", SCENE, *SMALL, "-q", "--frames", "1000000000", "-o", "x.####.png", *arguments,
                          **keywords)

    def wait_for_frames(self, process, count):
        deadline = time.monotonic() + 60
        while len([name for name in os.listdir(self.folder) if name.endswith(".png")]) < count:
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def expect_whole(self):
        """Every frame is a complete picture, and the CSV has one row per frame, in order."""
        names = [name for name in self.files() if name.endswith(".png") and not name.startswith(".")]
        for name in names:
            Png.read(self.path(name))
        lines = self.read("timings.csv").decode().splitlines()
        self.assertEqual([int(line.split(",")[0]) for line in lines[1:]], list(range(1, len(names) + 1)))
        self.assertTrue(all(line.count(",") == lines[0].count(",") for line in lines))
        self.assertEqual([name for name in self.files() if name.startswith(".")], [], "temporary files")

    def test_signals_finish_the_frame(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(number):
                process = self.start_long()
                self.wait_for_frames(process, 3)
                process.send_signal(number)
                output, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, code, errors)
                self.assertEqual(output, "")
                self.expect_whole()
                self.assertIn("run.json", self.files())
                for name in self.files():
                    os.remove(self.path(name))

    def test_stopped_json_ends_with_an_event(self):
        process = self.start_long("--json")
        self.wait_for_frames(process, 2)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=60)
        events = [json.loads(line) for line in output.splitlines()]
        self.assertEqual((events[-1]["event"], events[-1]["stopped"]), ("end", True))
        self.assertEqual((events[-1]["state"], events[-1]["exit_code"]), ("stopped", 130))
        self.assertEqual(events[-1]["frames"], len(events) - 2)

    def test_a_signal_asks_where_it_is(self):
        process = self.start_long()
        self.wait_for_frames(process, 3)
        for _ in range(20):
            process.send_signal(signal.SIGUSR1)
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 143)
        lines = errors.splitlines()
        self.assertGreater(len(lines), 0)
        for line in lines:
            self.assertRegex(line, r"^hybridrt: rendering, \d+ of 1000000000 frames are done, \d+ s since the start$")
        self.expect_whole()

    def test_a_second_signal_ends_at_once(self):
        # A picture so large that finishing it takes far longer than stopping.
        process = self.start("render", "scene:spheres,triangles=200000", "--size", "8000x6000", "--method",
                             "reference", "-o", "big.png", "-q")
        deadline = time.monotonic() + 60
        while not [name for name in self.files() if name.startswith(".timings")]:  # it is about to render
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=5)
        self.assertIn(process.returncode, (130, -signal.SIGINT))
        self.assertNotIn("big.png", self.files())

    def test_killed_at_any_moment_every_final_name_is_whole(self):
        for wait in (1, 4, 7):
            process = self.start_long()
            self.wait_for_frames(process, wait)
            process.kill()
            process.communicate(timeout=60)
            for name in self.files():
                if not name.startswith(".") and name != "timings.csv":
                    self.assertTrue(name.endswith(".png"), f"{name} is not a complete file")
                    Png.read(self.path(name))
            for name in self.files():
                os.remove(self.path(name))

    def test_killed_the_csv_has_whole_rows_of_finished_frames(self):
        process = self.start_long()
        deadline = time.monotonic() + 60
        rows = []
        while len(rows) < 5:
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
            rows = self.read("timings.csv").decode().splitlines()[1:] if "timings.csv" in self.files() else []
        process.kill()
        process.communicate(timeout=60)
        text = self.read("timings.csv").decode()
        lines = text.splitlines()
        self.assertGreater(len(lines), 5)
        self.assertTrue(text.endswith("\n"))
        self.assertEqual({line.count(",") for line in lines}, {lines[0].count(",")})
        frames = [int(line.split(",")[0]) for line in lines[1:]]
        self.assertEqual(frames, list(range(1, len(frames) + 1)))
        self.assertTrue({f"x.{frame:04}.png" for frame in frames} <= set(self.files()))

    # 10^9 frames take no more memory than a few: limited to what fifty frames used.
    def test_memory_does_not_grow_with_the_sequence(self):
        def peak_kib(pid):
            with open(f"/proc/{pid}/status", encoding="ascii") as status:
                return int(next(line for line in status if line.startswith("VmHWM")).split()[1])

        process = self.start_long("--threads", "1")
        self.wait_for_frames(process, 30)
        early = peak_kib(process.pid)
        self.wait_for_frames(process, 200)
        late = peak_kib(process.pid)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertLess(late, early + 10 * 1024, "KiB")

    def test_closed_standard_output(self):
        for arguments in (("--json",), ("--timings", "-"), ()):
            with self.subTest(arguments):
                read_end, write_end = os.pipe()
                os.close(read_end)
                process = self.start("render", SCENE, *SMALL, "--frames", "3", "-o", "c.####.png", *arguments,
                                     stdout=write_end)
                os.close(write_end)
                _, errors = process.communicate(timeout=60)
                self.assertIn(process.returncode, (0, 5), errors)
                self.assertNotIn("internal", errors)
                for name in self.files():
                    if name.endswith(".png"):
                        Png.read(self.path(name))

    def test_no_standard_output_at_all(self):
        command = [BINARY, "render", SCENE, *SMALL, "-o", "n.png"]
        done = subprocess.run(["/bin/sh", "-c", 'exec "$@" >&-', "sh", *command], cwd=self.folder, timeout=60,
                              stderr=subprocess.PIPE, text=True)
        self.assertIn(done.returncode, (0, 5), done.stderr)
        Png.read(self.path("n.png"))


if __name__ == "__main__":
    unittest.main()
