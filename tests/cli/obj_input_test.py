"""How the real binary treats odd and bad OBJ files: refused by line, repaired with one warning, or simply read."""

import os
import random
import resource
import subprocess
import threading
import unittest

from cli_test_case import BINARY
from scene_case import TINY, SceneCase

# A house: square walls and a roof, every face seen differently. Vertex 1 is on line 1, face 1 on line 9.
CORNERS = ["0 0 0", "1 0 0", "1 0 1", "0 0 1", "0 1 0", "1 1 0", "1 1.5 1", "0 1.5 1"]
FACES = ["1 2 3 4", "1 5 6 2", "2 6 7 3", "3 7 8 4", "4 8 5 1", "5 8 7 6"]


def obj(corners=CORNERS, faces=FACES, end="\n"):
    return "".join(f"v {v}{end}" for v in corners) + "".join(f"f {f}{end}" for f in faces)


HOUSE = obj()
LONGEST_MIB = 8  # the longest line


class RefusedTest(SceneCase):
    def test_files_that_are_no_meshes(self):
        os.mkdir(self.path("folder.obj"))
        noise = random.Random(1).randbytes(4096)
        self.refuse("missing.obj", "missing.obj does not exist")
        self.refuse("folder.obj", "folder.obj is a directory")
        for data, says in ((b"", "no faces"), (b"\n\n# empty\n", "no faces"), (obj(faces=()), "8 vertices"),
                           (noise, "bad.obj"), (noise.replace(b"\0", b""), "bad.obj"),
                           (obj(faces=("1 2", "3")), "none of its 2 faces"),
                           (obj(faces=("1 1 1", "1 2 1")), "zero area")):
            with self.subTest(says):
                self.refuse(self.write_bytes("bad.obj", data), says)

    def test_vertices_that_are_no_numbers(self):
        for corner, says in (("1,5 0 0", "its x coordinate '1,5'"), ("0x10 0 0", "'0x10'"),
                             ("1 2", "before its z coordinate")):
            with self.subTest(corner):
                self.write("bad.obj", obj([*CORNERS, corner]))
                self.refuse("bad.obj", "bad.obj:9: vertex 9", says)

    def test_vertices_that_are_no_positions(self):
        house = self.fine(self.write_bytes("house.obj", HOUSE))
        for corner, says in (("nan 0 0", "its x coordinate is NaN"), ("0 -inf 0", "its y coordinate is infinite"),
                             ("0 0 1e39", "its z coordinate is not below 1e30"),
                             ("0 1e999999 0", "its y coordinate is infinite")):
            with self.subTest(corner):
                self.write("used.obj", obj([*CORNERS, corner], [*FACES, "1 2 9"]))
                self.refuse("used.obj", "used.obj:9: vertex 9", says)
                self.write("unused.obj", obj([*CORNERS, corner]))
                self.assertEqual(self.warn("unused.obj", "1 vertices are NaN, infinite or not below 1e30"), house)

    def test_position_indices_that_lead_nowhere(self):
        for index in ("0", "9", "-9", "4294967297", "-4294967297", "99999999999999999999"):
            with self.subTest(index):
                self.write("bad.obj", obj(faces=[*FACES, f"1 2 {index}"]))
                self.refuse("bad.obj", "bad.obj:15: ", "vertex")

    def test_corners_that_are_none(self):
        for corner in ("/1/1", "//1", "/", "a", "1/a", "1//a", "1/1/1/1", "1.5", "nan"):
            with self.subTest(corner):
                self.write("bad.obj", obj(faces=[*FACES, f"1 2 {corner}"]))
                self.refuse("bad.obj", "bad.obj:15: face 7, corner 3", f"'{corner}'")

    def test_text_that_is_none(self):
        for data, says in ((HOUSE.encode().replace(b"1.5", b"1\x005"), "bad.obj:7: a NUL byte"),
                           (HOUSE.encode("utf-16"), "UTF-16"), (HOUSE.encode("utf-16-be"), "NUL byte"),
                           (b"\xfe\xff" + HOUSE.encode("utf-16-be"), "UTF-16")):
            with self.subTest(says):
                self.refuse(self.write_bytes("bad.obj", data), says)

    def test_cut_short(self):
        for text, says in ((HOUSE[:HOUSE.index("f")], "no faces"), (obj(CORNERS[:7]), "vertex 8"),
                           (HOUSE[:-4], "bad.obj:14: the file ends in the middle of a face"),
                           (obj(faces=())[:-3], "bad.obj:8: vertex 8 ends before its z coordinate")):
            with self.subTest(says):
                self.refuse(self.write("bad.obj", text), says)

    def test_cut_anywhere(self):
        for size in range(0, len(HOUSE), 7):
            self.write("cut.obj", HOUSE[:size])
            done = self.run_binary("inspect", "cut.obj", "--size", "8x8", "--threads", "1")
            self.assertIn(done.returncode, (0, 3), (size, done.stderr))
            self.assertEqual(done.stderr.count("\n"), int(done.returncode == 3), (size, done.stderr))

    def test_endless_lines_in_bounded_memory(self):
        block = 1 << 20
        for start, filling in ((b"v 1", b"0"), (b"f 1 2", b" 3"), (b"# ", b"x"), (b"f 1 2 3", b" \\\n")):
            with self.subTest(start):
                with open(self.path("long.obj"), "wb") as file:
                    file.write(start)
                    for _ in range(500):
                        file.write(filling * (block // len(filling)))
                self.fail_with(3, "inspect", "long.obj", says=f"long.obj:1: a line longer than {LONGEST_MIB} MiB")
                os.remove(self.path("long.obj"))
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, 400 * 1024, "KiB")


class RepairedTest(SceneCase):
    def setUp(self):
        super().setUp()
        self.write("house.obj", HOUSE)
        self.house, _ = self.picture("house.obj")

    def test_left_out_and_counted_in_one_line(self):
        for faces, extra, says in (
                ([*FACES, "1 2", "3", ""], "", "3 faces of fewer than three corners were left out (first at line 15)"),
                ([*FACES, "1 2 2", "3 3 3"], "", "2 triangles that repeat a vertex were left out (first at line 15)"),
                ([*FACES, "1 2 9", "1 9 2"], "v 2 0 0\n", "2 triangles of zero area were left out (first at line 15)"),
                ([f"{f.split()[0]}/7 {' '.join(f.split()[1:])}" for f in FACES], "",
                 "6 texture coordinate indices lead nowhere and were left out (first at line 9)"),
                (["1//1 2//0 3//-5 4//4294967297", *FACES[1:]], "",
                 "4 normal indices lead nowhere and were left out (first at line 9)"),
                ([*FACES[:5], FACES[5] + "\nnonsense 1 2 3\ncurv 0 1"], "",
                 "2 lines of an unknown kind were left out")):
            with self.subTest(says):
                self.write("odd.obj", obj(faces=faces) + extra)
                self.assertEqual(self.warn("odd.obj", "odd.obj: " + says), self.house)

    def test_normals_are_rebuilt(self):
        faces = ["1//1 2//2 3//3 4//4", *FACES[1:]]
        for normals in ("vn 0 0 0\n" * 4, "vn nan 0 1\nvn 0 0 0\nvn inf 0 0\nvn x\n"):
            self.write("odd.obj", obj(faces=faces) + normals)
            rows = self.warn("odd.obj", "odd.obj: 6 corners had a zero or unreadable normal, rebuilt")
            self.assertEqual(rows, self.house)

    def test_non_manifold_is_kept(self):
        for fins, count in ((1, 1), (3, 1)):  # on the edge from 1 to 2, which has two faces already
            corners = [*CORNERS, *(f"0.5 -1 {0.1 * i}" for i in range(fins))]
            self.write("fin.obj", obj(corners, [*FACES, *(f"1 2 {9 + i}" for i in range(fins))]))
            rows = self.warn("fin.obj", f"{count} edges belong to more than two triangles (non-manifold); kept")
            self.assertNotEqual(rows, self.house)
            self.assertEqual(self.report("fin.obj")["triangles"], 12 + fins)

    def test_open_glass(self):
        self.write("glass.mtl", "newmtl glass\nillum 6\nd 0.2\nNi 1.5\nKd 0.5 0.5 0.5\nTf 1 1 1\nKs 1 1 1\n")
        self.write("open.obj", "mtllib glass.mtl\nusemtl glass\n" + obj(faces=FACES[1:]))
        self.warn("open.obj", "10 triangles in 1 open components refract")
        self.write("closed.obj", "mtllib glass.mtl\nusemtl glass\n" + HOUSE)
        self.fine("closed.obj")


class FineTest(SceneCase):
    """The same scene written in other ways gives the same picture without any message."""

    def setUp(self):
        super().setUp()
        self.write("house.obj", HOUSE)
        self.house = self.fine("house.obj")

    def expect_same(self, text):
        self.assertEqual(self.fine(self.write_bytes("same.obj", text)), self.house)

    def test_line_ends_and_marks(self):
        continued = HOUSE.replace("v 1 0 0", "v 1 \\\n 0 0").replace("f 5 8", "f \\\n5\\\n 8")
        for text in (obj(end="\r\n"), obj(end="\r"), "\ufeff" + HOUSE, HOUSE.rstrip("\n"), continued,
                     continued.replace("\n", "\r\n"), HOUSE.replace(" ", "\t  "), HOUSE.replace("\n", " \n\n"),
                     "# ends in a backslash \\\n" + HOUSE):
            with self.subTest(text[:40]):
                self.expect_same(text)

    def test_what_is_not_drawn(self):
        self.expect_same("".join(f"v {v} 1 1 1\n" for v in CORNERS) + obj(corners=()))
        self.expect_same("".join(f"v {v} 0.5\n" for v in CORNERS) + obj(corners=()))
        self.expect_same("g a\no b\ns 1\nvp 1\n" + HOUSE + "p 1 2\nl 1 2 3\nvt 0 0\nl 1/1 2/1\ng\n")

    def test_indices_from_the_end_and_ahead(self):
        self.expect_same(obj(faces=[" ".join(str(int(i) - 9) for i in face.split()) for face in FACES]))
        self.expect_same(obj(corners=()) + obj(faces=()))

    def test_polygons(self):
        # A concave arrow, starting at each of its corners, and a comb of three teeth, against the
        # same cut by hand.
        arrow = ["0 0 0", "2 -1 0", "0 2 0", "-2 -1 0"]
        self.write("cut.obj", obj(arrow, ["1 2 3", "1 3 4"]))
        for turn in range(4):
            corners = [1 + (turn + i) % 4 for i in range(4)]
            self.write("whole.obj", obj(arrow, [" ".join(map(str, corners))]))
            self.assertEqual(self.fine("whole.obj"), self.fine("cut.obj"))
        comb = [f"{x} {y} 0" for x in range(6) for y in ((0, 3), (3, 0))[x % 2]] + ["5 -1 0", "0 -1 0"]
        self.write("comb.obj", obj(comb, [" ".join(str(i + 1) for i in range(14))]))
        self.assertEqual(self.report("comb.obj")["triangles"], 12)
        back, teeth = "14 1 12 13", ("1 2 3 4", "5 6 7 8", "9 10 11 12")
        self.write("cut.obj", obj(comb, [back, *teeth]))
        self.assertEqual(self.fine("comb.obj"), self.fine("cut.obj"))

    def test_locale(self):
        made = subprocess.run(["localedef", "--no-archive", "-i", "de_DE", "-f", "UTF-8", self.path("de_DE.UTF-8")],
                              capture_output=True) if os.path.exists("/usr/share/i18n/locales/de_DE") else None
        if made is None or not os.path.isdir(self.path("de_DE.UTF-8")):
            self.skipTest("this machine cannot make the locale de_DE")
        german = {"LOCPATH": self.folder, "LC_ALL": "de_DE.UTF-8"}
        comma = subprocess.run(["/usr/bin/printf", "%.1f", "1,5"], env=dict(os.environ, **german), capture_output=True)
        self.assertEqual(comma.stdout, b"1,5", "the locale is in force")
        self.succeed("render", "house.obj", *TINY, "-o", "plain.png")
        self.succeed("render", "house.obj", *TINY, "-o", "german.png", env=german)
        self.assertEqual(self.read("plain.png"), self.read("german.png"))
        plain, foreign = (self.succeed("inspect", "house.obj", "--json", env=env).stdout for env in ({}, german))
        self.assertEqual(plain, foreign)

    def test_far_from_the_origin(self):
        far = [" ".join(repr(float(c) + shift) for c, shift in zip(v.split(), (1e7, -1e7, 1e7))) for v in CORNERS]
        self.expect_same(obj(far))
        self.write("far.obj", obj(far))
        passes = ("--method", "hybrid", "--shadow-map", "256", "--size", "64x48", "-q")
        self.succeed("render", "house.obj", *passes, "-o", "near.png")
        self.succeed("render", "far.obj", *passes, "-o", "far.png")
        self.succeed("compare", "far.png", "near.png")


class ColourTest(SceneCase):
    FRONT = ("--eye", "0.3,0.3,3", "--target", "0.3,0.3,0", "--light", "0,0,1")

    def setUp(self):
        super().setUp()
        self.write("painted.obj", "v 0 0 0 1 .5 0\nv 1 0 0 1 .5 0\nv 0 1 0 0 0.25 1\nf 1 2 3\n")

    def test_is_told_but_is_no_warning(self):
        done = self.succeed("render", "painted.obj", "--size", "8x8", "--method", "raytrace", "-o", "p.png")
        says = "painted.obj: the colours of its vertices (sRGB, 0 to 1) are the diffuse colour of 1 triangles"
        self.assertIn("hybridrt: " + says, done.stderr)
        self.assertEqual(self.report("painted.obj")["notes"], [says])
        self.assertIn(says, self.succeed("inspect", "painted.obj").stdout)
        events = self.succeed("render", "painted.obj", "--size", "8x8", "--method", "raytrace", "--json").stdout
        self.assertIn('{"event":"note","message":"' + says, events)

    def test_linear(self):
        srgb = self.fine("painted.obj", *self.FRONT)
        self.write("half.obj", "v 0 0 0 1 .735357 0\nv 1 0 0 1 .735357 0\nv 0 1 0 0 0.537099 1\nf 1 2 3\n")
        linear = self.fine("painted.obj", *self.FRONT, "--mesh-colors", "linear")
        self.assertNotEqual(srgb, linear)
        self.assertEqual(linear, self.fine("half.obj", *self.FRONT))
        self.write("s.json", '{"meshes": ["painted.obj"], "settings": {"mesh-colors": "linear"}}')
        self.assertEqual(linear, self.fine("s.json", *self.FRONT))

    def test_every_method_agrees(self):
        for method in (["hybrid"], ["hybrid", "--shadows", "rays"], ["raster"], ["raytrace"], ["reference"]):
            self.succeed("render", "painted.obj", *self.FRONT, "--size", "96x72", "-q", "--shadow-map", "64", "--method",
                         *method, "-o", "_".join(method) + ".png")
            self.succeed("compare", "_".join(method) + ".png", "hybrid.png")


if __name__ == "__main__":
    unittest.main()
