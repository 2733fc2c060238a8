"""scripts/slurm on a real Slurm of one node: an array with a killed task, and one that is lost, become one run.

Called with the binary and the project's folder. Exit code 77, and why, where Slurm is not installed."""

import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

from small_slurm import SmallSlurm, lacks

BINARY = os.path.abspath(sys.argv.pop(1))
ROOT = os.path.abspath(sys.argv.pop(1))
SKIPPED = 77

# Half a second a frame, so that a task can be met at work.
RENDER = ("scene:spheres,triangles=2000", "--size", "320x240", "--samples", "16")


class SlurmTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        os.makedirs(self.path("slurm"))
        self.slurm = SmallSlurm(self.path("slurm"))
        self.addCleanup(self.slurm.stop)
        self.slurm.start()

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def submit(self, *arguments):
        script = os.path.join(ROOT, "scripts", "slurm", "submit.sh")
        done = self.slurm.run(script, *arguments, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.tell(done.stdout)
        return done.stdout

    def tell(self, text):
        """The output of the test is shown in docs/farm.md."""
        print(text.replace(self.folder + "/", ""), end="", flush=True)

    def logs(self):
        return "\n".join(f"--- {path.name}\n{path.read_text()}" for path in sorted(pathlib.Path(self.path("out/farm")).glob("*.log")))

    def kill_task(self, frames):
        """Kills the render of those frames once its first picture is there."""
        first = self.path("out", f"x.{int(frames.split('-')[0]):04}.png")
        self.slurm.wait_for(lambda: os.path.exists(first), f"{first}\n{self.logs()}", 120)
        for entry in pathlib.Path("/proc").iterdir():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
            except OSError:
                continue
            if words[:1] == [BINARY.encode()] and frames.encode() in words and self.path("out/x.####.png").encode() in words:
                os.kill(int(entry.name), signal.SIGKILL)
                return
        self.fail(f"no render of frames {frames} is running\n{self.logs()}")

    def untimed(self, name):
        with open(self.path(name), encoding="utf-8", newline="") as file:
            return [{k: v for k, v in row.items() if not k.endswith("_ms")} for row in csv.DictReader(file)]

    def test_an_array_with_a_killed_task_is_one_run(self):
        self.tell(self.slurm.run("sinfo", "--version").stdout)
        self.submit("-o", self.path("out/x.####.png"), "--sequence", "1-24", "--chunk", "6", "--at-once", "2", "--cpus", "1",
                    "--program", BINARY, *RENDER)
        self.kill_task("7-12")
        self.tell("killed: the render of frames 7-12\n")
        self.slurm.wait_for(self.slurm.is_empty, "the jobs to end", 240)
        self.assertIn("7-12, try 2", self.logs())
        whole = subprocess.run([BINARY, "render", *RENDER, "-q", "--gl", "off", "--frames", "1-24", "-o", self.path("whole/x.####.png")],
                               capture_output=True, text=True, timeout=300)
        self.assertEqual((whole.returncode, whole.stderr), (0, ""))
        self.assert_same()
        with open(self.path("out/run.json"), encoding="utf-8") as file:
            facts = json.load(file)
        self.assertIsNone(facts["missing"])
        self.assertGreater(sum(shard["kept_frames"] for shard in facts["shards"]), 0, "the killed task went on, not anew")
        self.tell(pathlib.Path(self.path("out/farm/task.1.1.log")).read_text())
        self.tell(pathlib.Path(self.path("out/farm/merge.1.log")).read_text())

        # A shard that is lost comes back.
        for frame in (14, 15, 16, 23):
            os.unlink(self.path(f"out/x.{frame:04}.png"))
        self.tell("removed: frames 14-16 and 23\n")
        self.assertIn("frames 14-16,23: 2 tasks", self.submit("--again", self.path("out"), "--chunk", "3"))
        self.slurm.wait_for(self.slurm.is_empty, "the jobs to end", 240)
        self.assert_same()
        self.assertIn("nothing is missing", self.submit("--again", self.path("out")))
        self.tell("pictures equal those of one run, byte for byte; rows too, times aside\n")

    def assert_same(self):
        names = [f"x.{frame:04}.png" for frame in range(1, 25)]
        self.assertEqual(sorted(path.name for path in pathlib.Path(self.path("out")).glob("*.png")), names, self.logs())
        for name in names:
            self.assertEqual(pathlib.Path(self.path("out", name)).read_bytes(),
                             pathlib.Path(self.path("whole", name)).read_bytes(), name)
        rows, expected = self.untimed("out/timings.csv"), self.untimed("whole/timings.csv")
        lost = len(expected) - len(rows)  # of pictures that the kill kept from getting their rows
        self.assertLessEqual(lost, 2)
        there = {row["frame"] for row in rows}
        self.assertEqual(rows, [row for row in expected if row["frame"] in there])


if __name__ == "__main__":
    if lacks():
        print(f"skipped: no {', '.join(lacks())} here; apt-get install slurm-wlm munge brings them")
        sys.exit(SKIPPED)
    unittest.main()
