"""How the real binary treats odd and bad MTL files."""

import os
import resource
import struct
import unittest
import zlib

from scene_case import SceneCase

# Two panels side by side; 'left' is on line 6, 'right' on line 8. Each has a whole texture.
PANELS = """v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv 1 0 0\nv 1 1 0
usemtl {}\nf 1/1 2/2 3/3 4/4\nusemtl {}\nf 2/1 5/2 6/3 3/4\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"""
FRONT = ("--eye", "0,0.5,3", "--target", "0,0.5,0", "--light", "0,0,1")
RED, BLUE = "newmtl red\nKd 0.8 0 0\n", "newmtl blue\nKd 0 0 0.8\n"


class MtlCase(SceneCase):
    def panels(self, libraries, left="red", right="blue"):
        self.write("panels.obj", "".join(f"mtllib {name}\n" for name in libraries) + PANELS.format(left, right))
        return "panels.obj"

    def setUp(self):
        super().setUp()
        self.write("both.mtl", RED + BLUE)
        self.expected = self.fine(self.panels(["both.mtl"]), *FRONT)
        self.write("grey.mtl", "newmtl red\nKd 0.8 0.8 0.8\nnewmtl blue\nKd 0.8 0.8 0.8\n")
        self.default = self.fine(self.panels(["grey.mtl"]), *FRONT)
        self.assertNotEqual(self.expected, self.default)

    def colours(self, rows):
        """The colours at the panels' middles."""
        return [tuple(rows[12][3 * x:3 * x + 3]) for x in (12, 20)]


class LibrariesTest(MtlCase):
    def test_missing_is_drawn_as_default(self):
        rows = self.warn(self.panels(["gone.mtl", "lost.mtl"]), "2 material files are missing (first: 'gone.mtl')",
                         "panels.obj: 4 triangles use materials that no MTL file defines ('red')", options=FRONT)
        self.assertEqual(rows, self.default)

    def test_unknown_material_is_drawn_as_default(self):
        rows = self.warn(self.panels(["both.mtl"], right="green"),
                         "panels.obj: 2 triangles use materials that no MTL file defines ('green')", options=FRONT)
        self.assertEqual([row[:48] for row in rows], [row[:48] for row in self.expected])
        self.assertEqual([row[48:] for row in rows], [row[48:] for row in self.default])

    def test_several_are_all_read(self):
        self.write("r.mtl", RED)
        self.write("b.mtl", BLUE)
        for libraries in (["r.mtl b.mtl"], ["r.mtl", "b.mtl"], ["b.mtl  r.mtl", "b.mtl"], ["./r.mtl", "b.mtl"]):
            self.assertEqual(self.fine(self.panels(libraries), *FRONT), self.expected, libraries)

    def test_names_with_spaces(self):
        self.write("my own  paints.mtl", RED.replace("red", "dark red  1") + BLUE)
        rows = self.fine(self.panels(["my own  paints.mtl"], left="dark red  1 "), *FRONT)
        self.assertEqual(rows, self.expected)
        self.write("b.mtl", BLUE)
        self.write("two words.mtl", RED)
        self.assertEqual(self.fine(self.panels(["b.mtl two words.mtl"]), *FRONT), self.expected)

    def test_line_ends_and_marks(self):
        for text in ((RED + BLUE).replace("\n", "\r\n"), "\ufeff" + RED + BLUE, (RED + BLUE).rstrip("\n"),
                     "\t" + RED.replace(" ", "\t ") + "# a comment\n\nunknown 1 2\n" + BLUE):
            self.write_bytes("same.mtl", text)
            self.assertEqual(self.fine(self.panels(["same.mtl"]), *FRONT), self.expected, text)

    def test_no_text(self):
        for data, says in ((b"newmtl red\nKd 1\0", "bad.mtl:2: a NUL byte"), ((RED + BLUE).encode("utf-16"), "UTF-16"),
                           (b"newmtl red\n" + b"x" * (9 << 20), "bad.mtl:2: a line longer than 8 MiB")):
            self.write_bytes("bad.mtl", data)
            self.refuse(self.panels(["bad.mtl"]), says)


class NumbersTest(MtlCase):
    def test_not_a_number(self):
        for statement, says in (("Kd nan 0 0", "Kd: 'nan'"), ("Kd 0 inf 0", "Kd: 'inf'"), ("Ks 0,5 0 0", "Ks: '0,5'"),
                                ("Ns 1e39", "Ns: '1e39'"), ("Ni x", "Ni: 'x'"), ("d", "d has no number"),
                                ("Tf 1 1", "Tf has no number"), ("illum -nan", "illum: '-nan'"),
                                ("Tr 0x1", "Tr: '0x1'")):
            with self.subTest(statement):
                self.write("bad.mtl", RED + statement + "\n" + BLUE)
                self.refuse(self.panels(["bad.mtl"]), "bad.mtl:3: " + says)

    def test_clamped(self):
        for ni in ("0", "-1.5"):
            self.write("odd.mtl", RED + f"illum 4\nTf .9 .9 .9\nNi {ni}\n" + BLUE + f"Ni {ni}\n")
            self.warn(self.panels(["odd.mtl"]),
                      "odd.mtl: 2 indices of refraction (Ni) are not above 0 and were set to 1")
            self.assertEqual([m["ni"] for m in self.report("panels.obj")["materials"]], [1, 1])
        self.write("odd.mtl", RED + "illum 11\n" + BLUE + "illum -1\n")
        self.warn(self.panels(["odd.mtl"]), "odd.mtl: 2 illumination models (illum)")

    def test_cut_anywhere(self):
        text = RED + "Ns 10\nillum 2\n"
        for size in range(0, len(text), 5):
            self.write("cut.mtl", text[:size])
            done = self.run_binary("inspect", self.panels(["cut.mtl"]), "--size", "8x8", "--threads", "1")
            self.assertIn(done.returncode, (0, 3), (size, done.stderr))


class TextureTest(MtlCase):
    def told(self, *says, maps):
        self.write("both.mtl", RED + "".join(f"map_Kd {name}\n" for name in maps) + BLUE)
        _, lines = self.picture(self.panels(["both.mtl"]), *FRONT)
        self.assertEqual(len(lines), len(says), lines)
        for line, part in zip(lines, says):
            self.assertIn(part, line)

    def write_png(self, name, width, height, color=(0, 0, 0)):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        packer = zlib.compressobj(1)
        row = b"\0" + bytes(color) * width
        body = b"".join(packer.compress(row) for _ in range(min(height, 64))) + packer.flush()
        header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        self.write_bytes(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) +
                         chunk(b"IEND", b""))

    def test_missing(self):
        self.told("both.mtl: 2 texture files are missing ('a.png', 'b.png') (first at line 3)",
                  maps=["a.png", "-s 2 2 b.png", "a.png"])

    def test_found_where_their_names_do_not_lead(self):
        os.mkdir(self.path("Maps"))
        self.write_png("wood.png", 2, 2)
        self.write_png("Maps/My Tile.png", 2, 2)
        self.told("both.mtl: 7 texture names lead to no file as written; found by case, decoding or their last part "
                  "('/usr/share/wood.png', ",
                  maps=["/usr/share/wood.png", "../wood.png", "C:\\maps\\wood.png", "WOOD.png", '"wood.png"',
                        "maps/my%20tile.PNG", "maps\\..\\..\\wood.png"])
        self.told(maps=["wood.png", "./wood.png", ".\\wood.png", "Maps\\My Tile.png"])

    def test_other_folders_are_read(self):
        os.makedirs(self.path("model", "mats"))
        self.write_png("outside.png", 2, 2, (0, 0, 255))
        self.write("model/mats/both.mtl", "newmtl red\nmap_Kd ../../outside.png\nnewmtl blue\nmap_Kd " +
                   self.path("outside.png") + "\n")
        self.panels(["../mats/both.mtl"])
        os.mkdir(self.path("model", "obj"))
        os.rename(self.path("panels.obj"), self.path("model", "obj", "panels.obj"))
        left, right = self.colours(self.fine("model/obj/panels.obj", *FRONT))
        self.assertEqual(left, right)
        self.assertEqual(left[:2], (0, 0), "blue")

    def test_pipes_folders_and_devices_are_checkers_at_once(self):
        os.mkfifo(self.path("pipe.png"))
        os.mkdir(self.path("folder.png"))
        for name in ("pipe.png", "folder.png", "/dev/zero", "/proc/kmsg"):
            with self.subTest(name):
                self.write("both.mtl", RED + f"map_Kd {name}\n" + BLUE)
                self.warn(self.panels(["both.mtl"]), "1 textures cannot be used: map_Kd becomes a checker", options=FRONT)

    def test_map_without_a_name_is_none(self):
        self.write_png("wood.png", 2, 2)
        for statements in ("map_Kd \nmap_Ks\n", "map_Kd wood.png\nmap_Kd\n"):
            self.write("both.mtl", RED + statements + BLUE)
            self.assertEqual(self.fine(self.panels(["both.mtl"]), *FRONT), self.expected)

    def test_corrupt_and_huge_are_checkers_and_take_no_memory(self):
        self.write_bytes("torn.png", b"\x89PNG\r\n\x1a\n\0\0\0")
        self.write_png("huge.png", 65535, 65535)
        self.write("both.mtl", RED + "map_Kd torn.png\n" + BLUE + "map_Kd huge.png\n")
        self.panels(["both.mtl"])
        rows, lines = self.picture("panels.obj", *FRONT)
        self.assertEqual(len(lines), 1, lines)
        self.assertIn("2 textures cannot be used: map_Kd becomes a checker", lines[0])
        self.assertIn("torn.png: broken image: it is cut short", lines[0])
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, 500 * 1024, "KiB")
        self.assertGreater(len({tuple(rows[12][3 * x:3 * x + 3]) for x in range(9, 16)}), 1, "a checker")

    def test_is_drawn_in_its_colour(self):
        self.write_png("wood.png", 5, 3, (200, 100, 50))
        linear = [((code / 255 + 0.055) / 1.055) ** 2.4 for code in (200, 100, 50)]
        self.write("number.mtl", "newmtl red\nKd {} {} {}\n".format(*(0.7 * x for x in linear)) + BLUE)
        expected = self.fine(self.panels(["number.mtl"]), *FRONT)
        self.write("both.mtl", "newmtl red\nKd .7 .7 .7\nmap_Kd -s 3 3 wood.png\n" + BLUE)
        for ours, theirs in zip(self.fine(self.panels(["both.mtl"]), *FRONT), expected):
            for a, b in zip(ours, theirs):
                self.assertLessEqual(abs(a - b), 1)

    def test_without_texture_coordinates(self):
        self.write_png("wood.png", 5, 3, (200, 100, 50))
        self.write("both.mtl", RED + "map_Kd wood.png\n" + BLUE)
        self.panels(["both.mtl"])
        with open(self.path("panels.obj"), encoding="utf-8") as file:
            text = file.read()
        self.write("panels.obj", text.replace("f 1/1 2/2 3/3 4/4", "f 1 2 3 4"))
        self.warn("panels.obj", "2 triangles have a texture but not all of their texture coordinates", options=FRONT)


if __name__ == "__main__":
    unittest.main()
