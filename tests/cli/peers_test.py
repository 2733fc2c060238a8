"""scripts/peers.py: a race of our own methods, what the converters write, and the rivals' pictures where they are installed.

Called with the binary and the project's folder.
"""

import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BINARY = os.path.abspath(sys.argv.pop(1))
ROOT = Path(os.path.abspath(sys.argv.pop(1)))
sys.path.insert(0, str(ROOT / "scripts"))

from peers import obj_mesh, povray, race, table  # noqa: E402
from peers.cameras import Turn, camera_path, views_of  # noqa: E402
from peers.scenes import LOOKS, RaceScene  # noqa: E402

TWO_MATERIALS = """mtllib scene.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vn 0 0 1
vn 1 0 0
usemtl wood
f 1//1 2//1 3//1
usemtl crystal
f 1//2 3//2 4//2
usemtl wood
f 2//1 4//1 3//1
"""
MTL = """newmtl wood
Kd 0.5 0.25 0.125
Ks 0.2 0.2 0.2
Ns 50
illum 3
newmtl crystal
Kd 0 0 0
Ks 0.45 0.45 0.45
Ns 0
Ni 1.5
Tf 0.9 0.8 0.7
illum 6
"""


class PeersTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def peers(self, *arguments):
        return subprocess.run([sys.executable, ROOT / "scripts/peers.py", "--hybridrt", BINARY, "--work", self.folder, "--size", "96x72",
                               "--triangles", "10000", "--rounds", "1", *arguments], capture_output=True, text=True, timeout=200)

    def psnr_db(self, rival, scene="spheres"):
        """Of the rival's first picture against hybrid's."""
        done = self.peers("--only", f"hybrid,{rival}", "--scenes", scene, "--frames", "1,2")
        self.assertEqual(done.returncode, 0, done.stderr)
        pictures = [next((self.folder / scene / f"{key}.out").glob("*1.png")) for key in (rival, "hybrid")]
        compared = subprocess.run([BINARY, "compare", *pictures, "--json"], capture_output=True, text=True)
        return json.loads(compared.stdout)["psnr_db"]

    def write_scene(self):
        (self.folder / "scene.obj").write_text(TWO_MATERIALS)
        (self.folder / "scene.mtl").write_text(MTL)
        return obj_mesh.read_obj(self.folder / "scene.obj")

    def test_our_own_methods(self):
        done = self.peers("--only", "hybrid,raytrace", "--scenes", "spheres,chess", "--frames", "1,2")
        self.assertEqual(done.returncode, 0, done.stderr)
        facts = json.loads((self.folder / "peers.json").read_text())
        jobs = {(job["scene"], job["rival"], job["frames"]) for job in facts["jobs"]}
        self.assertEqual(jobs, {(s, r, n) for s in ("spheres", "chess") for r in ("hybrid", "raytrace") for n in (1, 2)})
        self.assertTrue(all(len(job["seconds"]) == 1 and not job["estimated"] for job in facts["jobs"]))
        page = (self.folder / "peers.md").read_text()
        for expected in ("## spheres", "## chess", "| `hybrid` |", "| `raytrace` |", "2 frames", "--frames 1,2"):
            self.assertIn(expected, page)

    def test_text_of_people_is_kept(self):
        page = self.folder / "page.md"
        page.write_text("# Ours\n\n<!-- tables -->\nold\n")
        done = self.peers("--only", "hybrid", "--scenes", "spheres", "--frames", "1", "-o", str(page))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(page.read_text().startswith("# Ours\n\n<!-- tables -->\n"))
        self.assertNotIn("old", page.read_text())

    def test_what_cannot_run_is_told(self):
        for arguments, said in ((("--only", "hybrid,maya"), "no rival is called maya"), (("--scenes", "moon"), "no scene is called moon"),
                                (("--only", "hybrid", "--frames", "1,101"), "write numbers from 1 to 100")):
            done = self.peers(*arguments)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(said, done.stderr.splitlines()[-1])

    def test_meshes_for_povray(self):
        scene = RaceScene("chess", self.folder, LOOKS["chess"], views_of(camera_path(LOOKS["chess"].turn)), 3, (40, 30))
        text = io.StringIO()
        povray.write_meshes(self.write_scene(), scene, text)
        wood, crystal = text.getvalue().split("mesh2 {")[1:]
        self.assertIn("vertex_vectors { 4,", wood)  # shared by its two triangles
        self.assertIn("face_indices { 2,\n<0,1,2>,\n<1,3,2>", wood)
        self.assertIn("rgb <0.5,0.25,0.125>", wood)
        self.assertIn("specular 0.2 roughness 0.02 reflection { rgb <0.2,0.2,0.2> }", wood)
        self.assertNotIn("interior", wood)
        self.assertIn("face_indices { 1,", crystal)
        self.assertIn("rgb <0.9,0.8,0.7> filter 1", crystal)
        self.assertIn("fresnel on", crystal)
        self.assertIn("interior { ior 1.5 }", crystal)
        self.assertNotIn("specular", crystal)
        self.assertIn(f"max_trace_level {LOOKS['chess'].depth + 1}", povray.scene_text(scene))

    def test_foreign_obj_is_refused(self):
        path = self.folder / "scene.obj"
        for face in ("f 1 2 3", "f 1//1 2//1 3//1 4//1"):
            path.write_text(TWO_MATERIALS.replace("f 1//1 2//1 3//1", face))
            (self.folder / "scene.mtl").write_text(MTL)
            with self.assertRaisesRegex(Exception, "scene.obj:9"):
                obj_mesh.read_obj(path)

    def test_a_turn_goes_round_once(self):
        views = views_of(camera_path(Turn((1, 2, 3), 5, 0, 0, 45)))
        self.assertEqual([round(x, 9) for x in views[0].eye + views[0].forward + views[0].right + views[0].up],
                         [1, 2, 8, 0, 0, -1, 1, 0, 0, 0, 1, 0])
        self.assertEqual([round(x, 9) for x in views[25].eye + views[25].forward], [6, 2, 3, -1, 0, 0])

    def test_what_a_frame_more_takes(self):
        jobs = [race.Job("s", "r", 1, [10]), race.Job("s", "r", 12, [32, 99, 31]), race.Job("s", "r", 100, [999], estimated=True)]
        self.assertAlmostEqual(race.steady_ms(jobs), 2000)  # (32 - 10) s / 11, the estimate left out
        self.assertAlmostEqual(race.straight_on(*jobs[:2], 100), 32 + 88 * 2)
        log = "  Parse Time:  0 hours 0 minutes 1 seconds (1.402 seconds)\n  Trace Time:  0 hours 0 minutes 0 seconds (0.764 seconds)\n"
        jobs[1].frame_seconds = povray.frame_seconds(log)
        self.assertAlmostEqual(race.steady_ms(jobs), 764)
        self.assertEqual(table.whole_cell(jobs[2], race.Job("s", "hybrid", 100, [9])), "≈ 999.00 **[111.0 ×]**")

    @unittest.skipUnless(shutil.which("povray"), "POV-Ray is not installed")
    def test_povray_draws_the_same(self):
        self.assertGreater(self.psnr_db("povray"), 42)

    @unittest.skipUnless(shutil.which("blender"), "Blender is not installed")
    def test_cycles_draws_the_same_but_for_noise(self):
        self.assertGreater(self.psnr_db("cycles"), 32)


if __name__ == "__main__":
    unittest.main()
