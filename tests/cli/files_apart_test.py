"""No run writes over what it reads, or twice to one file: such runs are refused before anything is written."""

import json
import os
import unittest

from cli_test_case import SCENE, SMALL, CliTestCase

OBJ = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"
CPU = (*SMALL, "-q", "--gl", "off")


class FilesApartTest(CliTestCase):
    def contents(self):
        return {name: self.read(name) for name in self.files() if os.path.exists(self.path(name))}

    def refuse(self, *arguments, says=("choose another name",)):
        before = self.contents()
        with self.subTest(arguments):
            self.fail_with(2, *arguments, says=says)
            self.assertEqual(self.contents(), before)

    def make_scene(self):
        """A scene with a file of every kind that a run reads."""
        self.render("-o", "t.0001.png")
        for name in ("run.json", "timings.csv"):
            os.remove(self.path(name))
        self.write("a.obj", OBJ)
        self.write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd t.0001.png\n")
        self.write("path.json", json.dumps({"keyframes": [{"frame": 1, "eye": [0, 0, 3], "target": [0, 0, 0]}]}))
        self.write("s.json", json.dumps({"meshes": ["a.obj"], "camera_path": "path.json"}))
        self.write("c.json", json.dumps({"samples": 1}))
        return ("a.obj", "m.mtl", "t.0001.png", "path.json", "s.json", "c.json")

    def test_render_spares_what_it_reads(self):
        render = ("render", "s.json", "--config", "c.json", *CPU)
        for name in self.make_scene():
            self.refuse(*render, "-o", "o/x.png", "--timings", name, says="reads that file")
            os.symlink(name, self.path("link"))
            os.link(self.path(name), self.path("hard"))
            for other in ("link", "hard", "./o/../" + name, self.path(name)):
                self.refuse(*render, "-o", "p.png", "--timings", other, says="reads that file")
            os.remove(self.path("link"))
            os.remove(self.path("hard"))
        self.refuse(*render, "-o", "t.0001.png")
        self.refuse(*render, "-o", "t.####.png", "--frames", "1-1000000000")
        self.refuse(*render, "-o", "t.00{frame}1.png", "--frames", "0-5")
        self.refuse(*render, "-o", "x.png", "--contact-sheet", "t.0001.png")
        os.symlink("t.0001.png", self.path("x.0700.png"))
        self.refuse(*render, "-o", "x.####.png", "--frames", "1-1000000000", says="x.0700.png")
        self.refuse(*render, "-o", "x.png", "--timings", "-", "--contact-sheet", "t.0001.png")
        self.succeed(*render, "-o", "t.####.png", "--frames", "2-3")
        self.succeed(*render, "-o", "x.####.png", "--frames", "1-9")
        self.succeed(*render, "-o", "n.png", "--timings", "/dev/null")

    def test_render_writes_each_file_once(self):
        render = ("render", SCENE, *CPU)
        self.refuse(*render, "-o", "x.png", "--timings", "x.png", says="the picture")
        self.refuse(*render, "-o", "x.####.png", "--frames", "9", "--contact-sheet", "x.0004.png")
        self.refuse(*render, "-o", "q/{frame}/x.png", "--frames", "9", "--contact-sheet", "q/4/x.png")
        self.refuse(*render, "-o", "x.####.png", "--aov", "depth", "--contact-sheet", "x.depth.0001.png", says="AOV")
        self.refuse(*render, "-o", "x.png", "--timings", "s.png", "--contact-sheet", "./s.png", says="--contact-sheet goes")
        self.refuse(*render, "-o", "x.png", "--timings", "run.json", says="run.json")
        self.assertEqual(self.files(), [])
        os.symlink("later.png", self.path("x.png"))
        self.refuse(*render, "-o", "x.png", "--timings", "later.png")
        self.succeed(*render, "-o", "x.png")
        self.assertTrue(os.path.islink(self.path("x.png")) and os.path.isfile(self.path("later.png")))

    def test_compare(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png")
        for name in ("a.png", "b.png"):
            self.refuse("compare", "a.png", "b.png", "--diff", name)

    def test_golden(self):
        self.write("a.obj", OBJ.replace("mtllib m.mtl\n", ""))
        cases = [{"name": name, "scene": "a.obj", "options": list(SMALL), "reason": "is"} for name in ("a", "a.diff")]
        self.write("one.json", json.dumps({"cases": cases[:1]}))
        self.write("two.json", json.dumps({"cases": cases}))
        self.succeed("golden", "update", "--list", "one.json")
        self.refuse("golden", "check", "--list", "one.json", "-o", ".")
        for name in ("one.json", "a.png", "a.obj", "o/report.html", "o/a.png"):
            self.refuse("golden", "check", "--list", "one.json", "-o", "o", "--junit", name)
        self.refuse("golden", "check", "--list", "two.json", "-o", "o", says="a.diff.png")
        self.succeed("golden", "check", "--list", "one.json", "-o", "o", "--junit", "o/junit.xml")
        os.rename(self.path("a.png"), self.path("t.png"))
        self.write("a.obj", OBJ)
        self.write("m.mtl", "newmtl m\nmap_Kd a.png\n")
        os.symlink("t.png", self.path("a.png"))
        self.refuse("golden", "update", "--list", "one.json")

    def test_tune_scene_and_sweep(self):
        names = self.make_scene()
        tune = ("tune", "s.json", "--config", "c.json", "--size", "16x16", "--max-error", "10dB", "-q")
        for name in names:
            self.refuse(*tune, "-o", name)
        os.symlink("c.obj", self.path("c.mtl"))
        self.refuse("scene", "spheres", "--triangles", "500", "-o", "c.obj", says="c.mtl")
        sweep = ("--size", "16x16", "--over", "shadow-map=64,128", "-q", "--no-charts", "--gl", "off")
        os.makedirs(self.path("d"))
        for name in ("a.obj", "m.mtl", "t.0001.png"):
            os.rename(self.path(name), self.path("d", name))
        for name, scene in (("sweep.json", "d/sweep.json"), ("t.json", "d/t.json")):
            self.write("d/" + name, json.dumps({"meshes": ["a.obj"]}))
            before = self.contents()
            done = self.run_binary("sweep", scene, *sweep, "-o", "d")
            self.assertEqual(done.returncode, 2, done.stderr)
            after = {name: data for name, data in self.contents().items() if name not in ("d/sweep.csv", "d/sweep.json")}
            self.assertTrue(after.items() <= before.items(), "no input is changed")
            os.remove(self.path("d", name))


if __name__ == "__main__":
    unittest.main()
