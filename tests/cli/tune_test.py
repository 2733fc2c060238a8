"""hybridrt tune and --config: what is chosen does meet the goal, nothing cheaper that was tried does, and it can be used."""

import csv
import json
import unittest

from cli_test_case import SCENE, CliTestCase

SMALL = ("--size", "96x72")


class Tune(CliTestCase):
    def tune(self, max_error, *arguments, expect=0, scene=SCENE):
        done = self.run_binary("tune", scene, *SMALL, "--max-error", max_error, *arguments)
        self.assertEqual(done.returncode, expect, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def measured(self, config, samples, frames="1"):
        """The sweep's rows for the file's settings, the default's among them."""
        self.write("default.json", "{}")
        self.succeed("sweep", SCENE, *SMALL, "--over", f"config={config};default.json", "--frames", frames, "--rounds", "1",
                     "--truth-samples", str(samples), "--no-charts", "-q", "-o", "check" + config)
        with open(self.path("check" + config, "sweep.csv"), newline="", encoding="utf-8") as file:
            return [row for row in csv.DictReader(file) if row["config"] == config]

    def test_psnr_is_met_on_every_frame(self):
        for goal in (28, 36):
            config = f"t{goal}.json"
            self.tune(f"{goal}dB", "--truth-samples", "16", "--frames", "6", "-q", "-o", config)
            rows = self.measured(config, 16, "6")
            self.assertEqual(len(rows), 6)
            for row in rows:
                self.assertGreaterEqual(float(row["psnr_db"]), goal - 0.5, row["frame"])

    def test_a_stricter_goal_takes_more_samples(self):
        samples = [int(json.loads(self.tune(goal, "--truth-samples", "64", "-q").stdout)["samples"])
                   for goal in ("20dB", "32dB", "38dB")]
        self.assertEqual(samples, sorted(samples))
        self.assertLess(samples[0], samples[2])

    def test_wrong_pixels(self):
        self.tune("0wrong", "-q", "-o", "w.json")
        row, = self.measured("w.json", 1)
        self.assertEqual([row[column] for column in ("false_lit", "false_shadow", "other_triangle")], ["0", "0", "0"])
        self.assertNotEqual(row["shadows"], "none")

    def test_the_chosen_is_the_cheapest_that_does(self):
        done = self.tune("30dB", "--truth-samples", "16")
        table = [line for line in done.stderr.splitlines() if " dB " in line and "--method" in line and ":" not in line]
        times = [float(line.split()[0]) for line in table if not line.startswith("too coarse")]
        chosen, = (line for line in table if "chosen" in line)
        self.assertLessEqual(float(chosen.split()[0]), 1.06 * min(times) + 0.1)
        for line in table:
            decibel = float(line.replace("too coarse", "x").split()[1])
            self.assertEqual(decibel < 30, line.startswith("too coarse"), line)
        self.assertTrue(any("raytrace" in line for line in table))

    def test_what_cannot_be_reached(self):
        done = self.tune("90dB", "--truth-samples", "16", "-q", expect=2)
        self.assertIn("allow a larger error", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_messages(self):
        for arguments, words in ((("45",), "45dB"), (("-3dB",), "45dB"), (("many",), "45dB"),
                                 (("45dB", "--samples", "4"), "what tune chooses"),
                                 (("45dB", "--shadows", "map"), "what tune chooses")):
            self.assertIn(words, self.tune(*arguments, expect=2).stderr)
        self.assertEqual(self.files(), [])


class Config(CliTestCase):
    def settings(self, *arguments):
        self.succeed("render", SCENE, *SMALL, "-q", "-o", "a.png", *arguments)
        return json.loads(self.read("run.json"))["settings"]

    def test_is_the_same_as_the_command_line_which_wins(self):
        self.write("c.json", '{"method": "raster", "shadows": "none", "samples": 2, "ground": true}')
        self.assertEqual(self.settings("--config", "c.json")["samples"], 2)
        picture = self.read("a.png")
        self.settings("--method", "raster", "--shadows", "none", "--samples", "2", "--ground")
        self.assertEqual(self.read("a.png"), picture)
        self.assertEqual(self.settings("--config", "c.json", "--samples", "3")["samples"], 3)

    def test_wins_over_the_scene(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("s.json", '{"meshes": ["a.obj"], "settings": {"samples": 2, "fov": 20}}')
        self.write("c.json", '{"samples": 4}')
        self.succeed("render", "s.json", *SMALL, "-q", "-o", "a.png", "--config", "c.json")
        self.assertEqual(json.loads(self.read("run.json"))["settings"]["samples"], 4)

    def test_faults(self):
        for text, words in (('{"sample": 2}', "no render option 'sample'"), ('{"samples": 0}', "1 to 4096"), ("[1]", "object"),
                            ("{", "c.json"), ('{"config": "c.json"}', "cannot be given in a file"),
                            ('{"method": "raster", "shadows": "rays"}', "does not take")):
            self.write("c.json", text)
            done = self.run_binary("render", SCENE, *SMALL, "--config", "c.json")
            self.assertEqual(done.returncode, 3, text)
            self.assertIn(words, done.stderr)
            self.assertIn("c.json", done.stderr)
        self.assertEqual(self.run_binary("render", SCENE, "--config", "missing.json").returncode, 3)


if __name__ == "__main__":
    unittest.main()
