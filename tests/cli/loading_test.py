"""The line that shows how far loading has come: on a terminal only, and only if it takes long."""

import json
import os
import pty
import subprocess
import unittest

from cli_test_case import BINARY, CliTestCase

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class LoadingTest(CliTestCase):
    def on_a_terminal(self, *arguments):
        """The binary's output on a terminal."""
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

    def make_slow_scene(self):
        """A hundred million lines, which say nothing: little memory, and some seconds on one thread."""
        self.write("slow.obj", "#\n" * 16_000_000 + TRIANGLE)
        self.write("scene.json", json.dumps({"meshes": ["slow.obj"] * 8}))

    def test_share_of_what_is_read(self):
        self.make_slow_scene()
        said = self.on_a_terminal("inspect", "scene.json", "--threads", "1")
        self.assertRegex(said, r"\rloading scene.json [1-9]\d? %\x1b\[K")
        self.assertTrue(said.rstrip().endswith("\r\x1b[K"), "the line is gone in the end: " + repr(said[-80:]))

    def test_none_when_quiet_or_without_a_terminal(self):
        self.make_slow_scene()
        slow = ("scene.json", "--threads", "1")
        self.assertNotIn("loading", self.on_a_terminal("inspect", *slow, "--json"))
        self.assertNotIn("loading", self.on_a_terminal("render", *slow, "-q", "--method", "raytrace", "--size", "16x16"))
        self.assertEqual(self.succeed("inspect", *slow).stderr, "")

    def test_none_when_quick(self):
        self.write("a.obj", TRIANGLE)
        self.assertEqual(self.on_a_terminal("inspect", "a.obj"), "")


if __name__ == "__main__":
    unittest.main()
