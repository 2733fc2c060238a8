"""What files and names bring reaches no terminal and no report as it is; pictures that cannot be read or held are said so."""

import json
import os
import subprocess
import unittest
import xml.dom.minidom

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase

HOSTILE = b"x\xff\x1b[31m\xc2\x9by"
SHOWN = "x\\xff\\x1b[31m\\xc2\\x9by"
CPU = (*SMALL, "-q", "--gl", "off")


class HostileTextTest(CliTestCase):
    def run_bytes(self, *arguments):
        return subprocess.run([BINARY, *arguments], cwd=self.folder, capture_output=True, timeout=120)

    def expect_shown(self, text):
        text.decode("utf-8")
        self.assertEqual([c for c in text if c < 32 and c != 10], [])
        self.assertIn(SHOWN, text.decode())

    def test_names_from_files(self):
        with open(self.path("a.obj"), "wb") as file:
            file.write(b"mtllib " + HOSTILE + b".mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl " + HOSTILE + b"\nf 1 2 3\n")
        self.expect_shown(self.run_bytes("render", "a.obj", *CPU).stderr)
        self.expect_shown(self.run_bytes("inspect", "a.obj").stdout)

    def test_names_of_files_and_options(self):
        for arguments in (("inspect", HOSTILE + b".obj"), ("inspect", SCENE, b"--" + HOSTILE), ("compare", HOSTILE, HOSTILE),
                          ("render", SCENE, "-o", HOSTILE)):
            self.expect_shown(self.run_bytes(*arguments).stderr)

    def test_junit_is_xml(self):
        self.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        name = "a\u001b[31m\u0001"
        self.write("g.json", json.dumps({"cases": [{"name": name, "scene": "t.obj", "options": list(SMALL), "reason": "is"}]}))
        done = self.run_bytes("golden", "check", "--list", "g.json", "--junit", "j.xml")
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertNotIn(b"\x1b", done.stdout + done.stderr)
        case, = xml.dom.minidom.parse(self.path("j.xml")).getElementsByTagName("testcase")
        self.assertEqual(case.getAttribute("name"), "a\\x1b[31m\\x01")

    def test_small_jpeg_2000(self):
        for size in ("31x100", "100x31"):
            done = self.fail_with(2, "render", SCENE, "--size", size, "-q", "-o", "a.jp2", says="JPEG 2000")
            self.assertEqual(self.files(), [], done.stderr)
        self.succeed("render", SCENE, "--size", "32x32", "-q", "-o", "a.jp2")
        self.succeed("compare", "a.jp2", "a.jp2")

    def test_a_gif_larger_than_memory(self):
        gif = b"GIF89a\xff\xff\xff\xff\x80\x00\x00" + b"\0" * 6 + b",\0\0\0\0\xff\xff\xff\xff\x00\x02\x00;"
        with open(self.path("t.gif"), "wb") as file:
            file.write(gif)
        self.write("t.mtl", "newmtl m\nmap_Kd t.gif\n")
        self.write("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
        self.fail_with(3, "compare", "t.gif", "t.gif")
        self.assertIn("checker", self.succeed("render", "t.obj", *CPU).stderr)

    def test_a_folder_of_other_files_as_shaders(self):
        os.makedirs(self.path("shaders/folder"))
        self.fail_with(3, "render", SCENE, *SMALL, "--shaders", "shaders", says=("--shaders shaders: ", "is missing"))


if __name__ == "__main__":
    unittest.main()
