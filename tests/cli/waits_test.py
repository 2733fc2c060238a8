"""Nothing is waited for that may never come: pipes and devices where a file should be, threads that cannot be started.
One signal ends every wait that a run may be in."""

import json
import os
import resource
import signal
import subprocess
import time
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase, Png

OBJ = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"
CAMERA = {"keyframes": [{"frame": 1, "eye": [0, 0, 3], "target": [0, 0, 0]}]}
CPU = (*SMALL, "-q", "--gl", "off")
SOON = 20  # seconds, on a busy machine


class WaitsCase(CliTestCase):
    def run_soon(self, *arguments, **keywords):
        return subprocess.run([BINARY, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=SOON,
                              stdin=subprocess.DEVNULL, **keywords)

    def through_shell(self, command, *arguments):
        return subprocess.run(["/bin/bash", "-c", command, BINARY, *arguments], cwd=self.folder, capture_output=True,
                              text=True, timeout=SOON)


class PipesAndDevicesTest(WaitsCase):
    def test_as_inputs(self):
        self.write("a.obj", OBJ)
        kinds = {"fifo": os.mkfifo, "zero": lambda path: os.symlink("/dev/zero", path), "folder": os.mkdir}
        for kind, make in kinds.items():
            for extension in ("obj", "ply", "off", "stl", "json"):
                make(self.path(f"{kind}.{extension}"))
            self.write(f"mesh_{kind}.json", json.dumps({"meshes": [f"{kind}.obj"]}))
            self.write(f"path_{kind}.json", json.dumps({"meshes": ["a.obj"], "camera_path": f"{kind}.json"}))
            make(self.path(f"sweep_{kind}"))
            for arguments in (*(("inspect", f"{kind}.{e}") for e in ("obj", "ply", "off", "stl", "json")),
                              ("inspect", f"mesh_{kind}.json"), ("render", f"path_{kind}.json", *CPU),
                              ("render", "a.obj", *CPU, "--camera", f"{kind}.json"),
                              ("render", "a.obj", *CPU, "--config", f"{kind}.json"),
                              ("golden", "check", "--list", f"{kind}.json"), ("compare", f"{kind}.obj", f"{kind}.obj")):
                with self.subTest(arguments):
                    done = self.run_soon(*arguments)
                    self.assertEqual(done.returncode, 3, done.stderr)
                    lines = [line for line in done.stderr.splitlines() if "warning" not in line]
                    self.assertEqual(len(lines), 1, done.stderr)

    def test_as_mtl_texture_shader_and_tables(self):
        self.write("a.obj", OBJ)
        os.mkfifo(self.path("m.mtl"))
        self.assertEqual(self.run_soon("render", "a.obj", *CPU).returncode, 0)
        os.remove(self.path("m.mtl"))
        self.write("m.mtl", "newmtl m\nmap_Kd t.png\n")
        os.mkfifo(self.path("t.png"))
        self.assertEqual(self.run_soon("render", "a.obj", *CPU).returncode, 0)
        os.mkdir(self.path("shaders"))
        os.mkfifo(self.path("shaders", "id.vert"))
        self.assertEqual(self.run_soon("render", "a.obj", *SMALL, "--shaders", "shaders").returncode, 3)
        for name in ("sweep.csv", "sweep.json"):
            os.makedirs(self.path(name[6:]))
            os.mkfifo(self.path(name[6:], name))
            done = self.run_soon("sweep", SCENE, *CPU, "--over", "samples=1,2", "--no-charts", "-o", name[6:])
            self.assertEqual(done.returncode, 3, done.stderr)

    def test_pipes_given_on_purpose(self):
        self.write("a.obj", OBJ)
        self.write("m.mtl", "newmtl m\n")
        self.write("camera.json", json.dumps(CAMERA))
        for command in ("--camera <(cat camera.json)", "--config <(echo '{\"samples\": 2}')"):
            done = self.through_shell(f'"$0" "$@" {command} -o x.png', "render", "a.obj", *CPU)
            self.assertEqual((done.returncode, done.stderr), (0, ""), command)
        done = self.through_shell('"$0" inspect <(cat a.obj) --input-format obj')
        self.assertIn("triangles   1", done.stdout)

    def test_pictures_into_devices_and_descriptors(self):
        for arguments in ((), ("--frames", "3"), ("--timings", "/dev/null")):
            done = self.run_soon("render", SCENE, *CPU, "-o", "/dev/null", *arguments)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.files(), [])
        done = self.through_shell('"$0" "$@" -o /dev/fd/3 3>>x.png', "render", SCENE, *CPU)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        Png.read(self.path("x.png"))
        self.assertEqual(self.files(), ["x.png"])

    def test_a_named_pipe_that_nobody_reads(self):
        os.mkfifo(self.path("f"))
        done = self.run_soon("render", SCENE, *CPU, "-o", "x.png", "--timings", "f")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("Broken pipe", done.stderr)
        done = self.through_shell('(sleep 0.5; cat f > copy) & "$0" "$@" -o x.png --timings f; code=$?; wait; exit $code',
                                  "render", SCENE, *CPU)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.read("copy").count(b"\n"), 2)


class SignalsTest(WaitsCase):
    def end(self, process, number, within=SOON):
        process.send_signal(number)
        process.communicate(timeout=within)
        return process.returncode

    def test_while_standard_input_is_awaited(self):
        temporary = self.path("tmp")
        os.mkdir(temporary)
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 143)):
            read_end, write_end = os.pipe()
            process = self.start("inspect", "-", "--input-format", "obj", stdin=read_end,
                                 env=dict(os.environ, TMPDIR=temporary))
            self.wait_until(lambda: os.listdir(temporary))
            self.assertEqual(self.end(process, number), code)
            self.assertEqual(os.listdir(temporary), [], "temporary files")
            os.close(read_end)
            os.close(write_end)

    def wait_until(self, done):
        deadline = time.monotonic() + 60
        while not done():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    @staticmethod
    def catches(process, number):
        """Whether the process has a handler for a signal, by /proc."""
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            caught = next(line for line in status if line.startswith("SigCgt:"))
        return int(caught.split()[1], 16) >> (number - 1) & 1 == 1

    def test_while_loading_and_building(self):
        scene = "scene:spheres,triangles=3M"
        self.write("list.json", json.dumps({"cases": [{"name": "a", "scene": scene, "options": [], "reason": "is"}]}))
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            for command in (("render", scene, "--accel", "kdtree", "-q", "-o", "x.png"), ("inspect", scene),
                            ("tune", scene, "--max-error", "99dB", "-q"), ("golden", "check", "--list", "list.json")):
                process = self.start(*command)
                self.wait_until(lambda: self.catches(process, number))  # before, the libraries are being loaded
                time.sleep(0.3)
                self.assertIsNone(process.poll(), command)
                self.assertEqual(self.end(process, number, within=5), code, command)
                self.assertEqual([name for name in self.files() if name.startswith(".")], [])

    def test_while_a_reader_does_not_read(self):
        read_end, write_end = os.pipe()
        process = self.start("render", SCENE, *SMALL, "-q", "--frames", "100000", "-o", "x.####.png", "--json",
                             stdout=write_end)
        os.close(write_end)
        self.wait_until(lambda: len(self.files()) > 100)
        seen = -1
        while seen != len(self.files()):  # until the pipe is full
            seen = len(self.files())
            time.sleep(0.5)
        self.assertIsNone(process.poll())
        self.assertEqual(self.end(process, signal.SIGTERM), 143)
        os.close(read_end)

    def test_hangup_finishes_the_frame(self):
        process = self.start("render", SCENE, *SMALL, "-q", "--frames", "100000", "-o", "x.####.png")
        self.wait_until(lambda: len(self.files()) > 5)
        self.assertEqual(self.end(process, signal.SIGHUP), 143)
        self.assertIn("run.json", self.files())

    def test_what_is_ignored_stays_ignored(self):
        process = self.start("render", SCENE, *SMALL, "-q", "--frames", "100000", "-o", "x.####.png",
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_until(lambda: len(self.files()) > 5)
        process.send_signal(signal.SIGHUP)
        frames = len(self.files())
        self.wait_until(lambda: len(self.files()) > frames + 5)
        self.assertEqual(self.end(process, signal.SIGINT), 130)


class FewProcessesTest(WaitsCase):
    """RLIMIT_NPROC, which does not bind root."""

    def test_no_thread_is_waited_for(self):
        user = {"user": 54321, "group": 54321, "extra_groups": []} if os.getuid() == 0 else {}
        os.chmod(self.folder, 0o777)

        def limit(count):
            resource.setrlimit(resource.RLIMIT_NPROC, (count, count))
        commands = [(*where, "--threads", threads) for threads in ("1", "4")
                    for where in (("--gl", "egl"), ("--gl", "off"), ("--method", "raytrace", "--accel", "embree"))]
        codes = set()
        for count in (*range(6, 16), 18, 22):
            try:
                done = self.run_soon("--help", preexec_fn=lambda: limit(count), **user)
            except (PermissionError, subprocess.SubprocessError):
                self.skipTest("another user cannot run the program")
            if done.returncode != 0:
                continue  # libraries start threads of their own before main()
            for arguments in commands:
                done = self.run_soon("render", SCENE, *SMALL, "-q", *arguments, preexec_fn=lambda: limit(count), **user)
                with self.subTest(count=count, arguments=arguments):
                    if done.returncode == 4:
                        self.assertIn("--gl egl", " ".join(arguments), done.stderr)
                        self.assertNotIn("Embree", done.stderr)
                    else:
                        self.assertIn(done.returncode, (0, 2), done.stderr)
                codes.add(done.returncode)
        self.assertLessEqual({0, 2}, codes)


if __name__ == "__main__":
    unittest.main()
