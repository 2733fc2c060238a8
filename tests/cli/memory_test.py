"""--max-memory: what would need more is refused in one line before memory is allocated."""

import json
import os
import resource
import unittest

from cli_test_case import SCENE, SMALL, CliTestCase

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class MemoryTest(CliTestCase):
    def test_sizes_are_read(self):
        self.write("t.obj", TRIANGLE)
        for size, bytes_allowed in (("1G", 1 << 30), ("1.5GiB", 3 << 29), ("900M", 900 << 20), ("1T", 1 << 40),
                                    ("2000000KB", 2000000 << 10), ("4000000000", 4000000000)):
            report = json.loads(self.succeed("inspect", "t.obj", "--json", "--max-memory", size).stdout)
            self.assertEqual(report["memory_bytes"]["allowed"], bytes_allowed, size)
        for size in ("0", "-1", "1X", "G", "1GG", "1 G", "nan", "1e30", "1g", ""):
            if size:
                self.fail_with(2, "inspect", "t.obj", "--max-memory=" + size, says="--max-memory " + size)

    def test_the_default_is_what_the_machine_has(self):
        self.write("t.obj", TRIANGLE)
        allowed = json.loads(self.succeed("inspect", "t.obj", "--json").stdout)["memory_bytes"]["allowed"]
        self.assertLessEqual(allowed, os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        self.assertGreater(allowed, 64 << 20)
        unlimited = json.loads(self.succeed("inspect", "t.obj", "--json", "--max-memory", "none").stdout)
        self.assertIsNone(unlimited["memory_bytes"]["allowed"])

    def test_a_frame_too_large(self):
        self.fail_with(2, "render", SCENE, "--size", "20000x20000", "--max-memory", "8G",
                       says=("20000x20000", "8.0 GiB", "--size", "--max-memory"))
        self.fail_with(2, "render", SCENE, "--size", "20000x20000", "--max-memory", "8G", "--method", "raytrace",
                       says=("20000x20000",))
        self.assertEqual(self.files(), [])
        self.succeed("render", SCENE, "-q", "--max-memory", "1G", *SMALL)

    def test_a_scene_too_large(self):
        self.write("big.obj", TRIANGLE + "# much to say\n" * 1_000_000)
        self.fail_with(3, "render", "big.obj", *SMALL, "--max-memory", "40M", says=("big.obj", "40.0 MiB", "--max-memory"))
        self.fail_with(3, "inspect", "big.obj", *SMALL, "--max-memory", "40M", says="big.obj")
        self.fail_with(3, "inspect", "scene:spheres,triangles=20000000", *SMALL, "--max-memory", "1G", says="spheres")
        self.succeed("inspect", "big.obj", "--max-memory", "1G")

    def test_textures_that_claim_much_take_little(self):
        number = lambda value, size=4: value.to_bytes(size, "little")  # noqa: E731
        big = lambda value, size=4: value.to_bytes(size, "big")  # noqa: E731
        claims = {
            "claim.exr": number(20000630) + number(2) + b"x\0string\0" + number(0x7FFFFFFF) + bytes(1000),
            "claim.gif": b"GIF89a" + number(65535, 2) * 2 + bytes(25),
            # Progressive: its coefficients are kept.
            "claim.jpg": (b"\xff\xd8\xff\xc2" + big(17, 2) + b"\x08" + big(60000, 2) * 2 +
                          b"\3\1\x22\0\2\x11\0\3\x11\0\xff\xda" + big(12, 2) + b"\3\1\0\2\0\3\0\0\0\0" + bytes(20)),
            "claim_tiles.exr": (number(20000630) + number(0x202) + b"channels\0chlist\0" + number(19) + b"Y\0" + number(1) +
                                bytes(4) + number(1) * 2 + b"\0" + b"dataWindow\0box2i\0" + number(16) + bytes(8) +
                                number(15999) * 2 + b"tiles\0tiledesc\0" + number(9) + number(1) * 2 + b"\0\0" + bytes(9)),
            "claim.j2k": (big(0xFF4FFF51) + big(47, 2) + bytes(2) + big(16000) * 2 + bytes(8) + big(16000) * 2 + bytes(8) +
                          big(3, 2) + b"\7\1\1" * 3 + bytes(2000))}
        for name, content in claims.items():
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.write("t.mtl", f"newmtl m\nmap_Kd {name}\n")
            self.write("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
            done = self.succeed("render", "t.obj", *SMALL, "-q", "--gl", "off", "-o", "out/x.png")
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(f"{name}: cannot be read: ", done.stderr)
            with open(self.path("out/run.json"), encoding="utf-8") as file:
                self.assertLess(json.load(file)["peak_memory_mib"], 600, name)

    def test_textures_decoded_side_by_side_are_counted(self):
        self.write("t.obj", TRIANGLE)
        self.succeed("render", "t.obj", "-q", "--gl", "off", "--size", "2048x2048", "-o", "picture.jpg")
        with open(self.path("picture.jpg"), "rb") as file:
            picture = file.read()
        names = [f"picture{i}.jpg" for i in range(7)]
        for name in names:
            with open(self.path(name), "wb") as file:
                file.write(picture)
        self.write("t.mtl", "".join(f"newmtl {name}\nmap_Kd {name}\n" for name in names))
        self.write("t.obj", "mtllib t.mtl\nvt 0 0\n" +
                   "".join(f"usemtl {name}\nv {2 * i} 0 0\nv {2 * i + 1} 0 0\nv {2 * i} 1 0\nf -3/1 -2/1 -1/1\n" for i, name in enumerate(names)))
        # Seven times 22 MiB of texels, and at most twice 80 that are being decoded; all at once would be 560.
        done = self.succeed("render", "t.obj", *SMALL, "-q", "--gl", "off", "--threads", "8", "--max-memory", "700M", "-o",
                            "out/x.png")
        self.assertEqual(done.stderr, "")
        with open(self.path("out/run.json"), encoding="utf-8") as file:
            self.assertLess(json.load(file)["peak_memory_mib"], 550)
        refused = self.succeed("render", "t.obj", *SMALL, "-q", "--gl", "off", "--max-memory", "200M", "-o", "tight/x.png")
        self.assertIn("picture0.jpg: decoding its 2048x2048 pixels takes", refused.stderr)

    def test_a_contact_sheet_is_counted(self):
        render = ("render", SCENE, "-q", "--gl", "off", "--method", "raytrace", "--size", "320x960", "--frames", "20",
                  "--max-memory", "150M")
        self.fail_with(2, *render, "--contact-sheet", "sheet.png", says=("150", "--max-memory"))
        self.succeed(*render, "-o", "out/x.####.png")

    def test_a_contact_sheet_of_tall_pictures_is_no_larger_than_they_are(self):
        self.succeed("render", SCENE, "-q", "--gl", "off", "--size", "1x20000", "--frames", "3", "--contact-sheet",
                     "out/sheet.png", "-o", "out/x.####.png")
        with open(self.path("out/run.json"), encoding="utf-8") as file:
            self.assertLess(json.load(file)["peak_memory_mib"], 600)

    def test_refusing_takes_no_memory(self):
        # A header that promises 300 million vertices, in a sparse file that has room for them.
        header = ("ply\nformat binary_little_endian 1.0\nelement vertex 300000000\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n")
        with open(self.write("promise.ply", header), "r+b") as file:
            file.truncate(4_000_000_000)

        def bounded():
            resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))

        self.fail_with(3, "render", "promise.ply", *SMALL, "--method", "raytrace", "--max-memory", "2G",
                       says=("promise.ply", "2.0 GiB"), preexec_fn=bounded)


if __name__ == "__main__":
    unittest.main()
