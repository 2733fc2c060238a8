"""hybridrt doctor, scene and --version through the real binary."""

import json
import re
import shutil
import subprocess
import unittest

from cli_test_case import SMALL, CliTestCase


COMMANDS = ((), ("render",), ("compare",), ("golden",), ("golden", "check"), ("golden", "update"), ("golden", "init"), ("golden", "add"), ("scene",), ("inspect",),
            ("doctor",))


class HelpTest(CliTestCase):
    def test_fits_a_terminal_and_ends_with_examples(self):
        for command in COMMANDS:
            lines = self.succeed(*command, "--help").stdout.rstrip().splitlines()
            for line in lines:
                self.assertLessEqual(len(line), 100, line)
            if command[:1] != ("golden",) or len(command) == 1:
                examples = lines[next(i for i, line in enumerate(lines) if line.endswith("Examples:")) + 1:]
                self.assertIn(len(examples), (2, 3), command)
                for example in examples:
                    self.assertTrue(example.startswith("  hybridrt " + " ".join(command)), example)


class ShellFilesTest(CliTestCase):
    def options_of(self, *command):
        return set(re.findall(r"--[a-z][a-z-]+", self.succeed(*command, "--help").stdout))

    def test_man_page_has_every_option(self):
        page = self.succeed("help", "--man").stdout
        for command in (("render",), ("compare",), ("golden", "check"), ("inspect",)):
            for option in self.options_of(*command):
                self.assertIn(option.replace("-", "\\-"), page)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-ww", "-z"], input=page, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def completed(self, *words):
        script = self.succeed("help", "--bash-completion").stdout
        line = " ".join(f"'{word}'" for word in words)
        ask = f"COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _hybridrt; printf '%s\\n' \"${{COMPREPLY[@]}}\""
        done = subprocess.run(["bash", "-c", script + ask], capture_output=True, text=True, cwd=self.path("."))
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes(self):
        self.write("model.obj", "")
        self.assertEqual(self.completed("hybridrt", "ren"), ["render"])
        self.assertIn("--shadows", self.completed("hybridrt", "render", "model.obj", "--sha"))
        self.assertEqual(self.completed("hybridrt", "golden", "che"), ["check"])
        self.assertIn("--list", self.completed("hybridrt", "golden", "check", "--l"))
        self.assertEqual(self.completed("hybridrt", "render", "mod"), ["model.obj"])
        self.assertTrue(self.options_of("render") - {"--help"} <= set(self.completed("hybridrt", "render", "--")))


class DoctorTest(CliTestCase):
    def test_lists_what_render_can_open(self):
        report = json.loads(self.succeed("doctor", "--json").stdout)
        self.assertGreaterEqual(report["threads"], 1)
        self.assertTrue(report["version"])
        self.assertTrue(report["devices"], "this machine has no GL at all")
        for device in report["devices"]:
            self.assertGreaterEqual(device["max_texture_px"], 16384)
            self.render("--device", device["id"], "-o", device["id"] + "/x.png")
            self.assertEqual(json.loads(self.read(device["id"] + "/run.json"))["gl"]["device"], device["id"])
        for device in report["unusable"]:
            self.fail_with(4, "render", "scene:spheres,triangles=500", *SMALL, "--device", device["id"])

    def test_bindings_give_the_same_picture(self):
        devices = json.loads(self.succeed("doctor", "--json").stdout)["devices"]
        software = [device["id"] for device in devices if not device["hardware"]]
        pictures = set()
        for device in software:
            self.render("--device", device, "-o", "x.png")
            pictures.add(self.read("x.png"))
        self.assertLessEqual(len(pictures), 1, software)

    def test_text(self):
        text = self.succeed("doctor").stdout
        report = json.loads(self.succeed("doctor", "--json").stdout)
        for device in report["devices"]:
            self.assertIn(device["id"], text)
            self.assertIn(device["renderer"], text)

    def test_without_any_egl_it_still_answers(self):
        done = self.succeed("doctor", "--json", env={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"})
        report = json.loads(done.stdout)
        self.assertEqual([d["id"] for d in report["devices"] if d["id"].startswith("egl")], [])
        self.assertTrue(report["unusable"])


class SceneTest(CliTestCase):
    def test_same_arguments_same_bytes(self):
        for folder in ("a", "b"):
            self.succeed("scene", "spheres", "-o", folder + "/s.obj", "--triangles", "3000", "--reflective", "20")
        self.assertEqual(self.files("a"), ["s.json", "s.mtl", "s.obj"])
        for name in ("s.obj", "s.mtl"):
            self.assertEqual(self.read("a/" + name), self.read("b/" + name))
        self.succeed("scene", "spheres", "-o", "c/s.obj", "--triangles", "3000", "--reflective", "60")
        self.assertNotEqual(self.read("a/s.obj"), self.read("c/s.obj"))

    def test_file_and_name_give_the_same_picture(self):
        self.succeed("scene", "spheres", "-o", "s.obj", "--triangles", "500")
        self.succeed("render", "s.obj", *SMALL, "-q", "-o", "file.png")
        self.succeed("render", "scene:spheres,triangles=500", *SMALL, "-q", "-o", "name.png")
        self.succeed("compare", "file.png", "name.png", "--fail", "0", "--fail-percent", "0")

    def test_bad_arguments(self):
        self.fail_with(2, "scene", "spheres", "-o", "x.obj", "--triangles", "1", says="triangles")
        self.fail_with(2, "scene", "spheres", "-o", "x.obj", "--reflective", "101", says="reflective")
        self.fail_with(2, "scene", "spheres", "-o", "x.stl", says="x.stl")
        self.write("file", "")
        self.fail_with(5, "scene", "spheres", "-o", "file/x.obj", "--triangles", "500", says="file")
        self.assertEqual(self.files(), ["file"])


class VersionTest(CliTestCase):
    def test_text_and_json(self):
        report = json.loads(self.succeed("--version", "--json").stdout)
        for key in ("version", "commit", "compiler", "libraries"):
            self.assertTrue(report[key], key)
        text = self.succeed("--version").stdout
        self.assertIn(report["version"], text)
        self.assertIn(report["commit"], text)
        for library in report["libraries"]:
            self.assertIn(library.lower(), text.lower())


if __name__ == "__main__":
    unittest.main()
