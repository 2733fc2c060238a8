"""A scene that is far from the origin, tiny or huge gives the same picture as at the origin."""

import os
import unittest

from cli_test_case import CliTestCase, Png

STILL_LIFE = os.path.join(os.path.dirname(__file__), "..", "..", "scenes", "still_life.obj")
SIZE = ("--size", "160x120", "--shadow-map", "1024")


class RobustNumbersTest(CliTestCase):
    def moved(self, name, scale, offset):
        """The still life with every position p at scale p + offset, in enough digits for double precision."""
        with open(STILL_LIFE, encoding="utf-8") as file:
            lines = file.read().splitlines()
        for i, line in enumerate(lines):
            if line.startswith("v "):
                position = [float(x) * scale + o for x, o in zip(line.split()[1:], offset)]
                lines[i] = "v " + " ".join(f"{x:.17g}" for x in position)
            if line.startswith("mtllib "):
                lines[i] = "mtllib " + os.path.splitext(STILL_LIFE)[0] + ".mtl"
        return self.write(name, "\n".join(lines) + "\n")

    def picture(self, scene, *options):
        self.succeed("render", scene, *SIZE, "-q", "-o", "picture.png", *options)
        return Png.read(self.path("picture.png"))

    def expect_same(self, a, b, what):
        """Equal except for a few pixels at edges, where positions in single precision round differently."""
        self.assertEqual((a.width, a.height), (b.width, b.height))
        pixels = [(a.pixel(x, y), b.pixel(x, y)) for y in range(a.height) for x in range(a.width)]
        off = sum(max(abs(p - q) for p, q in zip(*pair)) > 2 for pair in pixels)
        self.assertLessEqual(off, len(pixels) // 1000, what)

    def test_scale_and_offset_change_no_picture(self):
        moves = {"far": (1, (1e7, -1e7, 1e7)), "tiny": (1e-4, (0, 0, 0)), "huge": (1e6, (0, 0, 0)),
                 "huge and far": (1e6, (1e9, 1e9, -1e9)), "tiny and away": (1e-4, (10, 20, -30))}
        for method in (("--shadows", "blur"), ("--shadows", "rays"), ("--method", "raytrace"), ("--method", "reference")):
            home = self.picture(self.moved("home.obj", 1, (0, 0, 0)), *method)
            self.assertGreater(len({bytes(row) for row in home.rows}), 50, "not much of a picture")
            for name, (scale, offset) in moves.items():
                with self.subTest(method=method, move=name):
                    self.expect_same(home, self.picture(self.moved("moved.obj", scale, offset), *method), name)

    def test_a_camera_given_in_world_space_follows(self):
        camera = lambda scale, o: ("--eye", ",".join(f"{scale * x + d:.17g}" for x, d in zip((3, 2, 4), o)),
                                   "--target", ",".join(f"{scale * x + d:.17g}" for x, d in zip((0, 0.5, 0), o)))
        home = self.picture(self.moved("home.obj", 1, (0, 0, 0)), *camera(1, (0, 0, 0)))
        for scale, offset in ((1, (1e7, 1e7, -1e7)), (1e6, (0, 0, 0)), (1e-4, (1, 1, 1))):
            there = self.picture(self.moved("moved.obj", scale, offset), *camera(scale, offset))
            self.expect_same(home, there, (scale, offset))


if __name__ == "__main__":
    unittest.main()
