"""hybridrt simplify: what it reports is what its files show, and no input is replaced.

Called with the folder of the shared scenes as the second argument; without the scan there its test is skipped."""

import json
import math
import os
import signal
import sys
import unittest

from cli_test_case import CliTestCase, Png

SCAN = os.path.join(os.path.abspath(sys.argv.pop(1)), "armadillo", "armadillo.obj")
SMALL = ("--size", "160x120", "--threads", "2")
STILL = ("--eye", "0.5,1.2,2.6", "--target", "0.5,0,0.5", "--fov", "45", "--light", "1,2,1")


def terrain(steps, up="y", textured=False, far=(0, 0, 0)):
    """Hills over [0, 1] x [0, 1], as an OBJ."""
    lines = ["mtllib t.mtl"] if textured else []
    for j in range(steps + 1):
        for i in range(steps + 1):
            x, z = i / steps, j / steps
            y = 0.08 * math.sin(9 * x) * math.cos(7 * z)
            x, y, z = x + far[0], y + far[1], z + far[2]
            lines.append(f"v {x} {y} {z}" if up == "y" else f"v {x} {-z} {y}")
            if textured:
                lines.append(f"vt {i / steps} {j / steps}")
    if textured:
        lines.append("usemtl ground")
    for j in range(steps):
        for i in range(steps):
            a = j * (steps + 1) + i + 1
            for triangle in ((a, a + steps + 1, a + 1), (a + 1, a + steps + 1, a + steps + 2)):
                lines.append("f " + " ".join(f"{v}/{v}" if textured else str(v) for v in triangle))
    return "\n".join(lines) + "\n"


class Simplify(CliTestCase):
    def simplify(self, *arguments, scene="t.obj", max_error="1px", output="lean.obj", size=SMALL):
        done = self.succeed("simplify", scene, *size, "--max-error", max_error, "-o", output, "--json", *arguments)
        return json.loads(done.stdout)

    def psnr(self, a, b):
        done = self.run_binary("compare", a, b, "--json")
        return json.loads(done.stdout)["psnr_db"]

    def render(self, scene, output, *arguments):
        self.succeed("render", scene, *SMALL, "-q", "-o", output, *arguments)

    def check(self, report, *arguments, scene="t.obj", output="lean.obj"):
        """The report against the other commands."""
        inspected = json.loads(self.succeed("inspect", output, "--json").stdout)
        self.assertEqual(report["triangles_after"], inspected["triangles"])
        self.assertLess(report["triangles_after"], report["triangles_before"])
        self.assertLessEqual(report["hausdorff_px"], report["max_error_px"])
        self.assertGreater(report["samples"], 100000)
        mtl = output.replace(".obj", ".mtl")
        self.assertEqual(report["bytes_after"],
                         sum(os.path.getsize(self.path(name)) for name in (output, mtl)))
        for frame in report["frames"]:
            self.assertLessEqual(frame["outline_px"], math.ceil(report["max_error_px"]))
        for name, picture in ((scene, "before.png"), (output, "after.png")):
            self.render(name, picture, *arguments)
        self.assertAlmostEqual(self.psnr("after.png", "before.png"), report["frames"][0]["psnr_db"], delta=0.1)

    def test_the_report_is_true(self):
        self.write("t.obj", terrain(60))
        triangles = []
        for max_error in ("0.25px", "1px", "4px"):
            report = self.simplify(*STILL, max_error=max_error)
            self.check(report, *STILL)
            self.assertEqual(report["bytes_before"], os.path.getsize(self.path("t.obj")))
            triangles.append(report["triangles_after"])
        self.assertEqual(triangles, sorted(triangles, reverse=True))
        self.assertLess(triangles[2] * 2, triangles[0])

    @unittest.skipUnless(os.path.isfile(SCAN), "needs the shared scenes")
    def test_a_scan_of_346_thousand_triangles(self):
        report = self.simplify(scene=SCAN, size=("--size", "1024x768"))
        self.assertEqual(report["triangles_before"], 345944)
        self.assertLess(report["triangles_after"] * 4, report["triangles_before"])
        self.assertLessEqual(report["hausdorff_px"], 1)
        self.assertLessEqual(report["hausdorff_from_original"], report["largest_bound"])
        self.assertLessEqual(report["hausdorff_from_simplified"], report["largest_bound"])
        self.assertLessEqual(report["frames"][0]["outline_px"], 1)
        inspected = json.loads(self.succeed("inspect", "lean.obj", "--json").stdout)
        self.assertEqual((inspected["components"]["count"], inspected["components"]["closed"]), (1, 1))

    def test_the_nearest_frame_counts(self):
        self.write("t.obj", terrain(60))
        self.write("path.json", json.dumps({"keyframes": [
            {"frame": 1, "eye": [0.5, 20, 20], "target": [0.5, 0, 0.5]},
            {"frame": 5, "eye": [0.5, 0.3, 1.2], "target": [0.5, 0, 0.5]}]}))
        far = self.simplify("--camera", "path.json", "--frames", "1-1")
        near = self.simplify("--camera", "path.json", "--frames", "5-5")
        both = self.simplify("--camera", "path.json", "--frames", "5")
        self.assertLess(far["triangles_after"] * 2, near["triangles_after"])
        self.assertGreaterEqual(both["triangles_after"], near["triangles_after"])
        self.assertEqual([frame["frame"] for frame in both["frames"]], [1, 2, 3, 4, 5])
        smaller = self.simplify("--camera", "path.json", "--frames", "5-5", size=("--size", "16x12"))
        self.assertLess(smaller["triangles_after"] * 2, near["triangles_after"])

    def test_textures_in_another_folder(self):
        rows = [bytes(value for x in range(8) for value in ((x + y) % 2 * 200 + 20, x * 30, y * 30)) for y in range(8)]
        Png(8, 8, rows).write(self.path("check er.png"))
        self.write("t.mtl", "newmtl ground\nKd 1 1 1\nKs 0.2 0.2 0.2\nmap_Kd -s 3 3 1 check er.png\n")
        self.write("t.obj", terrain(40, textured=True))
        report = self.simplify(*STILL, output="else/where/lean.obj", max_error="0.5px")
        self.check(report, *STILL, output="else/where/lean.obj")
        self.assertIn("map_Kd -s 3 3 1 ../../check er.png", self.read("else/where/lean.mtl").decode())
        self.assertGreater(report["frames"][0]["psnr_db"], 30)

    def test_the_axes_of_the_files(self):
        self.write("t.obj", terrain(40, up="z"))
        view = ("--up-axis", "z", "--eye", "0.5,-2.6,1.2", "--target", "0.5,-0.5,0", "--light", "1,-1,2")
        self.check(self.simplify(*view), *view)

    def test_far_from_the_origin(self):
        self.write("t.obj", terrain(40, far=(85000, 0, 447500)))
        view = ("--eye", "85000.5,1.2,447502.6", "--target", "85000.5,0,447500.5", "--light", "1,2,1")
        self.check(self.simplify(*view), *view)

    def test_what_is_unseen(self):
        spheres = "scene:spheres,triangles=20000"
        view = ("--eye", "0,1,6", "--target", "0,1,0", "--fov", "25")
        all_of_it = self.simplify(*view, scene=spheres)
        seen = self.simplify(*view, "--drop-unseen", scene=spheres)
        self.assertEqual(all_of_it["triangles_unseen"], 0)
        self.assertEqual(all_of_it["triangles_after"], seen["triangles_after"] + seen["triangles_unseen"])
        self.assertGreater(seen["triangles_unseen"], seen["triangles_after"] / 2)
        self.assertIsNone(seen["bytes_before"])
        self.assertAlmostEqual(seen["frames"][0]["psnr_db"], all_of_it["frames"][0]["psnr_db"], delta=0.5)
        self.fail_with(3, "simplify", spheres, "--max-error", "1px", "--drop-unseen", "-q", "-o", "none.obj", "--eye", "0,0,90",
                       "--target", "0,0,200", says=("no frame sees", "--drop-unseen"))
        self.assertNotIn("none.obj", self.files())

    def test_as_text(self):
        self.write("t.obj", terrain(20))
        text = self.succeed("simplify", "t.obj", *SMALL, *STILL, "--max-error", "1px", "-o", "lean.obj").stdout
        for part in ("triangles of 800", "Hausdorff", "px of the 1 px allowed", "PSNR at least", "outlines"):
            self.assertIn(part, text)

    def test_what_is_refused(self):
        self.write("t.obj", terrain(4))
        for max_error in ("1", "0px", "-1px", "px", "1dB", "nanpx", "1e9px"):
            self.fail_with(2, "simplify", "t.obj", f"--max-error={max_error}", "-o", "lean.obj", says="0.5px")
        self.fail_with(2, "simplify", "t.obj", "--max-error", "1px", says="--output")
        self.fail_with(2, "simplify", "t.obj", "--max-error", "1px", "-o", "lean.ply", says=".obj")
        for option in (("--ground",), ("--reflection-percent", "5")):
            self.fail_with(2, "simplify", "t.obj", *option, "--max-error", "1px", "-o", "lean.obj", says=option[0])
        self.fail_with(3, "simplify", "nowhere.obj", "--max-error", "1px", "-o", "lean.obj", says="nowhere.obj")
        self.fail_with(5, "simplify", "t.obj", "--max-error", "1px", "-o", "t.obj/lean.obj", says="t.obj")
        self.assertEqual(self.files(), ["t.obj"])

    def test_no_input_is_replaced(self):
        before = terrain(4, textured=True)
        self.write("t.obj", before)
        self.write("t.mtl", "newmtl ground\nKd 1 1 1\n")
        os.symlink("t.obj", self.path("soft.obj"))
        os.link(self.path("t.mtl"), self.path("hard.mtl"))
        self.write("scene.json", json.dumps({"meshes": ["t.obj"]}))
        for scene in ("t.obj", "scene.json"):
            for output in ("t.obj", "./t.obj", "soft.obj", "hard.obj"):
                self.fail_with(2, "simplify", scene, "--max-error", "1px", "-o", output, says="would replace")
        self.assertEqual(self.read("t.obj").decode(), before)

    def test_a_scene_json(self):
        self.write("t.obj", terrain(40))
        self.write("scene.json", json.dumps({"meshes": ["t.obj"], "settings": {"size": "64x48"}, "camera": {
            "eye": [0.5, 1.2, 2.6], "target": [0.5, 0, 0.5]}}))
        done = self.succeed("simplify", "scene.json", "--max-error", "1px", "-o", "lean.obj", "--json")
        self.assertRegex(done.stderr, r"holds no lights, cameras and settings; .* \[scene-parts-lost\]\n")
        self.write("lean.json", self.read("scene.json").decode().replace("t.obj", "lean.obj"))
        for name in ("scene", "lean"):
            self.succeed("render", name + ".json", "-q", "-o", name + ".png")
        self.assertAlmostEqual(self.psnr("lean.png", "scene.png"), json.loads(done.stdout)["frames"][0]["psnr_db"],
                               delta=0.1)

    def test_stopped(self):
        running = self.start("simplify", "scene:spheres,triangles=300000", "--max-error", "0.1px", "-o", "lean.obj")
        for line in running.stderr:
            if "simplifying" in line:
                break
        running.send_signal(signal.SIGINT)
        running.communicate(timeout=100)
        self.assertEqual(running.returncode, 130)
        self.assertEqual(self.files(), [])

    def test_little_memory(self):
        self.write("t.obj", terrain(200))
        self.fail_with(3, "simplify", "t.obj", "--max-error", "1px", "-o", "lean.obj", "--max-memory", "64M",
                       says="memory")
        self.assertEqual(self.files(), ["t.obj"])


if __name__ == "__main__":
    unittest.main()
