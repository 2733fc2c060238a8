"""Standard streams that are full, closed or gone: output on standard error never changes the exit code, and
results that standard output does not take are exit code 5."""

import json
import os
import pty
import signal
import subprocess
import threading
import time
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
UP_ALONG_THE_VIEW = ("--eye", "0,9,0", "--target", "0,0,0")  # a warning


class StreamsCase(CliTestCase):
    def through_shell(self, redirections, *arguments):
        """Runs the binary from a shell with these redirections, with the signal handling of a user's programs."""
        return subprocess.run(["/bin/sh", "-c", 'exec "$@" ' + redirections, "sh", BINARY, *arguments],
                              cwd=self.folder, capture_output=True, text=True, timeout=120)


@unittest.skipUnless(os.path.exists("/dev/full"), "there is no /dev/full")
class StandardErrorTest(StreamsCase):
    def test_the_exit_code_stays(self):
        self.write("t.obj", TRIANGLE)
        self.render("-o", "a.png")
        self.write("no.png", "no picture")
        for code, *arguments in ((3, "render", "missing.obj"), (3, "inspect", "missing.obj"), (2, "render"), (2, "--nonsense"),
                                 (2, "render", SCENE, "--size", "0x0"), (4, "render", SCENE, "--device", "egl:99"),
                                 (5, "render", SCENE, *SMALL, "-o", "a.png/b.png"), (3, "compare", "a.png", "no.png"),
                                 (0, "render", SCENE, *SMALL, *UP_ALONG_THE_VIEW), (0, "render", SCENE, *SMALL, "-v"),
                                 (0, "render", "t.obj", *SMALL, "--frames", "3"), (0, "--help")):
            for redirection in ("2>&-", "2>/dev/full", "2>&- <&-"):
                with self.subTest(arguments=arguments, redirection=redirection):
                    self.assertEqual(self.through_shell(redirection, *arguments).returncode, code)

    def test_no_talk_in_files(self):
        """If standard error's descriptor is closed, the next file that is opened would get its number."""
        done = self.through_shell("2>&-", "render", SCENE, *SMALL, *UP_ALONG_THE_VIEW, "-v", "--frames", "3", "-o",
                                  "x.####.png")
        self.assertEqual(done.returncode, 0)
        for name in self.files():
            self.assertNotIn(b"hybridrt: warning", self.read(name), name)
            self.assertNotIn(b"frame 1: ", self.read(name), name)

    def on_a_lost_terminal(self, *arguments, lose):
        """Runs the binary with standard error on a terminal that is gone once lose(terminal) returns."""
        ours, its = pty.openpty()
        process = self.start(*arguments, stdout=subprocess.DEVNULL, stderr=its)
        os.close(its)
        lose(ours)
        os.close(ours)
        self.assertEqual(process.wait(timeout=60), 0)

    def test_a_terminal_lost_while_loading(self):
        os.mkfifo(self.path("slow.obj"))
        self.write("scene.json", json.dumps({"meshes": ["slow.obj"]}))

        def write_late():
            with open(self.path("slow.obj"), "w", encoding="utf-8") as pipe:
                time.sleep(1.6)
                pipe.write(TRIANGLE)

        threading.Thread(target=write_late, daemon=True).start()
        self.on_a_lost_terminal("inspect", "scene.json", lose=lambda terminal: os.read(terminal, 10))

    def test_a_terminal_lost_while_rendering(self):
        self.on_a_lost_terminal("render", SCENE, *SMALL, "--frames", "40", lose=lambda terminal: os.read(terminal, 10))


@unittest.skipUnless(os.path.exists("/dev/full"), "there is no /dev/full")
class StandardOutputTest(StreamsCase):
    def commands(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png", "--light", "1,0,0")
        self.write("list.json", json.dumps({"cases": [{"name": "one", "scene": SCENE, "options": [*SMALL], "reason": "is"}]}))
        golden = ("--list", "list.json")
        return (("help",), ("--help",), ("render", "--help"), ("golden", "check", "--help"), ("--version",), ("--version", "--json"),
                ("doctor",), ("doctor", "--json"), ("inspect", SCENE), ("inspect", SCENE, "--json"),
                ("compare", "a.png", "a.png"), ("compare", "a.png", "b.png"), ("compare", "a.png", "b.png", "--json"),
                ("scene", "spheres", "--triangles", "500"), ("golden", "update", *golden), ("golden", "check", *golden),
                ("render", SCENE, *SMALL), ("render", SCENE, *SMALL, "--json"),
                ("render", SCENE, *SMALL, "-q", "--timings", "-"))

    def test_full_or_closed(self):
        for arguments in self.commands():
            for redirection in (">/dev/full", ">&-", ">&- <&-"):
                with self.subTest(arguments=arguments, redirection=redirection):
                    done = self.through_shell(redirection, *arguments)
                    self.assertEqual(done.returncode, 5, done.stderr)
                    lines = [line for line in done.stderr.splitlines() if line.startswith("hybridrt: ")]
                    self.assertEqual(len(lines), 1, done.stderr)
                    self.assertRegex(lines[0], "cannot write standard output|standard output cannot be written")

    def test_nobody_reads(self):
        for arguments in self.commands():
            with self.subTest(arguments=arguments):
                read_end, write_end = os.pipe()
                os.close(read_end)
                process = self.start(*arguments, stdout=write_end,
                                     preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_DFL))
                os.close(write_end)
                _, errors = process.communicate(timeout=120)
                self.assertEqual(process.returncode, 5, errors)
                self.assertNotIn("internal", errors)

    def test_timings_are_appended_to_a_file(self):
        self.write("log", "before\n")
        self.assertEqual(self.through_shell(">>log", "render", SCENE, *SMALL, "-q", "--timings", "-").returncode, 0)
        lines = self.read("log").decode().splitlines()
        self.assertEqual([line.split(",")[0] for line in lines], ["before", "frame", "1"])

    def test_without_results_it_does_not_matter(self):
        self.assertEqual(self.through_shell(">&-", "render", SCENE, *SMALL, "-q").returncode, 0)
        self.assertEqual(self.through_shell(">/dev/full", "render", "missing.obj").returncode, 3)


if __name__ == "__main__":
    unittest.main()
