"""Every code of a warning: a small input that is warned of by it, on --json, in run.json and on standard error; and
the list in docs/formats.md is the program's own.

Called with the binary, the project's folder and a library that takes locks away (support/no_locks.cpp)."""

import json
import os
import re
import struct
import subprocess
import sys
import unittest
import zlib

ROOT = os.path.abspath(sys.argv.pop(2))
NO_LOCKS = os.path.abspath(sys.argv.pop(2))

from cli_test_case import SCENE, CliTestCase  # noqa: E402, it takes the binary off the arguments

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
FACE = TRIANGLE + "f 1 2 3\n"
PAINTED = "mtllib a.mtl\n" + TRIANGLE + "usemtl a\nf 1 2 3\n"
TEXTURED = "mtllib a.mtl\n" + TRIANGLE + "vt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n"
FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
# A tetrahedron, wound outward.
SOLID = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n"
OUTWARD, INWARD = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"


def png(*rows, alpha=False):
    """A picture with these rows of bytes."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", len(rows[0]) // (4 if alpha else 3), len(rows), 8, 6 if alpha else 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def ply(vertex="", face="", vertices=("0 0 0", "1 0 0", "0 1 0"), corners="3 0 1 2", comment="", more=("", "")):
    return (f"ply\nformat ascii 1.0\n{comment}element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            f"{vertex}element face 1\nproperty list uchar int vertex_indices\n{face}{more[0]}end_header\n"
            + "\n".join((*vertices, corners)) + "\n" + more[1])


def binary_stl(promised, facets, more=b""):
    facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    return b"binary".ljust(80) + struct.pack("<I", promised) + facet * facets + more


def room():
    """A box that is wound inward, with a body in it."""
    corners = [(9 * x - 4, 5 * y - 2, 9 * z - 4) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6")
    return SOLID + OUTWARD + "".join("v %g %g %g\n" % corner for corner in corners) + "".join(
        "f " + " ".join(str(4 + int(corner)) for corner in quad.split()) + "\n" for quad in quads)


TEXTURE_FILE = "comment TextureFile a.png\n"
GREY = png(b"\x80\x80\x80" * 2, b"\x40\x40\x40" * 2)

# By code: the files, the first of which is the scene, and options.
CASES = {
    "file-cut-short": ({"a.stl": "solid a\n" + FACET},),
    "file-has-more": ({"a.stl": binary_stl(1, 1, b"xy")},),
    "facets-miscounted": ({"a.stl": binary_stl(0, 2)},),
    "line-unknown": ({"a.obj": FACE + "colour 1\n"},),
    "data-unread": ({"a.ply": ply(more=("element material 1\nproperty int n\n", "7\n"))},),
    "face-too-small": ({"a.obj": FACE + "f 1 2\n"},),
    "polygon-tangled": ({"a.obj": "v 0 0 0\nv 3 3 0\nv 6 0 0\nv 6 3 0\nv 3 0 0\nv 0 3 0\nf 1 2 3 4 5 6\n"},),
    "triangle-degenerate": ({"a.obj": FACE + "f 1 2 2\n"},),
    "vertex-unusable": ({"a.obj": FACE + "v nan 0 0\n"},),
    "normal-unusable": ({"a.obj": TRIANGLE + "vn 0 0 0\nf 1//1 2//1 3//1\n"},),
    "normal-astray": ({"a.obj": TRIANGLE + "f 1//9 2//9 3//9\n"},),
    "texcoord-unusable": ({"a.obj": TEXTURED.replace("vt 1 0", "vt nan 0"), "a.mtl": "newmtl a\nmap_Kd a.png\n",
                           "a.png": GREY},),
    "texcoord-astray": ({"a.obj": TEXTURED.replace("3/3", "3/3\nf 1/9 2/9 3/9"), "a.mtl": "newmtl a\nKd 1 0 0\n"},),
    "texcoord-missing": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nmap_Kd a.png\n", "a.png": GREY},),
    "texcoord-unread": ({"a.ply": ply("property float s\nproperty float t\n",
                                      vertices=("0 0 0 0 0", "1 0 0 1 0", "0 1 0 0 1"))},),
    "color-unusable": ({"a.obj": "v 0 0 0 1 0 0\nv 1 0 0 1 x 0\nv 0 1 0 1 0 0\nf 1 2 3\n"},),
    "color-ignored": ({"a.ply": ply("property uchar red\n", vertices=("0 0 0 9", "1 0 0 9", "0 1 0 9"))},),
    "color-miscounted": ({"a.obj": FACE + "#MRGB ff102030ff405060\n"},),
    "color-alpha-unread": ({"a.ply": ply("".join(f"property uchar {c}\n" for c in ("red", "green", "blue", "alpha")),
                                         vertices=("0 0 0 9 8 7 9", "1 0 0 9 8 7 9", "0 1 0 9 8 7 9"))},),
    "material-file-missing": ({"a.obj": "mtllib gone.mtl\n" + FACE},),
    "material-file-moved": ({"a.obj": PAINTED.replace("a.mtl", "A.MTL"), "a.mtl": "newmtl a\nKd 1 0 0\n"},),
    "material-repeated": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n"},),
    "material-unknown": ({"a.obj": PAINTED, "a.mtl": "newmtl b\nKd 1 0 0\n"},),
    "material-unnamed": ({"a.obj": "mtllib a.mtl\n" + FACE, "a.mtl": "newmtl a\nKd 1 0 0\n"},),
    "material-value-unusable": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd 1 0 0\nillum 11\n"},),
    "material-color-large": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd 255 0 0\n"},),
    "material-color-unread": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd xyz 1 0 0\n"},),
    "material-drawn-opaque": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd 1 0 0\nTr 1\n"},),
    "material-invisible": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd 1 0 0\nd 0\n"},),
    "texture-missing": ({"a.obj": TEXTURED, "a.mtl": "newmtl a\nmap_Kd gone.png\n"},),
    "texture-moved": ({"a.obj": TEXTURED, "a.mtl": "newmtl a\nmap_Kd A.PNG\n", "a.png": GREY},),
    "texture-unusable": ({"a.obj": TEXTURED, "a.mtl": "newmtl a\nmap_Kd a.png\n", "a.png": GREY[:-20]},),
    "texture-without-alpha": ({"a.obj": TEXTURED, "a.mtl": "newmtl a\nmap_Kd a.png\n",
                               "a.png": png(b"\x80\x80\x80\0" * 2, alpha=True)},),
    "texture-without-texcoords": ({"a.ply": ply(comment=TEXTURE_FILE), "a.png": GREY},),
    "texture-unknown": ({"a.ply": ply(face="property list uchar float texcoord\nproperty int texnumber\n",
                                      corners="3 0 1 2 6 0 0 1 0 0 1 5", comment=TEXTURE_FILE), "a.png": GREY},),
    "map-unread": ({"a.obj": PAINTED, "a.mtl": "newmtl a\nKd 1 0 0\nmap_Bump a.png\n", "a.png": GREY},),
    "mesh-non-manifold": ({"a.obj": FACE + "v 0 0 1\nv 1 1 1\nf 1 2 4\nf 1 2 5\n"},),
    "body-turned": ({"a.obj": SOLID + INWARD},),
    "glass-open": ({"a.obj": "mtllib a.mtl\n" + SOLID + "usemtl a\n" + OUTWARD[:-8],
                    "a.mtl": "newmtl a\nKd 1 1 1\nd 0.5\nNi 1.5\nillum 7\n"},),
    "up-along-view": ({"a.obj": SOLID + OUTWARD}, "--eye", "0.5,9,0.5", "--target", "0.5,0,0.5"),
    "up-axis-doubtful": ({"a.obj": "v 0 0 0\nv 9 0 0\nv 9 9 1\nv 0 9 0\nf 1 2 3\nf 1 3 4\n"},),
    "triangles-astray": ({"a.obj": SOLID + OUTWARD + "v 1000 0 0\nv 1000.01 0 0\nv 1000 0.01 0\nf 5 6 7\n"},),
    "camera-in-body": ({"a.obj": SOLID + OUTWARD}, "--eye", "0.3,0.3,0.3", "--target", "1,0,0", "--crop", "0,0,4,4"),
    "camera-in-room": ({"a.obj": room()},),
    "light-missing": ({"a.json": json.dumps({
        "meshes": ["a.obj"], "lights": [],
        "camera_path": {"keyframes": [{"frame": 1, "eye": [0, 0, 5], "target": [0, 0, 0], "light": [0, 1, 1]}]}}),
        "a.obj": FACE},),
    "frame-empty": ({"a.obj": FACE}, "--eye", "0,0,9", "--target", "0,0,20"),
    "frame-dark": ({"a.obj": SOLID + OUTWARD}, "--eye", "1,1,9", "--target", "0.5,0.5,0", "--light", "0,0,-1"),
}
# These take more than a file: the tests that hold them.
ELSEWHERE = {"gpu-unusable": "gl_driver_test.py", "tables-renamed": "two_runs_test.py",
             "times-missing": "merge_test.py", "scene-parts-lost": "simplify_test.py"}


def listed(text):
    return re.findall(r"^\| `([a-z-]+)` \|", text.split("## Warnings")[1].split("\n## ")[0], re.MULTILINE)


class WarningCodesTest(CliTestCase):
    def make(self, files):
        for name, data in files.items():
            with open(self.path(name), "wb") as file:
                file.write(data if isinstance(data, bytes) else data.encode())
        return next(iter(files))

    def test_each_arrives_alone(self):
        for code, (files, *options) in CASES.items():
            with self.subTest(code):
                for name in self.files():
                    os.remove(self.path(name))
                scene = self.make(files)
                done = self.succeed("render", scene, "--size", "24x18", "--gl", "off", "--threads", "1", "--json", "-o",
                                    "a.out.png", *options)
                events = [event for event in map(json.loads, done.stdout.splitlines()) if event["event"] == "warning"]
                self.assertEqual([event["code"] for event in events], [code], events)
                self.assertTrue(events[0]["message"])
                run = json.loads(self.read("run.json"))
                self.assertEqual(run["warnings"], [{"code": e["code"], "message": e["message"]} for e in events])

    def test_on_standard_error_it_is_in_brackets(self):
        scene = self.make(CASES["line-unknown"][0])
        line = "a.obj: 1 lines of an unknown kind were left out (first at line 5) [line-unknown]"
        for command in (("render", scene, "--size", "8x8", "-q"), ("tune", scene, "--size", "8x8", "--max-error", "1wrong", "-q"),
                        ("simplify", scene, "--max-error", "1px", "-o", "b.obj", "-q"),
                        ("sweep", scene, "--size", "8x8", "--over", "shadows=map", "--rounds", "1", "--no-charts", "-q", "-o", "s")):
            done = self.succeed(*command)
            self.assertIn(f"hybridrt: warning: {line}\n", done.stderr, command)
        self.assertIn(f"  - {line}\n", self.succeed("inspect", scene).stdout)

    def test_merge_keeps_each_once(self):
        scene = self.make(CASES["line-unknown"][0])
        for frames in ("1-1", "2-2"):
            self.succeed("render", scene, "--size", "8x8", "--eye", "0.3,0.3,3", "--target", "0.3,0.3,0", "--light", "0,0,1",
                         "--sequence", "1-2", "--frames", frames, "-q", "-o", "x.####.png")
        self.succeed("merge", ".")
        self.assertEqual([warning["code"] for warning in json.loads(self.read("run.json"))["warnings"]], ["line-unknown"])

    def test_textures_cut_short(self):
        self.write("a.obj", TEXTURED)
        for name in ("a.jpg", "a.tif", "a.bmp"):
            self.succeed("render", SCENE, "--size", "160x120", "-q", "-o", name)
            whole = self.read(name)
            self.write("a.mtl", f"newmtl a\nmap_Kd {name}\n")
            self.assertEqual(json.loads(self.succeed("inspect", "a.obj", "--json").stdout)["warnings"], [])
            self.make({name: whole[:len(whole) * 6 // 10]})
            warning, = json.loads(self.succeed("inspect", "a.obj", "--json").stdout)["warnings"]
            self.assertEqual(warning["code"], "texture-damaged" if name == "a.jpg" else "texture-unusable")
            self.assertIn(name + ": ", warning["message"])
            done = self.run_binary("compare", name, name)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(name + ": broken image", done.stderr)
        self.assertIn(" [texture-unusable]\n", self.succeed("inspect", "a.obj").stdout)
        self.write("a.mtl", "newmtl a\nmap_Kd a.jpg\n")
        self.assertIn("a.jpg: JPEG error: Premature end of JPEG file) [texture-damaged]\n",
                      self.succeed("inspect", "a.obj").stdout)

    def test_what_a_comparison_cannot_draw(self):
        self.make({"a.png": GREY, "b.png": png(b"\0\0\0")})
        done = self.run_binary("compare", "a.png", "b.png", "--diff", "d.png")
        self.assertIn("warning: d.png not written: ", done.stderr)
        self.assertIn(" [difference-unwritten]\n", done.stderr)

    def test_what_an_mtl_cannot_say(self):
        scene = self.make({"a.obj": SOLID + "mtllib a.mtl\nusemtl a\n" + OUTWARD,
                           "a.mtl": "newmtl a\nKd 1 0 0\nmap_Kd gone.png\n"})
        self.assertIn(" [material-changed]\n", self.succeed("simplify", scene, "--max-error", "1px", "-o", "b.obj", "-q").stderr)

    def test_a_busy_machine(self):
        spin = [sys.executable, "-c", "import time\nend = time.monotonic() + 60\nwhile time.monotonic() < end: pass"]
        others = [subprocess.Popen(spin) for _ in range(os.cpu_count())]
        try:
            done = self.succeed("sweep", SCENE, "--size", "8x8", "--over", "shadows=map", "--rounds", "1", "--no-charts", "-q", "-o", "s")
        finally:
            for other in others:
                other.kill()
                other.wait()
        self.assertIn(" [machine-busy]\n", done.stderr)

    def test_a_file_system_without_locks(self):
        done = self.run_binary("render", SCENE, "--size", "8x8", "-q", "-o", "a.png", env={"LD_PRELOAD": NO_LOCKS})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(" [file-locks-missing]\n", done.stderr)
        self.assertIn("a.png", self.files())

    def test_frames_that_tune_was_not_prepared_for(self):
        """It tries frames 2, 5 and 7, which are empty, and checks 1, 4 and 8, which look ever deeper into two mirrors."""
        self.write("a.mtl", "newmtl a\nKd 0 0 0\nKs 0.9 0.9 0.9\nillum 3\n")
        self.write("a.obj", "mtllib a.mtl\nusemtl a\n" + "".join(
            f"v -20 -50 {z}\nv 20 -50 {z}\nv 20 50 {z}\nv -20 50 {z}\n" for z in (0, 2)) + "f 1 2 3 4\nf 8 7 6 5\n")
        frames = [{"frame": frame, "eye": [0, 0, 900], "target": [0, 0, 999]} for frame in range(1, 10)]
        for frame, along in ((1, 15), (4, 4), (8, 1)):
            frames[frame - 1].update(eye=[0, 0, 1], target=[along, 0, 0])
        self.write("path.json", json.dumps({"keyframes": frames}))
        done = self.succeed("tune", "a.obj", "--camera", "path.json", "--frames", "9", "--size", "8x8", "--fov", "5", "--max-error", "30dB",
                            "--truth-samples", "2")
        for frame in (1, 4):
            self.assertIn(f"frame {frame} needs more: trying again", done.stderr)
        self.assertIn("frame 8 has a larger error; give --frames that are more alike [error-exceeded]\n", done.stderr)

    def test_the_list_is_the_programs(self):
        with open(os.path.join(ROOT, "docs/formats.md"), encoding="utf-8") as file:
            documented = listed(file.read())
        with open(os.path.join(ROOT, "core/base/warning_code.h"), encoding="utf-8") as file:
            header = file.read()
        values = re.findall(r"^  ([a-z_]+),$", header.split("enum class WarningCode")[1].split("};")[0], re.MULTILINE)
        names = re.findall(r'\{"([a-z-]+)", WarningCode::([a-z_]+)\}', header)
        self.assertEqual([value for _, value in names], values)
        self.assertEqual([name for name, _ in names], [value.replace("_", "-") for value in values])
        self.assertEqual(documented, [name for name, _ in names])

    def test_every_code_has_a_test(self):
        with open(__file__, encoding="utf-8") as file:
            here = set(re.findall(r" \[([a-z-]+)\]\\n", file.read()))
        for code, name in ELSEWHERE.items():
            with open(os.path.join(ROOT, "tests/cli", name), encoding="utf-8") as file:
                self.assertIn(code, file.read(), name)
        with open(os.path.join(ROOT, "docs/formats.md"), encoding="utf-8") as file:
            self.assertEqual(set(listed(file.read())), {*CASES, *ELSEWHERE, *here})

    def test_no_other_line_is_called_a_warning(self):
        """All that is called one goes through line_of()."""
        found = set()
        for folder, _, names in os.walk(os.path.join(ROOT, "cli")):
            for name in names:
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    if "warning: " in file.read():
                        found.add(name)
        self.assertEqual(found, {"warning_output.cpp", "warning_output.h"})


if __name__ == "__main__":
    unittest.main()
