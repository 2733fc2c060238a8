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
