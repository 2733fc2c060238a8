"""Standard streams that are full, closed or gone: output on standard error never changes the exit code, and
results that standard output does not take are exit code 5."""

import fcntl
import json
import os
import pty
import signal
import socket
import subprocess
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
        self.on_a_lost_terminal("inspect", "scene:spheres,triangles=4M", lose=lambda terminal: os.read(terminal, 10))

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
                ("tune", SCENE, "--size", "32x24", "--max-error", "20dB", "-q"),
                ("sweep", SCENE, "--size", "32x24", "--over", "shadow-map=64,128", "--rounds", "1", "--truth-samples", "1",
                 "--no-charts", "-o", "sweep"),
                ("scene", "spheres", "--triangles", "500"), ("golden", "update", *golden), ("golden", "check", *golden),
                ("render", SCENE, *SMALL), ("render", SCENE, *SMALL, "--json"),
                ("render", SCENE, *SMALL, "-q", "--timings", "-"))

    def test_full_or_closed(self):
        for arguments in self.commands():
            for redirection in (">/dev/full", ">&-", ">&- <&-"):
                with self.subTest(arguments=arguments, redirection=redirection):
                    done = self.through_shell(redirection, *arguments)
                    self.assertEqual(done.returncode, 5, done.stderr)
                    lines = [line for line in done.stderr.splitlines() if "standard output" in line]
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

    def expect_timings(self, text, before=()):
        self.assertEqual([line.split(",")[0] for line in text.splitlines()], [*before, "frame", "1"])

    def test_timings_are_appended_to_a_file(self):
        os.symlink("/dev/stdout", self.path("link"))
        for name, redirection in (("-", ">>log"), ("/dev/stdout", ">>log"), ("/dev/fd/1", ">>log"), ("link", ">>log"),
                                  ("/proc/self/fd/1", ">>log"), ("/dev/fd/3", "3>>log"), ("/dev/fd/3", "3>>log >&-")):
            with self.subTest(name=name, redirection=redirection):
                self.write("log", "before\n")
                done = self.through_shell(redirection, "render", SCENE, *SMALL, "-q", "--timings", name, "-o", "p/a.png")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.expect_timings(self.read("log").decode(), ["before"])
                self.assertEqual(self.files("p"), ["a.png", "run.json"])

    def test_timings_into_a_socket(self):
        for name in ("-", "/dev/stdout"):
            ours, its = socket.socketpair()
            process = self.start("render", SCENE, *SMALL, "-q", "--timings", name, stdout=its)
            its.close()
            with ours.makefile() as stream:
                self.expect_timings(stream.read())
            self.assertEqual(process.wait(timeout=60), 0)
            process.stderr.close()
            ours.close()

    def test_timings_into_a_pipe_that_does_not_wait(self):
        read_end, write_end = os.pipe()
        fcntl.fcntl(write_end, fcntl.F_SETPIPE_SZ, 4096)
        os.set_blocking(write_end, False)
        process = self.start("render", SCENE, *SMALL, "-q", "--frames", "100", "--timings", "-", stdout=write_end)
        os.close(write_end)
        with open(read_end, encoding="ascii") as stream:
            time.sleep(0.5)
            self.assertEqual(len(stream.readlines()), 101)
        _, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, errors), (0, ""))

    def test_descriptors_that_nobody_gave(self):
        """Some of these numbers are files that the run opens itself, its lock among them."""
        for number in range(3, 12):
            done = self.through_shell("", "render", SCENE, *SMALL, "-q", "--timings", f"/dev/fd/{number}", "-o", "p/a.png")
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertRegex(done.stderr, r"^hybridrt: cannot write /dev/fd/\d+: .*\n$")
            self.assertEqual(self.files("p"), [])

    def test_without_results_it_does_not_matter(self):
        self.assertEqual(self.through_shell(">&-", "render", SCENE, *SMALL, "-q").returncode, 0)
        self.assertEqual(self.through_shell(">/dev/full", "render", "missing.obj").returncode, 3)


if __name__ == "__main__":
    unittest.main()
