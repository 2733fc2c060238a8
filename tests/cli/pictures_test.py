"""What a picture holds besides colours: coverage, background, camera; and warnings of pictures that show nothing."""

import json
import os
import platform
import shutil
import struct
import subprocess
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase, Png

BOX = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n" \
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
METHODS = ("hybrid", "raster", "raytrace", "reference")


class AlphaTest(CliTestCase):
    def png(self, *options):
        self.render(*options, "-o", "a.png")
        return Png.read(self.path("a.png"))

    def test_alpha_is_coverage(self):
        for method in METHODS:
            plain, cut = self.png("--method", method), self.png("--method", method, "--alpha")
            self.assertEqual((plain.channels, cut.channels), (3, 4))
            for y in range(plain.height):
                for x in range(plain.width):
                    *color, alpha = cut.pixel(x, y)
                    self.assertIn(alpha, (0, 255))
                    self.assertEqual(tuple(color), plain.pixel(x, y) if alpha else (0, 0, 0))

    def test_alpha_of_samples(self):
        cut = self.png("--alpha", "--samples", "4")
        alphas = {cut.pixel(x, y)[3] for y in range(cut.height) for x in range(cut.width)}
        self.assertEqual(alphas, {0, 64, 128, 191, 255})
        # At an edge the colour is the surface's alone, however little it covers.
        background = self.png("--alpha", "--samples", "4", "--background", "9,0,0")
        self.assertTrue(all(background.pixel(x, y)[3] == cut.pixel(x, y)[3] for y in range(72) for x in range(96)))

    def test_samples_at_edges_only(self):
        one, every, adaptive = self.png(), self.png("--samples", "8"), self.png("--samples", "8", "--adaptive")
        places = [(x, y) for y in range(one.height) for x in range(one.width)]
        for x, y in places:
            self.assertIn(adaptive.pixel(x, y), (one.pixel(x, y), every.pixel(x, y)))
        smoothed = sum(adaptive.pixel(x, y) != one.pixel(x, y) for x, y in places)
        self.assertGreater(smoothed, len(places) // 100)
        off = sum(max(abs(a - b) for a, b in zip(adaptive.pixel(x, y), every.pixel(x, y))) > 6 for x, y in places)
        self.assertLess(off, len(places) // 1000)
        self.fail_with(2, "render", SCENE, *SMALL, "--adaptive", "-o", "a.png", says=("--adaptive", "--samples 8"))
        self.fail_with(2, "render", SCENE, *SMALL, "--adaptive", "--samples", "4", "--shadows", "blur", "-o", "a.png",
                       says=("--adaptive", "--shadows blur", "--shadows exact"))

    def test_formats_without_alpha_are_refused(self):
        self.fail_with(2, "render", SCENE, *SMALL, "--alpha", "-o", "a.jpg", says=("a.jpg", "--alpha", ".png"))
        self.assertEqual(self.files(), [])

    def test_background(self):
        for method in METHODS:
            self.assertEqual(self.png("--method", method, "--background", "1,0,0.25").pixel(0, 0), (255, 0, 137))
        self.write("scene.json", json.dumps({"meshes": ["box.obj"], "background": [0, 1, 0]}))
        self.write("box.obj", BOX)
        self.succeed("render", "scene.json", *SMALL, "-q", "-o", "b.png")
        self.assertEqual(Png.read(self.path("b.png")).pixel(0, 0), (0, 255, 0))
        self.succeed("render", "scene.json", *SMALL, "-q", "-o", "b.png", "--background", "0,0,1")
        self.assertEqual(Png.read(self.path("b.png")).pixel(0, 0), (0, 0, 255))
        self.fail_with(2, "render", SCENE, "--background", "-1,0,0", says="--background")


class PngTest(CliTestCase):
    def test_packing_changes_no_pixel(self):
        for name, options in (("fast", ()), ("small", ("--compression", "small"))):
            self.render(*options, "--alpha", "-o", name + ".png")
        self.assertEqual(Png.read(self.path("fast.png")).rows, Png.read(self.path("small.png")).rows)
        self.assertLess(len(self.read("small.png")), len(self.read("fast.png")))
        self.fail_with(2, "render", SCENE, *SMALL, "--compression", "tiny", says="fast, small")

    @unittest.skipUnless(shutil.which("pngcheck"), "no pngcheck")
    def test_pngcheck_finds_nothing(self):
        for number, options in enumerate(((), ("--alpha",), ("--compression", "small"), ("--aov", "id,depth,shadow"),
                                          ("--contact-sheet", "sheet.png"), ("--crop", "40,30,1,1"), ("--crop", "40,3,1,60"))):
            self.render(*options, "-o", f"{number}.png")
        pictures = [name for name in self.files() if name.endswith(".png")]
        done = subprocess.run(["pngcheck", "-q", *pictures], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    @unittest.skipUnless(shutil.which("qemu-x86_64") and platform.machine() == "x86_64", "no qemu-user")
    def test_the_processor_decides_no_byte(self):
        for name, light in (("a", "1,2,3"), ("b", "-1,2,-3")):
            self.render("--light", light, "-o", name + ".png")
        for extension in ("png", "exr"):
            for processor in ("", "Nehalem", "Haswell"):
                emulator = ["qemu-x86_64", "-cpu", processor] if processor else []
                subprocess.run([*emulator, BINARY, "compare", "a.png", "b.png", "--diff", f"d{processor}.{extension}"],
                               cwd=self.folder, capture_output=True, timeout=200)
                self.assertEqual(self.read("d." + extension), self.read(f"d{processor}.{extension}"), processor)


class ExrHeaderTest(CliTestCase):
    def matrix(self, name):
        data = self.read("a.exr")
        start = data.index(name.encode() + b"\0m44f\0") + len(name) + 6 + 4
        return struct.unpack("<16f", data[start:start + 64])

    def project(self, matrix, point):
        row = (*point, 1)
        x, y, z, w = (sum(row[k] * matrix[4 * k + i] for k in range(4)) for i in range(4))
        return x / w, y / w, z / w

    def test_camera(self):
        self.render("--eye", "3,2,5", "--target", "1,0,-1", "--fov", "40", "-o", "a.exr")
        x, y, z = self.project(self.matrix("worldToCamera"), (1, 0, -1))
        self.assertAlmostEqual(x, 0, places=5)
        self.assertAlmostEqual(y, 0, places=5)
        self.assertAlmostEqual(z, -(4 + 4 + 36) ** 0.5, places=4)
        x, y, _ = self.project(self.matrix("worldToNDC"), (1, 0, -1))
        self.assertAlmostEqual(x, 0, places=5)
        self.assertAlmostEqual(y, 0, places=5)
        self.assertGreater(self.project(self.matrix("worldToNDC"), (1, 0.5, -1))[1], 0.1, "y up")


class NothingToSeeTest(CliTestCase):
    def warnings_of(self, *options):
        self.write("box.obj", BOX)
        done = self.succeed("render", "box.obj", *SMALL, "-q", "-o", "x.####.png", *options)
        return done.stderr.splitlines()

    def test_empty(self):
        for method in METHODS:
            lines = self.warnings_of("--eye", "0,0,9", "--target", "0,0,20", "--method", method, "--frames", "3")
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("frame 1 shows nothing but background", lines[0])
        with open(self.path("run.json"), encoding="utf-8") as file:
            self.assertEqual(len(json.load(file)["warnings"]), 1)

    def test_dark(self):
        for method, shadows in (("hybrid", "exact"), ("hybrid", "none"), ("hybrid", "map"), ("raster", "map"),
                                ("raytrace", "rays"), ("reference", "rays")):
            dark = ("--eye", "0.5,0.5,4", "--target", "0.5,0.5,0", "--method", method, "--shadows", shadows)
            lines = self.warnings_of(*dark, "--light", "0,0,-1", "--frames", "2")
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("frame 1: no light arrives at anything in view", lines[0])
            self.assertEqual(self.warnings_of(*dark, "--light", "0,0,1"), [])

    def test_no_lights_is_not_dark(self):
        self.write("box.obj", BOX)
        self.write("unlit.json", json.dumps({"meshes": ["box.obj"], "lights": []}))
        self.assertEqual(self.succeed("render", "unlit.json", *SMALL, "-q").stderr, "")

    def test_crops_may_be_empty(self):
        self.assertEqual(self.warnings_of("--crop", "0,0,4,4"), [])
        self.assertEqual(os.path.exists(self.path("x.0001.png")), True)


class FirstPictureTest(CliTestCase):
    # Five walls of a room seen from their front, and the one that closes it.
    ROOM = BOX.split("f ")[0] + "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n" \
           "v 0.4 0.1 0.1\nv 0.6 0.1 0.1\nv 0.5 0.2 0.1\nf 9 10 11\n"

    def test_the_carried_light_stays_with_a_camera_of_ones_own(self):
        self.write("room.obj", self.ROOM)
        self.write("path.json", json.dumps({"keyframes": [
            {"frame": 1, "eye": [0.5, 0.5, 0.6], "target": [0.5, 0.4, 0]}]}))
        for camera in (("--eye", "0.5,0.5,0.6", "--target", "0.5,0.4,0"), ("--camera", "path.json")):
            done = self.succeed("render", "room.obj", *SMALL, "-q", "-o", "x.png", *camera)
            self.assertEqual(done.stderr, "", "some light arrives")
            self.assertGreater(min(Png.read(self.path("x.png")).pixel(48, 36)), 150)

    def test_a_camera_inside_a_solid_is_told(self):
        self.write("box.obj", BOX)
        told = "the camera is inside a solid body"
        inside = ("--eye", "0.5,0.5,0.6", "--target", "0.5,0.4,0")
        for method in METHODS:
            done = self.succeed("render", "box.obj", *SMALL, "-q", *inside, "--frames", "2", "--method", method)
            self.assertEqual(done.stderr.count(told), 1)
        self.assertEqual(self.succeed("render", "box.obj", *SMALL, "-q", "--eye", "2,2,2").stderr, "")
        self.write("room.obj", self.ROOM)
        self.assertNotIn(told, self.succeed("render", "room.obj", *SMALL, "-q", *inside).stderr)

    def test_z_up_is_suggested(self):
        lines = BOX.splitlines()
        flat = "\n".join(line[:-1] + "0.1" if line.startswith("v ") and line.endswith("1") else line for line in lines)
        self.write("flat.obj", flat + "\n")
        hint = "if z points up, say --up-axis z"
        self.assertIn(hint, self.succeed("render", "flat.obj", *SMALL, "-q").stderr)
        for axis in "yz":
            self.assertEqual(self.succeed("render", "flat.obj", *SMALL, "-q", "--up-axis", axis).stderr, "")
        self.write("box.obj", BOX)
        self.assertEqual(self.succeed("render", "box.obj", *SMALL, "-q").stderr, "")

    def test_ground(self):
        self.write("box.obj", BOX)
        for method in METHODS:
            self.succeed("render", "box.obj", *SMALL, "-q", "-o", "x.png", "--ground", "--method", method)
            picture = Png.read(self.path("x.png"))
            self.assertEqual(len({picture.pixel(x, 71) for x in (0, 95)}), 1)
            self.assertNotEqual(picture.pixel(0, 71), picture.pixel(0, 0), "ground below, background above")


if __name__ == "__main__":
    unittest.main()
