"""hybridrt inspect through the real binary: text, JSON, warnings, the steps of a frame, exit codes."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

BINARY = os.path.abspath(sys.argv.pop(1))

CUBE = """mtllib cube.mtl
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1
usemtl paint
f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2
usemtl last
"""
LAST_FACE = "f 5 6 8 7\n"
MATTE = "newmtl paint\nKd 0.5 0.5 0.5\nillum 1\nnewmtl last\nKd 0.2 0.3 0.4\nKs 0.5 0.5 0.5\nNs 20\nillum 2\n"
MIRROR = MATTE.replace("illum 2", "illum 3")
GLASS = MATTE.replace("illum 1", "illum 6\nNi 1.5")


class InspectTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        with open(os.path.join(self.folder.name, name), "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())

    def cube(self, mtl=MATTE, obj=CUBE + LAST_FACE):
        self.write("cube.obj", obj)
        self.write("cube.mtl", mtl)

    def run_binary(self, *arguments):
        return subprocess.run([BINARY, *arguments], cwd=self.folder.name, capture_output=True, timeout=120,
                              env={**os.environ, "DISPLAY": ""})

    def text(self, *arguments):
        done = self.run_binary("inspect", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, b"")
        return done.stdout.decode("utf-8", "replace")

    def json(self, *arguments):
        return json.loads(self.text(*arguments, "--json"))

    def steps(self, *arguments):
        return {step["step"]: step for step in self.json("cube.obj", *arguments)["frame"]["steps"]}

    def test_json_tells_everything(self):
        self.cube()
        report = self.json("cube.obj")
        self.assertEqual(report["files"], ["cube.obj", "cube.mtl"])
        self.assertEqual((report["triangles"], report["vertices"]), (12, 8))
        self.assertEqual(report["normals"], {"given_corners": 0, "built_corners": 36})
        self.assertEqual(report["bounds"], {"lo": [0, 0, 0], "hi": [1, 1, 1]})
        self.assertEqual(report["extent"], [1, 1, 1])
        self.assertEqual(report["warnings"], [])
        self.assertEqual(report["edges"], {"count": 18, "boundary": 0, "inconsistent": 0, "non_manifold": 0})
        components = report["components"]
        self.assertEqual((components["count"], components["closed"], components["open"]), (1, 1, 0))
        self.assertEqual(components["largest"][0]["winding"], "outward")
        self.assertEqual(components["largest"][0]["volume"], 1)
        self.assertEqual([(m["name"], m["kind"], m["triangles"]) for m in report["materials"]],
                         [("paint", "matte", 10), ("last", "highlight", 2)])
        self.assertEqual(report["materials"][1]["kd"], [0.2, 0.3, 0.4])
        for what in ("scene", "accelerator", "topology"):
            self.assertGreater(report["memory_bytes"][what], 0)
        drawn = self.json("cube.obj", "--gl", "egl")
        for what in ("gpu_scene", "gpu_frames"):
            self.assertGreater(drawn["memory_bytes"][what], 0)
        self.assertEqual(drawn["frame"]["passes"], "gl")
        self.assertEqual(self.json("cube.obj", "--gl", "off")["frame"]["passes"], "cpu")
        self.assertEqual(report["frame"]["number"], 1)

    def test_text_is_for_people(self):
        self.cube(MIRROR)
        text = self.text("cube.obj")
        for part in ("cube.mtl", "1 closed, 0 open", "closed, wound outward", "mirror", "nothing\n",
                     "pass 1 light buffer   once        answers all shadow rays",
                     "pass 4 reflections    each frame  up to 4 generations"):
            self.assertIn(part, text)
        self.assertLessEqual(max(len(line) for line in text.splitlines()), 120)

    def test_warnings(self):
        self.cube(GLASS, CUBE + "f 1 2 2\n")
        report = self.json("cube.obj")
        self.assertEqual(len(report["warnings"]), 2, report["warnings"])
        (repeat, refract) = report["warnings"]
        self.assertEqual((repeat["code"], refract["code"]), ("triangle-degenerate", "glass-open"))
        self.assertIn("repeat a vertex", repeat["message"])
        self.assertIn("10 triangles in 1 open components refract (first: material 'paint')", refract["message"])
        self.assertIn(f"  - {repeat['message']} [triangle-degenerate]\n", self.text("cube.obj"))
        self.assertEqual(report["edges"]["boundary"], 4)
        self.assertIn("open: 4 boundary edges", self.text("cube.obj"))
        done = self.run_binary("render", "cube.obj", "--method", "raytrace", "--size", "8x8", "-q")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"open components refract", done.stderr)

    def test_closed_glass_is_not_warned_of(self):
        self.cube(GLASS)
        self.assertEqual(self.json("cube.obj")["warnings"], [])
        done = self.run_binary("render", "cube.obj", "--method", "raytrace", "--size", "8x8", "-q")
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_far_from_the_origin(self):
        self.cube(obj=(CUBE + LAST_FACE).replace("v 0", "v 10000000").replace("v 1 ", "v 10000001 "))
        report = self.json("cube.obj")
        self.assertEqual(report["bounds"]["lo"], [10000000, 0, 0])
        self.assertAlmostEqual(report["origin_world"][0], 10000000, delta=1)
        self.assertIn("moved to 1000000", self.text("cube.obj"))

    def test_what_a_frame_runs(self):
        self.cube(MIRROR)
        self.assertEqual(self.steps()["pass 3 marking"]["runs"], "each frame")
        self.assertEqual(self.steps("--reflection-depth", "0")["pass 4 reflections"]["why"], "--reflection-depth 0")
        rays = self.steps("--shadows", "rays")
        self.assertEqual(rays["pass 1 shadow map"]["runs"], "no")
        self.assertEqual(rays["pass 4 shadow rays"]["runs"], "each frame")
        raster = self.steps("--method", "raster")
        self.assertEqual(raster["ray accelerator"]["runs"], "no")
        self.assertEqual(raster["pass 4 shadow rays"]["why"], "the shadow map decides alone")
        away = self.steps("--eye", "9,0.5,0.5", "--target", "19,0.5,0.5")
        self.assertIn("in view", away["pass 4 reflections"]["why"])
        traced = self.steps("--method", "reference")
        self.assertIn("double", traced["ray accelerator"]["why"])
        self.assertEqual(traced["pass 4 shadow rays"]["runs"], "each frame")
        self.cube(MATTE)
        self.assertIn("no material", self.steps()["pass 4 reflections"]["why"])
        self.assertIn("frame 3, the first of 6", self.text("cube.obj", "--frames", "3-8"))

    def test_procedural_scene(self):
        report = self.json("scene:spheres,triangles=5000,reflective=50")
        self.assertEqual(report["files"], [])
        self.assertEqual(report["components"]["open"], 1)  # the ground
        self.assertEqual(report["normals"]["built_corners"], 0)

    def test_names_that_are_no_utf8(self):
        self.cube(MATTE.encode().replace(b"last", b"gr\xfcn\x1b[31m"),
                  (CUBE + LAST_FACE).encode().replace(b"last", b"gr\xfcn\x1b[31m"))
        self.assertEqual(self.json("cube.obj")["materials"][1]["triangles"], 2)
        self.assertNotIn("\x1b", self.text("cube.obj"))

    def test_exit_codes(self):
        self.cube()
        self.write("broken.obj", "v 0 0 0\nf 1 2 3\n")
        for code, arguments in ((2, []), (2, ["cube.obj", "--frames", "9-1"]), (2, ["cube.obj", "--colour"]),
                                (2, ["cube.obj", "--fov", "0"]), (2, ["scene:nothing"]), (3, ["missing.obj"]),
                                (3, ["broken.obj"])):
            done = self.run_binary("inspect", *arguments)
            self.assertEqual(done.returncode, code, (arguments, done.stderr))
            self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
            self.assertEqual(done.stdout, b"")


if __name__ == "__main__":
    unittest.main()
