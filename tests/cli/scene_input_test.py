"""Scene files, cameras and crops through the real binary: pictures, warnings, exit codes."""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest

from png_file import Png

BINARY = os.path.abspath(sys.argv.pop(1))

# A pyramid on a floor; every side is at a different place in the picture.
VERTICES = [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1), (0, 1.5, 0), (-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]
FACES = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (5, 6, 7, 8)]


def obj(vertices=VERTICES, faces=FACES):
    return "".join("v %r %r %r\n" % v for v in vertices) + "".join(
        "f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def ply(vertices=VERTICES, faces=FACES):
    return ("ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(vertices), len(faces)) +
            "".join("%r %r %r\n" % v for v in vertices) +
            "".join("%d %s\n" % (len(face), " ".join(map(str, face))) for face in faces))


def off(vertices=VERTICES, faces=FACES):
    return "OFF\n%d %d 0\n" % (len(vertices), len(faces)) + ply(vertices, faces).split("end_header\n")[1]


def binary_stl(vertices=VERTICES, faces=FACES):
    triangles = [(f[0], f[i - 1], f[i]) for f in faces for i in range(2, len(f))]
    return b"\0" * 80 + struct.pack("<I", len(triangles)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in t for x in vertices[i]), 0) for t in triangles)


class SceneInputTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.write("pyramid.obj", obj())

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return name

    def write_json(self, name, value):
        return self.write(name, json.dumps(value))

    def run_binary(self, *arguments):
        return subprocess.run([BINARY, *arguments], cwd=self.folder.name, capture_output=True, text=True, timeout=120)

    def render(self, scene, output, *options, code=0):
        """Renders small, on the CPU unless told otherwise; returns standard error."""
        method = () if "--method" in options else ("--method", "raytrace")
        size = () if "--size" in options or scene.endswith("settings.json") else ("--size", "64x48")
        done = self.run_binary("render", scene, "-q", "-o", output, "--threads", "1", *method, *size, *options)
        self.assertEqual(done.returncode, code, f"{scene} {options}\n{done.stdout}\n{done.stderr}")
        if code != 0:
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("hybridrt: "), done.stderr)
        return done.stderr

    def pixels(self, name):
        """Width, height and rows of a PNG, by our own decoder."""
        picture = Png.read(self.path(name))
        return picture.width, picture.height, picture.rows

    def same(self, a, b):
        return self.pixels(a) == self.pixels(b)

    def test_every_format_gives_the_same_picture(self):
        self.render("pyramid.obj", "obj.png")
        for name, text in (("a.ply", ply()), ("a.off", off()), ("a.stl", binary_stl())):
            self.render(self.write(name, text), name + ".png")
            self.assertTrue(self.same("obj.png", name + ".png"), name)

    def test_up_axis_z_gives_the_same_picture(self):
        self.render("pyramid.obj", "y.png", "--eye", "2,3,5", "--target", "0,0.5,0", "--light", "1,2,1")
        z_up = [(x, -z, y) for x, y, z in VERTICES]
        self.write("z.obj", obj(z_up))
        self.render("z.obj", "z.png", "--up-axis", "z", "--eye", "2,-5,3", "--target", "0,0,0.5", "--light", "1,-1,2")
        self.assertTrue(self.same("y.png", "z.png"), "cameras and lights are in the axes of the files")
        self.write_json("z.json", {"meshes": ["z.obj"], "up_axis": "z",
                                   "camera": {"eye": [2, -5, 3], "target": [0, 0, 0.5]},
                                   "lights": [{"type": "directional", "toward": [1, -1, 2], "color": [0.85, 0.85, 0.85]}]})
        self.render("z.json", "zj.png")
        self.assertTrue(self.same("y.png", "zj.png"))
        self.assertIn("--up-axis w", self.render("pyramid.obj", "x.png", "--up-axis", "w", code=2))

    def test_scene_json(self):
        self.write("left.obj", obj(faces=FACES[:4]))
        self.write("floor.ply", ply(faces=FACES[4:]))
        self.write_json("s.json", {"meshes": ["left.obj", "floor.ply"]})
        self.render("s.json", "s.png")
        self.render("pyramid.obj", "p.png")
        self.assertTrue(self.same("s.png", "p.png"), "two meshes are the one")
        self.write_json("settings.json", {"meshes": ["pyramid.obj"], "background": [0, 0, 1], "ambient": [1, 1, 1],
                                          "settings": {"size": "40x30", "frames": "7-8", "shadows": "none"}})
        self.render("settings.json", "t.####.png")
        width, height, rows = self.pixels("t.0007.png")
        self.assertEqual((width, height), (40, 30))
        self.assertEqual(rows[0][:3], b"\0\0\xff", "the background")
        self.assertTrue(os.path.exists(self.path("t.0008.png")))
        self.render("settings.json", "u.png", "--size", "20x10", "--frames", "1")
        self.assertEqual(self.pixels("u.png")[:2], (20, 10), "the command line wins")

    def test_scene_json_faults(self):
        def fault(value):
            return self.render(self.write_json("bad.json", value), "x.png", code=3)
        good = {"meshes": ["pyramid.obj"]}
        self.assertIn("unknown key 'light'", fault({**good, "light": 1}))
        self.assertIn("there are 9 lights; at most 8",
                      fault({**good, "lights": [{"type": "directional", "toward": [0, 1, 0]}] * 9}))
        for kind in ("point", "spot", "environment"):
            self.assertIn(f"lights[0].type: type '{kind}' is not supported yet; directional lights are",
                          fault({**good, "lights": [{"type": kind, "position": [0, 1, 0]}]}))
        self.assertIn("no render option 'sizes'", fault({**good, "settings": {"sizes": "3x3"}}))
        self.assertIn("--size 0x0", fault({**good, "settings": {"size": "0x0"}}))
        self.assertIn("gone.obj cannot be opened", fault({"meshes": ["gone.obj"]}))
        self.write("bad.json", '{"meshes": [\n  oops\n]}')
        self.assertIn("bad.json:2:3: not JSON", self.render("bad.json", "x.png", code=3))

    def key(self, frame, eye, **more):
        return {"frame": frame, "eye": eye, "target": [0, 0.5, 0], **more}

    def test_camera_path(self):
        self.write_json("c.json", {"keyframes": [self.key(2, [0, 2, 7], fov_y_deg=50), self.key(6, [7, 2, 0])]})
        self.render("pyramid.obj", "c.####.png", "--camera", "c.json", "--frames", "1-7", "--light", "1,2,1")
        self.assertTrue(self.same("c.0001.png", "c.0002.png"), "held before the first key")
        self.assertTrue(self.same("c.0006.png", "c.0007.png"), "and after the last")
        self.assertFalse(self.same("c.0003.png", "c.0004.png"))
        self.render("pyramid.obj", "still.png", "--eye", "0,2,7", "--target", "0,0.5,0", "--fov", "50", "--light", "1,2,1")
        self.assertTrue(self.same("c.0002.png", "still.png"))
        self.render("pyramid.obj", "wide.png", "--camera", "c.json", "--frames", "2-2", "--light", "1,2,1", "--fov", "80")
        self.assertFalse(self.same("c.0002.png", "wide.png"), "--fov replaces the path's")

    def test_light_moves_with_the_keys(self):
        lights = [self.key(1, [0, 2, 7], light=[1, 2, 1]), self.key(3, [0, 2, 7], light=[-1, 2, 1])]
        self.write_json("l.json", {"keyframes": lights})
        for method in (("--method", "raytrace"), ("--method", "hybrid", "--shadows", "map")):
            self.render("pyramid.obj", "l.####.png", "--camera", "l.json", "--frames", "1-3", *method)
            self.render("pyramid.obj", "f.####.png", "--camera", "l.json", "--frames", "1-3", "--light", "1,2,1", *method)
            self.assertFalse(self.same("l.0001.png", "l.0003.png"))
            self.assertTrue(self.same("f.0001.png", "f.0003.png"), "--light replaces the path's")
            self.assertTrue(self.same("l.0001.png", "f.0001.png"))
            self.render("pyramid.obj", "last.png", "--camera", "l.json", "--frames", "3-3", *method)
            self.assertTrue(self.same("l.0003.png", "last.png"), "a frame does not depend on those before it")

    def scene_with_lights(self, name, *directions, **more):
        lights = [{"type": "directional", "toward": toward, "color": 0.5} for toward in directions]
        camera = {} if "camera_path" in more else {"camera": {"eye": [1, 3, 6], "target": [0, 0.5, 0]}}
        return self.write_json(name, {"meshes": ["pyramid.obj"], "lights": lights, **camera, **more})

    def test_several_lights(self):
        left, right = [-1, 2, 1], [1, 2, 1]
        self.scene_with_lights("none.json")
        self.scene_with_lights("left.json", left)
        self.scene_with_lights("both.json", left, right)
        self.scene_with_lights("other_way.json", right, left)
        for method in (("--method", "raytrace"), ("--method", "hybrid"), ("--method", "hybrid", "--shadows", "blur")):
            for name in ("none", "left", "both", "other_way"):
                self.render(name + ".json", name + ".png", *method)
            pictures = {name: b"".join(self.pixels(name + ".png")[2]) for name in ("none", "left", "both", "other_way")}
            self.assertTrue(all(a <= b <= c for a, b, c in zip(*(pictures[n] for n in ("none", "left", "both")))))
            self.assertEqual(len({pictures[n] for n in ("none", "left", "both")}), 3)
            self.assertTrue(all(abs(a - b) <= 1 for a, b in zip(pictures["both"], pictures["other_way"])))
            # --light replaces them all, in the colour of the first.
            self.render("both.json", "replaced.png", "--light", "-1,2,1", *method)
            self.assertTrue(self.same("replaced.png", "left.png"))
        report = json.loads(self.run_binary("inspect", "both.json", "--json").stdout)
        self.assertEqual([light["color"] for light in report["frame"]["lights"]], [[0.5, 0.5, 0.5]] * 2)
        self.assertAlmostEqual(report["frame"]["lights"][1]["toward"][0], 1 / 6 ** 0.5)
        self.assertEqual(json.loads(self.run_binary("inspect", "none.json", "--json").stdout)["frame"]["lights"], [])
        text = self.run_binary("inspect", "both.json").stdout
        self.assertEqual(text.count("toward the light"), 2)
        self.assertIn("for each of 2 lights", text)
        self.assertIn("none: ambient light and Ke only", self.run_binary("inspect", "none.json").stdout)

    def test_keys_move_the_first_of_several_lights(self):
        keys = {"keyframes": [self.key(1, [0, 2, 7], light=[1, 2, 1]), self.key(3, [0, 2, 7], light=[-1, 2, 1])]}
        still = {"keyframes": [self.key(1, [0, 2, 7])]}
        self.scene_with_lights("moving.json", [0, 1, 0], [0.2, 1, 2], camera_path=keys)
        self.scene_with_lights("last.json", [-1, 2, 1], [0.2, 1, 2], camera_path=still)
        for method in (("--method", "raytrace"), ("--method", "hybrid", "--shadows", "map")):
            self.render("moving.json", "m.####.png", "--frames", "1-3", *method)
            self.render("last.json", "last.png", *method)
            self.assertFalse(self.same("m.0001.png", "m.0003.png"))
            self.assertTrue(self.same("m.0003.png", "last.png"))
        self.scene_with_lights("dark.json", camera_path=keys)
        self.assertIn("the scene's list of lights is empty",
                      self.run_binary("render", "dark.json", "--method", "raytrace", "--size", "8x8").stderr)

    def test_light_follows_camera(self):
        # The pyramid looks alike from all four sides, so a turn by 90 degrees with the light changes nothing.
        options = ("--frames", "1-4", "--light", "1,2,0.5")
        self.write_json("o.json", {"orbit": {"target": [0, 0.5, 0], "radius": 7, "height": 2}})
        self.render("pyramid.obj", "o.####.png", "--camera", "o.json", "--light-follows", "camera", *options)
        width, height, first = self.pixels("o.0001.png")
        second = self.pixels("o.0002.png")[2]
        far = sum(abs(a - b) > 2 for r, s in zip(first, second) for a, b in zip(r, s))
        self.assertLess(far, 0.01 * 3 * width * height)
        self.render("pyramid.obj", "w.####.png", "--camera", "o.json", *options)
        self.assertTrue(self.same("o.0001.png", "w.0001.png"))
        fixed = self.pixels("w.0002.png")[2]
        self.assertGreater(sum(abs(a - b) > 2 for r, s in zip(first, fixed) for a, b in zip(r, s)),
                           0.02 * 3 * width * height, "without it the light stays in the world")
        self.assertIn("--light-follows sun", self.render("pyramid.obj", "x.png", "--light-follows", "sun", code=2))

    def cut(self, name, x, y, width, height):
        return width, height, [row[3 * x:3 * (x + width)] for row in self.pixels(name)[2][y:y + height]]

    def test_crop_is_a_part_of_the_frame(self):
        for options in (("--method", "raytrace"), ("--method", "reference"), ("--method", "raster"),
                        ("--method", "hybrid", "--blur-kernel", "15"), ("--method", "hybrid", "--shadows", "rays")):
            aov = ("--aov", "id,shadow,normal", *options)
            self.render("pyramid.obj", "whole.png", *aov)
            for rect in ((20, 11, 25, 30), (0, 0, 64, 48), (63, 47, 1, 1)):
                self.render("pyramid.obj", "part.png", "--crop", "%d,%d,%d,%d" % rect, *aov)
                for name in ("%s.png", "%s.id.png", "%s.shadow.png", "%s.normal.png"):
                    self.assertEqual(self.pixels(name % "part"), self.cut(name % "whole", *rect), f"{options} {rect} {name}")

    def test_crop_faults(self):
        for crop in ("60,0,5,5", "0,44,5,5", "-1,0,5,5", "0,0,0,5", "0,0,5", "0,0,5,5,5", "a,0,5,5", "2147483647,0,2147483647,1"):
            self.assertIn("--crop " + crop, self.render("pyramid.obj", "x.png", "--crop=" + crop, code=2))

    def test_aovs_are_layers_of_an_exr(self):
        self.render("pyramid.obj", "l.exr", "--aov", "id,shadow,depth,normal")
        self.assertEqual([name for name in os.listdir(self.folder.name) if name.endswith(".exr")], ["l.exr"])
        with open(self.path("l.exr"), "rb") as file:
            header = file.read(2000)
        for channel, kind in (("R", 2), ("id", 0), ("shadow", 2), ("Z", 2), ("N.X", 2), ("N.Z", 2)):
            self.assertIn(channel.encode() + b"\0" + struct.pack("<i", kind), header, channel)

    def test_meshes_far_from_the_origin(self):
        shift = (1e7, -2e7, 3e7)
        moved = [tuple(a + b for a, b in zip(v, shift)) for v in VERTICES]
        self.render("pyramid.obj", "near.png")
        for name, text in (("far.ply", ply(moved)), ("far.off", off(moved)), ("far.obj", obj(moved))):
            self.render(self.write(name, text), name + ".png")
            self.assertTrue(self.same("near.png", name + ".png"), name)

    def test_mesh_faults(self):
        for name in ("a.ply", "a.off", "a.stl"):
            self.render(self.write(name, b""), "x.png", code=3)
            self.render(self.write(name, bytes(range(256)) * 8), "x.png", code=3)
            os.remove(self.path(name))
            self.assertIn("does not exist", self.render(name, "x.png", code=3))
            os.mkdir(self.path(name))
            self.assertIn("directory", self.render(name, "x.png", code=3))
        self.assertIn(".abc files are not read", self.render(self.write("a.abc", "x"), "x.png", code=3))
        for name, text in (("b.ply", ply()), ("b.off", off()), ("b.stl", binary_stl())):
            self.render(self.write(name, text[:len(text) // 2]), "x.png", code=3)


if __name__ == "__main__":
    unittest.main()
