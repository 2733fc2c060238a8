"""scripts/slurm without a Slurm: what is submitted, told by an sbatch that only writes down its arguments.

Called with the binary and the project's folder."""

import os
import subprocess
import sys
import tempfile
import unittest

BINARY = os.path.abspath(sys.argv.pop(1))
ROOT = os.path.abspath(sys.argv.pop(1))


class SubmitTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("bin/sbatch", '#!/bin/sh\necho "$@" >> "$SUBMITTED"\nwc -l < "$SUBMITTED"\n', 0o755)

    def write(self, name, text, mode=0o644):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, mode)

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def run_script(self, name, *arguments, **variables):
        environment = dict(os.environ, PATH=f"{self.folder}/bin:{os.environ['PATH']}", SUBMITTED=f"{self.folder}/submitted",
                           **variables)
        return subprocess.run([os.path.join(ROOT, "scripts/slurm", name), *arguments], cwd=self.folder, env=environment,
                              capture_output=True, text=True, timeout=60)

    def submit(self, *arguments):
        done = self.run_script("submit.sh", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def usual(self, *before, scene=("scene:spheres,triangles=500", "--size", "48x36")):
        return ("-o", "out/x.####.png", "--sequence", "1-7", "--chunk", "3", "--program", BINARY, *before, *scene)

    def run_task(self, task, **variables):
        return self.run_script("task.sh", f"{self.folder}/out", "1", SLURM_ARRAY_TASK_ID=str(task), **variables)

    def test_what_is_submitted(self):
        self.submit(*self.usual("--at-once", "2", "--cpus", "8", "--memory", "4G"))
        self.assertEqual(self.read("out/farm/chunks.1"), "1-3\n4-6\n7-7\n")
        array, merge = self.read("submitted").splitlines()
        for part in ("--requeue", "--array=0-2%2", "--cpus-per-task=8", "--mem=4G", "task.sh"):
            self.assertIn(part, array)
        self.assertIn("--dependency=afterany:1", merge)

    def test_tasks_then_merge_then_what_is_missing(self):
        self.submit(*self.usual())
        self.assertEqual(self.run_task(0).returncode, 0)
        self.assertEqual(self.run_task(2).returncode, 0)
        self.assertIn('"form": "cpu"', self.read("out/run.0001-0003.json"))
        self.assertIn('"why": ""', self.read("out/run.0001-0003.json"), "--gl off was said, not found")
        done = self.run_script("merge.sh", f"{self.folder}/out", "1")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("frames 4-6: 1 tasks", done.stdout)
        self.assertEqual(self.read("out/farm/chunks.2"), "4-6\n")
        self.assertEqual(self.run_script("merge.sh", f"{self.folder}/out", "3").stdout.count("tasks"), 0, "no round is left")
        self.assertEqual(self.run_task(1).returncode, 0)
        self.assertEqual(self.run_script("merge.sh", f"{self.folder}/out", "2").returncode, 0)
        self.assertIn("nothing is missing", self.submit("--again", "out"))

    def test_nothing_came_of_it(self):
        self.submit(*self.usual())
        self.assertIn("frames 1-7: 3 tasks", self.run_script("merge.sh", f"{self.folder}/out", "1").stdout)

    def test_names_with_spaces_reach_the_render(self):
        self.write("a scene.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.submit(*self.usual(scene=("a scene.obj", "--size", "48x36", "--gl=off")))
        self.assertEqual(self.run_task(1).returncode, 0)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "out/x.0005.png")))

    def test_a_fault_of_the_scene_is_not_queued_again(self):
        self.write("bin/scontrol", '#!/bin/sh\necho "$@" >> "$SUBMITTED"\n', 0o755)
        self.submit(*self.usual(scene=("missing.obj",)))
        done = self.run_task(0)
        self.assertEqual(done.returncode, 3)
        self.assertIn("missing.obj", done.stderr)
        self.assertNotIn("requeue", self.read("submitted").replace("--requeue", ""))

    def test_refused(self):
        for arguments, says in ((("-o", "x.####.png", "--sequence", "1-5", "a.obj"), "a folder that all nodes share"),
                                (("-o", "out/x.####.png", "a.obj"), "--sequence ''"),
                                (("-o", "out/x.####.png", "--sequence", "1-5", "--program", BINARY), "which SCENE"),
                                (("--chunks", "3", "a.obj"), "--chunks: not known"),
                                (self.usual("--chunk", "0"), "--chunk 0"),
                                (("-o",), "no value"), (("--again", "nowhere"), "no farm/plan")):
            done = self.run_script("submit.sh", *arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(says, done.stderr)


if __name__ == "__main__":
    unittest.main()
