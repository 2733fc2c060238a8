"""What the program loads: OpenImageIO and its 260 libraries only for pictures that are no PNGs."""

import os
import shutil
import subprocess
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase

FORMATS = os.path.join("hybridrt", "image_formats.so")


def formats_beside(binary):
    """The shared object of the other formats: below the folder of libraries beside the program's own."""
    prefix = os.path.dirname(os.path.dirname(binary))
    found = [os.path.join(folder, name) for folder, _, names in os.walk(prefix) for name in names
             if os.path.join(folder, name).endswith(FORMATS)]
    return found[0]


class LoadedTest(CliTestCase):
    def loaded(self, *arguments):
        """The names of the libraries that a run initialises."""
        done = self.run_binary(*arguments, env={"LD_DEBUG": "files"})
        self.assertEqual(done.returncode, 0, f"{arguments}\n{done.stdout}\n{done.stderr[-2000:]}")
        return {os.path.basename(line.split("calling init: ")[1]) for line in done.stderr.splitlines()
                if "calling init: " in line}

    def assert_loads(self, expected, name, *arguments):
        there = any(library.startswith(name) for library in self.loaded(*arguments))
        self.assertEqual(there, expected, f"{name} by {arguments}")

    def test_png_runs_load_no_openimageio(self):
        self.render("-o", "a.png")
        for arguments in (["--help"], ["render", "--help"], ["--version"], ["inspect", SCENE],
                          ["compare", "a.png", "a.png", "--diff", "d.png"],
                          ["render", SCENE, *SMALL, "--gl", "off", "--frames", "2", "--aov", "depth", "--contact-sheet",
                           "sheet.png", "-o", "b.####.png"],
                          ["render", SCENE, *SMALL, "--gl", "off", "--frames", "2", "--resume", "-o", "b.####.png"]):
            with self.subTest(arguments=arguments):
                self.assert_loads(False, "libOpenImageIO", *arguments)

    def test_writing_exr_does_not(self):
        self.assert_loads(False, "libOpenImageIO", "render", SCENE, *SMALL, "--gl", "off", "-o", "a.exr")

    def test_help_and_version_load_no_gl(self):
        for arguments in (["--help"], ["--version"]):
            for library in ("libEGL", "libOSMesa", "libGL"):
                self.assert_loads(False, library, *arguments)

    def test_other_formats_load_it(self):
        self.assert_loads(True, "libOpenImageIO", "render", SCENE, *SMALL, "--gl", "off", "-o", "a.tif")
        self.assert_loads(True, "libOpenImageIO", "compare", "a.tif", "a.tif")


class MissingTest(CliTestCase):
    """A program without its shared object, and with one that is none."""

    def setUp(self):
        super().setUp()
        self.binary = self.path("prefix", "bin", "hybridrt")
        os.makedirs(os.path.dirname(self.binary))
        os.symlink(BINARY, self.path("link"))
        shutil.copy(BINARY, self.binary)
        self.render("-o", "a.exr")
        self.render("-o", "a.png")

    def run_copy(self, *arguments, binary=None):
        return subprocess.run([binary or self.binary, *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=120)

    def expect_complaint(self, code, *arguments):
        done = self.run_copy(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("image_formats.so", done.stderr)
        self.assertIn("install", done.stderr)

    def test_pngs_work_without_it(self):
        self.assertEqual(self.run_copy("render", SCENE, *SMALL, "-q", "-o", "b.png").returncode, 0)
        self.assertEqual(self.read("a.png"), self.read("b.png"))
        self.assertEqual(self.run_copy("compare", "a.png", "b.png").returncode, 0)

    def test_other_formats_say_what_is_missing(self):
        self.expect_complaint(5, "render", SCENE, *SMALL, "-o", "b.tif")
        self.expect_complaint(3, "compare", "a.exr", "a.exr")
        self.assertFalse(os.path.exists(self.path("b.tif")))

    def test_a_file_that_is_no_library(self):
        place = self.path("prefix", os.path.relpath(formats_beside(BINARY), os.path.dirname(os.path.dirname(BINARY))))
        os.makedirs(os.path.dirname(place))
        self.write(place, "no library")
        self.expect_complaint(3, "compare", "a.exr", "a.exr")
        shutil.copy(formats_beside(BINARY), place)
        self.assertEqual(self.run_copy("compare", "a.exr", "a.exr").returncode, 0)

    def test_through_a_link(self):
        done = self.run_copy("compare", "a.exr", "a.exr", binary=self.path("link"))
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
