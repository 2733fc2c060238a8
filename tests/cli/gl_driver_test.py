"""Drivers that crash, hang or draw wrong pictures: they cost a GL, never the run, and leave no process behind.

Called with the binary and a library that stands for such a driver (support/faulty_gl.cpp)."""

import glob
import json
import os
import signal
import subprocess
import sys
import time
import unittest

FAULTY = os.path.abspath(sys.argv.pop(2))

from cli_test_case import SCENE, SMALL, CliTestCase  # noqa: E402, it takes the binary off the arguments

CRASHES = {"crash at open": "Segmentation fault", "abort": "Aborted", "crash at close": "Segmentation fault"}
WRONG = {"draws nothing": "triangle id", "computes nothing": "computed number"}


def library(name):
    """The path of an installed library, or nothing."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True).stdout
    paths = [line.split(" => ")[1] for line in listed.splitlines() if line.split() and line.split()[0] == name]
    return paths[0] if paths else None


def probing(folder):
    """The probing children of a test that are alive, as /proc folders."""
    alive = []
    for process in glob.glob("/proc/[0-9]*"):
        try:
            with open(process + "/cmdline", "rb") as file, open(process + "/environ", "rb") as environment:
                if b"--probe-gl" in file.read().split(b"\0") and os.fsencode(folder) in environment.read():
                    alive.append(process)
        except OSError:
            continue
    return alive


class GlDriverTest(CliTestCase):
    def setUp(self):
        super().setUp()
        self.real = {"EGL": library("libEGL.so.1"), "OSMESA": library("libOSMesa.so.8")}
        if not all(self.real.values()):
            self.skipTest("needs libEGL and libOSMesa to stand for a driver")
        os.mkdir(self.path("driver"))
        for name in ("libEGL.so.1", "libOSMesa.so.8"):
            os.symlink(FAULTY, self.path("driver", name))

    def driver(self, fault):
        vendors = sorted(glob.glob("/usr/share/glvnd/egl_vendor.d/*mesa*.json"))
        return {"FAULTY_GL": fault, "FAULTY_GL_EGL": self.real["EGL"], "FAULTY_GL_OSMESA": self.real["OSMESA"],
                "FAULTY_GL_LOG": self.path("loaded"), "LD_LIBRARY_PATH": self.path("driver"),
                "__EGL_VENDOR_LIBRARY_FILENAMES": ":".join(vendors)}  # so that a GPU may be there

    def loaded(self):
        return self.read("loaded").decode().splitlines() if os.path.exists(self.path("loaded")) else []

    def facts(self):
        return json.loads(self.read("out/run.json"))

    def draw(self, fault, *arguments):
        return self.render("-o", "out/x.png", *arguments, env=self.driver(fault))

    def refuse(self, fault, *arguments, says):
        self.fail_with(4, "render", SCENE, *SMALL, "-q", *arguments, env=self.driver(fault), says=says)
        self.assertEqual(self.files("."), sorted([*(["loaded"] if self.loaded() else []), "driver/libEGL.so.1", "driver/libOSMesa.so.8"]))

    def test_a_driver_without_faults_draws(self):
        for arguments in ((), ("--gl", "egl"), ("--gl", "osmesa")):
            self.assertEqual(self.draw("", *arguments).stderr, "")
            self.assertEqual((self.facts()["passes"]["form"], self.facts()["gl"]["renderer"]), ("gl", "Imaginary GPU"))

    def test_a_gl_asked_for_by_name_is_refused(self):
        for fault, says in CRASHES.items():
            self.refuse(fault, "--gl", "egl", says=("egl:0: its driver crashed (" + says, "surfaceless: its driver crashed"))
            self.refuse(fault, "--gl", "osmesa", says="osmesa: its driver crashed (" + says)
        for fault, says in WRONG.items():
            self.refuse(fault, "--gl", "egl", says=("egl:0: its driver gives wrong answers: " + says, "--gl off"))
            self.refuse(fault, "--gl", "osmesa", says="osmesa: its driver gives wrong answers: " + says)
            self.refuse(fault, "--device", "surfaceless", says="surfaceless: its driver gives wrong answers")
        self.refuse("crash at list", "--gl", "egl", says="egl: its driver crashed (Segmentation fault)")

    def test_by_default_the_cpu_takes_over_with_a_warning(self):
        for fault, says in {**CRASHES, **WRONG, "crash at list": "Segmentation fault"}.items():
            done = self.draw(fault)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for part in ("warning: the GPU cannot be used", says, "all passes run on the CPU"):
                self.assertIn(part, done.stderr)
            self.assertEqual((self.facts()["passes"]["form"], self.facts()["gl"]), ("cpu", None))
            self.assertIn(says, self.facts()["passes"]["why"])
            self.assertEqual([warning["code"] for warning in self.facts()["warnings"]], ["gpu-unusable"])

    def test_one_that_hangs_is_given_up(self):
        start = time.monotonic()
        self.refuse("hang", "--device", "osmesa", says="osmesa: its driver did not answer for 20 s")
        self.assertLess(time.monotonic() - start, 60)
        self.assertEqual(probing(self.folder), [])

    def test_the_child_ends_with_its_parent(self):
        for number in (signal.SIGKILL, signal.SIGTERM):
            process = self.start("render", SCENE, *SMALL, "--gl", "osmesa", env=dict(os.environ, **self.driver("hang")))
            deadline = time.monotonic() + 60
            while not probing(self.folder) and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertNotEqual(probing(self.folder), [])
            process.send_signal(number)
            process.communicate(timeout=60)
            while probing(self.folder) and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertEqual(probing(self.folder), [])

    def test_no_zombie_stays_while_frames_are_rendered(self):
        process = self.start("render", SCENE, *SMALL, "-q", "--gl", "egl", "--frames", "1-100000", "-o", "out/x.####.png",
                             env=dict(os.environ, **self.driver("")))
        deadline = time.monotonic() + 60
        while not os.path.exists(self.path("out/x.0002.png")) and time.monotonic() < deadline:
            time.sleep(0.01)
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            self.assertEqual(file.read(), "")
        process.kill()
        process.communicate(timeout=60)

    def test_doctor_tells_all(self):
        done = self.run_binary("doctor", "--json", env=self.driver("abort"))
        self.assertEqual((done.returncode, done.stderr), (4, ""))
        report = json.loads(done.stdout)
        self.assertEqual([device["id"] for device in report["unusable"]], ["egl:0", "surfaceless", "osmesa"])
        self.assertEqual({device["problem"] for device in report["unusable"]}, {"its driver crashed (Aborted)"})
        os.unlink(self.path("driver/libOSMesa.so.8"))
        done = self.run_binary("doctor", env=self.driver("crash at list"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("- egl          unusable: its driver crashed (Segmentation fault)", done.stdout)
        self.assertIn("* osmesa", done.stdout)
        self.assertIn("llvmpipe", self.succeed("--version", "--json", env=self.driver("crash at list")).stdout)

    def test_nothing_is_tried_where_no_gl_is_wanted(self):
        self.draw("crash at list", "--gl", "off")
        self.draw("crash at list", "--method", "raytrace")
        self.succeed("inspect", SCENE, "--gl", "egl", env=self.driver("crash at list"))
        if not glob.glob("/dev/dri") and not glob.glob("/dev/nvidia*"):
            environment = self.driver("crash at list")
            del environment["__EGL_VENDOR_LIBRARY_FILENAMES"]
            self.assertEqual(self.render(env=environment).stderr, "")
        self.assertEqual(self.loaded(), [])

    def test_a_run_tries_each_gl_once(self):
        case = {"scene": SCENE, "options": ["--gl", "egl", *SMALL], "reason": ""}
        self.write("list.json", json.dumps({"cases": [dict(case, name=name) for name in "abc"]}))
        self.succeed("golden", "update", "--list", "list.json", env=self.driver(""))
        self.assertEqual(sum("--probe-gl" in line for line in self.loaded()), 1, self.loaded())


if __name__ == "__main__":
    unittest.main()
