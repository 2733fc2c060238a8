"""Shared by all tests of the real binary: a folder per test and runs of the binary.

A test file is called with the binary's path as its first argument, then unittest's own arguments."""

import os
import subprocess
import sys
import tempfile
import unittest

from png_file import Png  # noqa: F401, tests take it from here

BINARY = os.path.abspath(sys.argv.pop(1))

# A scene that renders in milliseconds: five hundred triangles, some of them mirrors.
SCENE = "scene:spheres,triangles=500"
SMALL = ("--size", "96x72", "--shadow-map", "256")


class CliTestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self, folder="."):
        """All files below a folder, hidden ones too, as sorted relative paths."""
        top = self.path(folder)
        return sorted(os.path.relpath(os.path.join(where, name), top)
                      for where, _, names in os.walk(top) for name in names)

    def start(self, *arguments, **keywords):
        keywords.setdefault("stdout", subprocess.PIPE)
        keywords.setdefault("stderr", subprocess.PIPE)
        return subprocess.Popen([BINARY, *arguments], cwd=self.folder, text=True, **keywords)

    def run_binary(self, *arguments, env=None, **keywords):
        environment = dict(os.environ, **env) if env else None
        return subprocess.run([BINARY, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              env=environment, **keywords)

    def succeed(self, *arguments, **keywords):
        done = self.run_binary(*arguments, **keywords)
        self.assertEqual(done.returncode, 0, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def render(self, *arguments, **keywords):
        """Renders a small picture; prints nothing but warnings."""
        return self.succeed("render", SCENE, *SMALL, "-q", *arguments, **keywords)

    def fail_with(self, code, *arguments, says=(), **keywords):
        """Expects the exit code, one line on standard error that holds each of `says`, and nothing on standard output."""
        done = self.run_binary(*arguments, **keywords)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        self.assertEqual(done.stdout, "")
        self.assertTrue(done.stderr.startswith("hybridrt: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for part in (says,) if isinstance(says, str) else says:
            self.assertIn(part, done.stderr)
        return done
