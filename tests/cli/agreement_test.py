"""Every method's picture against the reference's, at a small size: the targets of scripts/agreement.py."""

import math
import pathlib
import sys
import unittest

from cli_test_case import BINARY, CliTestCase, Png

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
import agreement  # noqa: E402

SIZE = "160x120"
SCENES = ["scene:chess,triangles=20000", "scene:chess,triangles=20000,reflective=100", "scene:spheres,triangles=5000",
          "scene:spheres,triangles=5000,reflective=100", "scene:thin,triangles=20000"]


class AgreementTest(CliTestCase):
    def test_every_method_meets_the_targets(self):
        for scene in SCENES:
            results, _ = agreement.measure(BINARY, scene, SIZE)
            for method, found in results.items():
                with self.subTest(scene=scene, method=method):
                    self.assertEqual(found.missed(), [], agreement.row(scene, method, found))

    def test_triangles_on_one_another(self):
        """Seen directly and in a mirror the same one is shown by everything: of those that face the ray the first."""
        colors = {"red": "1 0 0", "green": "0 1 0", "blue": "0 0 1", "yellow": "1 1 0"}
        self.write("m.mtl", "".join(f"newmtl {name}\nKd {kd}\n" for name, kd in colors.items()) +
                   "newmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\n")
        self.write("two.obj", "mtllib m.mtl\nv -9 -9 -3\nv 9 -9 -3\nv 9 9 -3\nv -9 9 -3\nusemtl mirror\nf 1 2 3 4\n"
                   "v -2 0 0\nv -1 0 0\nv -1.5 2 0\nusemtl red\nf 5 6 7\nusemtl green\nf 6 7 5\n"
                   "v -2 -0 0\nv -1 0 -0\nv -1.5 2 0\nusemtl blue\nf 8 10 9\nusemtl yellow\nf 7 6 5\n")
        for options in (("--gl", "off"), ("--gl", "off", "--accel", "kdtree"), ("--gl", "egl"), ("--method", "raytrace"),
                        ("--method", "raytrace", "--accel", "kdtree"), ("--method", "reference")):
            self.succeed("render", "two.obj", "--size", "120x90", "--eye", "0,1,5", "--target", "0,1,0", "-q", "-o", "a.png",
                         *options)
            seen = dict.fromkeys(colors, 0)
            for row in Png.read(self.path("a.png")).rows:
                for r, g, b in zip(row[0::3], row[1::3], row[2::3]):
                    for name, kd in colors.items():
                        shown = [value > 60 for value in (r, g, b)]
                        seen[name] += shown == [c == "1" for c in kd.split()] and min(r, g, b) < 20
            with self.subTest(options=options):
                self.assertGreater(seen["red"], 100)
                self.assertGreater(seen["blue"], 20, "in the mirror")
                self.assertEqual((seen["green"], seen["yellow"]), (0, 0))

    def test_what_misses_is_seen(self):
        """One generation of rays less, and no shadows, miss the targets: they can fail."""
        for fewer in (["--reflection-depth", "1"], ["--shadows", "none"]):
            methods = [("fewer", ["--method", "raytrace", *fewer])]
            results, _ = agreement.measure(BINARY, SCENES[0], SIZE, methods=methods)
            self.assertEqual(results["fewer"].missed(), ["PSNR", "pixels off"], fewer)

    def test_numbers(self):
        """Of 10 pixels one is off by 10 in a channel, one by 2, and one by 20 where another triangle is seen."""
        def strip(values):
            return Png(10, 1, [bytearray(value for x in range(10) for value in (0, 0, values.get(x, 0)))])

        found = agreement.Agreement(strip({1: 10, 2: 2, 3: 20}), strip({}), strip({3: 1}), strip({}))
        self.assertEqual((found.off, found.other, found.off_elsewhere, found.worst), (2, 1, 1, 10))
        self.assertAlmostEqual(found.psnr, 10 * math.log10(255 ** 2 * 30 / 504))
        self.assertAlmostEqual(found.psnr_elsewhere, 10 * math.log10(255 ** 2 * 27 / 104))
        self.assertEqual(found.missed(), ["triangles", "PSNR", "pixels off"])
        self.assertEqual(agreement.Agreement(strip({1: 3}), strip({1: 3}), strip({}), strip({})).psnr, math.inf)


if __name__ == "__main__":
    unittest.main()
