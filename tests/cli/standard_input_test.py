"""SCENE -: a mesh from standard input is the same scene as from a file."""

import os
import subprocess
import tempfile
import unittest

from cli_test_case import BINARY, CliTestCase

MTL = "newmtl red\nKd 0.8 0.1 0.1\n"
OBJ = "mtllib red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
OFF = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


class StandardInput(CliTestCase):
    def pipe(self, text, *arguments):
        with tempfile.TemporaryDirectory() as temporary:
            done = subprocess.run([BINARY, *arguments], input=text, cwd=self.folder, capture_output=True, text=True,
                                  timeout=120, env=dict(os.environ, TMPDIR=temporary))
            self.assertEqual(os.listdir(temporary), [])
        return done

    def test_it_is_the_scene_of_the_file(self):
        self.write("red.mtl", MTL)
        for name, text in (("a.obj", OBJ), ("a.off", OFF)):
            self.write(name, text)
            extension = name[-3:]
            self.succeed("render", name, "--size", "64x48", "-q", "-o", "file.png")
            done = self.pipe(text, "render", "-", "--input-format", extension, "--size", "64x48", "-q", "-o", "piped.png")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(self.read("piped.png"), self.read("file.png"), extension)

    def test_pictures_have_a_name(self):
        self.write("red.mtl", MTL)
        self.assertEqual(self.pipe(OBJ, "render", "-", "--input-format", "obj", "--size", "64x48").returncode, 0)
        self.assertIn("out/stdin.0001.png", self.files())

    def test_inspect(self):
        self.assertIn("triangles   4", self.pipe(OFF, "inspect", "-", "--input-format", "off").stdout)

    def test_faults(self):
        for arguments, text, code, words in (
                (("render", "-"), OBJ, 2, "--input-format obj"),
                (("render", "-", "--input-format", "glb"), OBJ, 2, "obj, ply, off, stl"),
                (("render", "a.obj", "--input-format", "obj"), "", 2, "is for SCENE -"),
                (("sweep", "-", "--input-format", "obj", "--over", "samples=1", "-o", "s"), OBJ, 2, "only once"),
                (("render", "-", "--input-format", "obj"), "", 3, "standard input is empty"),
                (("render", "-", "--input-format", "stl"), "x", 3, "stdin.stl")):
            done = self.pipe(text, *arguments)
            self.assertEqual(done.returncode, code, arguments)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
