"""The number of threads of a run: --threads limits those of a software GL too."""

import json
import os
import signal
import unittest

from cli_test_case import SCENE, SMALL, CliTestCase


class ThreadsTest(CliTestCase):
    def llvmpipe_threads(self, scene, *arguments):
        """The threads of a run that has rendered its first frame."""
        process = self.start("render", scene, *SMALL, "--frames", "1000000000", "--json", *arguments)
        try:
            for line in process.stdout:
                event = json.loads(line)
                if event["event"] == "start" and "llvmpipe" not in event["renderer"]:
                    self.skipTest(event["renderer"])
                if event["event"] == "frame":
                    return sum(name.startswith("llvmpipe-") for name in self.thread_names(process.pid))
            return self.fail(f"no frame: {process.stderr.read()}")
        finally:
            process.send_signal(signal.SIGKILL)
            process.communicate(timeout=60)

    @staticmethod
    def thread_names(process_id):
        names = []
        tasks = f"/proc/{process_id}/task"
        for task in os.listdir(tasks):
            try:
                with open(f"{tasks}/{task}/comm", encoding="utf-8") as file:
                    names.append(file.read().strip())
            except OSError:
                pass  # it has ended
        return names

    def test_llvmpipe_has_as_many_as_the_run(self):
        # One thread: it draws on the caller's.
        for threads, own in (("1", 0), ("2", 2), ("3", 3)):
            self.assertEqual(self.llvmpipe_threads(SCENE, "--threads", threads), own)

    def test_the_environment_does_not_overrule(self):
        os.environ["LP_NUM_THREADS"] = "5"
        self.addCleanup(os.environ.pop, "LP_NUM_THREADS")
        self.assertEqual(self.llvmpipe_threads(SCENE, "--threads", "2"), 2)

    def test_a_scenes_settings_count(self):
        scene = self.write("few.json", json.dumps({"meshes": ["a.obj"], "settings": {"threads": 2}}))
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertEqual(self.llvmpipe_threads(scene), 2)
        self.assertEqual(self.llvmpipe_threads(scene, "--threads", "1"), 0)


if __name__ == "__main__":
    unittest.main()
