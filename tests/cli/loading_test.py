"""The line that shows how far loading has come: on a terminal only, and only if it takes long."""

import json
import os
import pty
import subprocess
import threading
import time
import unittest

from cli_test_case import BINARY, CliTestCase

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class LoadingTest(CliTestCase):
    def on_a_terminal(self, *arguments, feed=None):
        """The binary's output on a terminal; `feed` is a pipe that keeps it waiting for 1.5 seconds."""
        def write_late():
            with open(feed, "w", encoding="utf-8") as pipe:
                time.sleep(1.5)
                pipe.write(TRIANGLE)

        if feed:
            threading.Thread(target=write_late, daemon=True).start()
        ours, its = pty.openpty()
        with subprocess.Popen([BINARY, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=its) as process:
            os.close(its)
            said = b""
            while True:
                try:
                    block = os.read(ours, 4096)
                except OSError:  # the other side is closed
                    break
                if not block:
                    break
                said += block
            self.assertEqual(process.wait(timeout=60), 0, said)
        os.close(ours)
        return said.decode()

    def slow_scene(self):
        self.write("a.obj", TRIANGLE)
        os.mkfifo(self.path("slow.obj"))
        self.write("scene.json", json.dumps({"meshes": ["a.obj", "slow.obj", "a.obj"]}))
        return self.path("slow.obj")

    def test_share_of_what_is_read(self):
        said = self.on_a_terminal("inspect", "scene.json", "--threads", "1", feed=self.slow_scene())
        self.assertIn("\rloading scene.json 50 %\x1b[K", said)
        self.assertTrue(said.rstrip().endswith("\r\x1b[K"), "the line is gone in the end: " + repr(said[-80:]))

    def test_none_when_quiet(self):
        pipe = self.slow_scene()
        self.assertNotIn("loading", self.on_a_terminal("inspect", "scene.json", "--json", feed=pipe))
        self.assertNotIn("loading", self.on_a_terminal("render", "scene.json", "-q", "--method", "raytrace", "--size",
                                                       "16x16", feed=pipe))

    def test_none_when_quick(self):
        self.write("a.obj", TRIANGLE)
        self.assertEqual(self.on_a_terminal("inspect", "a.obj"), "")

    def test_none_without_a_terminal(self):
        pipe = self.slow_scene()
        threading.Thread(target=lambda: (time.sleep(1.5), open(pipe, "w").write(TRIANGLE)), daemon=True).start()
        self.assertEqual(self.succeed("inspect", "scene.json").stderr, "")


if __name__ == "__main__":
    unittest.main()
