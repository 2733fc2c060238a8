"""Bodies that are wound inside out: turned with a warning, and drawn as if they had been right."""

import math
import unittest

from cli_test_case import Png
from scene_case import SceneCase

MTL = "newmtl glass\nKs .1 .1 .1\nNi 1.5\nillum 7\nTf 1 1 1\nnewmtl floor\nKd .8 .2 .1\n"


class Mesh:
    def __init__(self):
        self.text, self.vertices, self.corners = "", 0, 0

    def face(self, corners, inward):
        order = corners[::-1] if inward else corners
        self.text += "f " + " ".join(str(self.vertices + c + 1) for c in order) + "\n"

    def ball(self, radius, inward, at=(0, 0, 0), rings=9, segments=16):
        ring = [(0, radius, 0)]
        for i in range(1, rings):
            a = math.pi * i / rings
            ring += [(radius * math.sin(a) * math.cos(b), radius * math.cos(a), -radius * math.sin(a) * math.sin(b))
                     for b in (2 * math.pi * j / segments for j in range(segments))]
        ring.append((0, -radius, 0))
        self.text += "".join("v %g %g %g\n" % tuple(p + q for p, q in zip(v, at)) for v in ring)
        at_ring = lambda i, j: 1 + (i - 1) * segments + j % segments
        for j in range(segments):
            self.face([0, at_ring(1, j), at_ring(1, j + 1)], inward)
            self.face([len(ring) - 1, at_ring(rings - 1, j + 1), at_ring(rings - 1, j)], inward)
            for i in range(1, rings - 1):
                self.face([at_ring(i, j), at_ring(i + 1, j), at_ring(i + 1, j + 1), at_ring(i, j + 1)], inward)
        self.vertices += len(ring)
        return self

    def floor(self):
        self.text += "usemtl floor\nv -4 -1.5 -4\nv 4 -1.5 -4\nv 4 -1.5 4\nv -4 -1.5 4\n"
        self.face([3, 2, 1, 0], False)
        self.vertices += 4
        return self

    def use(self, material):
        self.text += f"usemtl {material}\n"
        return self


class InsideOutTest(SceneCase):
    def setUp(self):
        super().setUp()
        self.write("m.mtl", MTL)

    def save(self, name, mesh):
        self.write(name, ("mtllib m.mtl\n" if "usemtl" in mesh.text else "") + mesh.text)
        return name

    def far_pixels(self, a, b):
        return sum(abs(x - y) > 2 for r, s in zip(a, b) for x, y in zip(r, s))

    def test_glass_is_glass(self):
        near = ("--eye", "0,0.5,3")
        right = self.fine(self.save("right.obj", Mesh().use("glass").ball(1, False).floor()), *near)
        turned = self.warn(self.save("inward.obj", Mesh().use("glass").ball(1, True).floor()),
                           "1 closed bodies were wound inward and are turned outward (first: ", options=near)
        self.assertLess(self.far_pixels(right, turned), 20, "polygons may be cut along other diagonals")
        bubble = self.fine(self.save("bubble.obj", Mesh().use("glass").ball(1, False).ball(.7, True).floor()), *near)
        self.assertGreater(self.far_pixels(right, bubble), 200)
        mirrored = self.warn(self.save("bottle.obj", Mesh().use("glass").ball(1, True).ball(.7, False).floor()),
                             "turned outward, 1 cavities in them the other way", options=near)
        self.assertLess(self.far_pixels(bubble, mirrored), 20)

    def test_exact_stays_exact(self):
        self.save("inward.obj", Mesh().ball(1, True).ball(.3, True, (1, 1, 0)).floor())
        pictures = []
        for shadows in ("exact", "rays"):
            self.succeed("render", "inward.obj", "--shadows", shadows, "--size", "64x48", "-q", "-o",
                         shadows + ".png")
            pictures.append(Png.read(self.path(shadows + ".png")).rows)
        self.assertEqual(*pictures)

    def test_where_the_camera_stands(self):
        inside = "the scene looks like a room, and the camera stands in it"
        self.warn(self.save("dome.obj", Mesh().ball(20, True).ball(1, False)), inside)
        self.warn(self.save("alone.obj", Mesh().ball(20, True)), "1 closed bodies were wound inward")
        self.fine(self.save("bodies.obj", Mesh().ball(1, False).ball(1, False, (3, 0, 0))))
        report = self.report("dome.obj", "--eye", "0,0,60")
        self.assertEqual(report["warnings"], [], "the user has said where")
        self.assertEqual(report["components"]["largest"][0]["winding"], "inward")


if __name__ == "__main__":
    unittest.main()
