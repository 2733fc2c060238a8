"""Shared by the tests of scene files: scenes are given to both commands that read them, `inspect` and `render`."""

import json

from cli_test_case import CliTestCase, Png

# The CPU alone: every kind of ray, no GL to open.
TINY = ("--size", "32x24", "--method", "raytrace", "--threads", "1", "-q")


class SceneCase(CliTestCase):
    def write_bytes(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode())
        return name

    def refuse(self, scene, *says, options=(), code=3):
        """Expects `code` and one line that holds each of `says` and something to do about it. The commands take
        turns: starting one takes longer than most of these files."""
        self.turn = not getattr(self, "turn", False)
        command = ("inspect", scene) if self.turn else ("render", scene, *TINY, "-o", "refused.png")
        line = self.fail_with(code, *command, *options, says=says).stderr
        self.assertRegex(line, r"; \w+ \w|\?|must |allowed|give ", "it does not say what to do")
        self.assertNotIn("refused.png", self.files())

    def report(self, scene, *options):
        done = self.succeed("inspect", scene, "--json", *options)
        self.assertEqual(done.stderr, "")
        return json.loads(done.stdout)

    def picture(self, scene, *options):
        """The pixels and the warnings."""
        done = self.succeed("render", scene, *TINY, "-o", "picture.png", *options)
        lines, start = done.stderr.splitlines(), "hybridrt: warning: "
        self.assertTrue(all(line.startswith(start) for line in lines), lines)
        return Png.read(self.path("picture.png")).rows, [line[len(start):] for line in lines]

    def warn(self, scene, *says, options=()):
        """Expects these warnings and no others from both commands, one line each; returns the picture."""
        told = [f"{warning['message']} [{warning['code']}]" for warning in self.report(scene, *options)["warnings"]]
        rows, lines = self.picture(scene, *options)
        self.assertEqual([line for line in lines if not line.startswith("frame 1 ")], told)
        self.assertEqual(len(told), len(says), told)
        for warning, part in zip(told, says):
            self.assertIn(part, warning)
        return rows

    def fine(self, scene, *options):
        """Expects no warning; returns the picture, which must show something."""
        rows, lines = self.picture(scene, *options)
        self.assertEqual(lines, [])
        self.assertGreater(len({bytes(row) for row in rows}), 1, "nothing but background")
        return rows
