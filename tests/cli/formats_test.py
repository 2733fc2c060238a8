"""docs/formats.md: its examples run, and it names every column and field that a run writes.

Called with the binary and the project's folder."""

import json
import os
import re
import sys
import unittest

ROOT = os.path.abspath(sys.argv.pop(2))

from cli_test_case import SCENE, SMALL, CliTestCase  # noqa: E402, it takes the binary off the arguments

PYRAMID = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.5 0\nf 1 2 3 4\nf 5 2 1\nf 5 3 2\nf 5 4 3\nf 5 1 4\n"


class FormatsTest(CliTestCase):
    def setUp(self):
        super().setUp()
        with open(os.path.join(ROOT, "docs", "formats.md"), encoding="utf-8") as file:
            self.text = file.read()
        self.write("pyramid.obj", PYRAMID)
        for name, example in re.findall(r"<!-- example: (\S+) -->\n```json\n(.*?)```", self.text, re.DOTALL):
            self.write(name, example)

    def test_examples_run(self):
        commands = re.findall(r"`hybridrt (.*?)`", self.text)
        run = [words.split() for words in commands if ".json" in words]
        self.assertEqual(len(run), 5)
        for words in run:
            quiet = ("-q", "--size", "64x48") if words[0] == "render" else ()
            self.assertEqual(self.succeed(*words, *quiet).stderr, "", words)

    def test_every_key_of_a_scene_is_there(self):
        keys = json.loads(self.read("scene.json"))
        self.write("unknown.json", json.dumps({**keys, "colour": 1}))
        self.fail_with(3, "inspect", "unknown.json", says="colour")
        section = self.text.split("## Scene JSON")[1].split("## ")[0]
        for key in (*keys, "camera_path"):
            self.assertIn(f"`{key}`", section)
        with open(os.path.join(ROOT, "core/load/scene_file.cpp"), encoding="utf-8") as file:
            known = re.search(r"scene\.only\(\s*\{(.*?)\}", file.read(), re.DOTALL).group(1)
        self.assertEqual({*keys, "camera_path"}, set(re.findall(r'"(\w+)"', known)))

    def test_every_column_and_field_is_there(self):
        self.render("-o", "x.####.png", "--frames", "2")
        section = self.text.split("## timings.csv")[1].split("## ")[0]
        for column in self.read("timings.csv").decode().splitlines()[0].split(","):
            self.assertIn(f"`{column}`", section)
        section = self.text.split("## run.json")[1].split("## ")[0]
        run = json.loads(self.read("run.json"))
        for field in (*run, *run["scene"], *run["camera"], *run["outputs"]):
            self.assertIn(f"`{field}`", section)

    def test_every_channel_is_there(self):
        aovs = "id,shadow,marked,traced,depth,normal"
        self.succeed("render", SCENE, *SMALL, "-q", "-o", "x.exr", "--aov", aovs)
        exr = self.read("x.exr")
        for channel in ("id", "shadow", "marked", "traced.R", "Z", "N.X", "N.Y", "N.Z", "worldToCamera", "worldToNDC"):
            self.assertIn(channel.encode() + b"\0", exr)
            self.assertIn(f"`{channel}`", self.text)


if __name__ == "__main__":
    unittest.main()
