"""hybridrt compare through the real binary: exit codes, messages, JSON, the difference image."""

import json
import os
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

BINARY = os.path.abspath(sys.argv.pop(1))


def write_png(path, width, height, color_at, channels=3):
    rows = b"".join(b"\0" + b"".join(bytes(color_at(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) +
                   chunk(b"IEND", b""))


def plain(x, y):
    return (x * 4, y * 5, 99)


def with_spot(x, y):
    return (x * 4, y * 5 + (8 if (x, y) == (5, 6) else 0), 99)


class CompareTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        write_png(self.path("a.png"), 60, 40, plain)
        write_png(self.path("spot.png"), 60, 40, with_spot)
        write_png(self.path("shifted.png"), 60, 40, lambda x, y: plain(max(0, x - 1), y))
        write_png(self.path("black.png"), 60, 40, lambda x, y: (0, 0, 0))
        write_png(self.path("small.png"), 30, 40, plain)
        write_png(self.path("alpha.png"), 60, 40, lambda x, y: plain(x, y) + (255,), channels=4)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def compare(self, *arguments, **keywords):
        return subprocess.run([BINARY, "compare", *arguments], cwd=self.folder.name, capture_output=True, text=True,
                              timeout=60, **keywords)

    def expect(self, code, *arguments, error="", **keywords):
        done = self.compare(*arguments, **keywords)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        if code in (0, 6):
            self.assertEqual(done.stderr, "")
        else:
            self.assertEqual(done.stdout, "")
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("hybridrt: "), done.stderr)
            self.assertIn(error, done.stderr)
        return done

    def test_same(self):
        done = self.expect(0, "a.png", "a.png")
        self.assertIn("PSNR                 inf dB", done.stdout)
        self.assertRegex(done.stdout, r"verdict +same\n")

    def test_one_spot_is_within_the_default_share(self):
        self.expect(0, "spot.png", "a.png")
        done = self.expect(6, "spot.png", "a.png", "--fail-percent", "0")
        self.assertRegex(done.stdout, r"verdict +differ: ")
        self.assertIn("at (5, 6), channel 1", done.stdout)
        self.expect(6, "spot.png", "a.png", "--hard-fail", "0.03")
        self.expect(0, "spot.png", "a.png", "--fail-percent", "0", "--fail", "0.04")

    def test_planted_defects(self):
        for name in ("shifted.png", "black.png", "small.png", "alpha.png"):
            self.expect(6, name, "a.png")
        self.assertIn("30x40", self.expect(6, "small.png", "a.png").stdout)
        self.assertIn("4 channels", self.expect(6, "alpha.png", "a.png").stdout)

    def test_json(self):
        same = json.loads(self.expect(0, "a.png", "a.png", "--json").stdout)
        self.assertEqual((same["verdict"], same["psnr_db"], same["max_error"]), ("same", None, 0))
        spot = json.loads(self.expect(6, "spot.png", "a.png", "--json", "--fail-percent", "0.01").stdout)
        self.assertEqual(spot["verdict"], "differ")
        self.assertIn("%", spot["reason"])
        self.assertAlmostEqual(spot["max_error"], 8 / 255, 6)
        self.assertEqual(spot["max_error_at"], {"x": 5, "y": 6, "channel": 1})
        self.assertEqual(spot["pixels_over_fail"], 1)
        self.assertEqual(spot["limits"], {"fail": 0.004, "fail_percent": 0.01, "hard_fail": 0.1})
        self.assertNotIn("rmse", json.loads(self.expect(6, "small.png", "a.png", "--json").stdout))

    def test_difference_image(self):
        self.expect(0, "spot.png", "a.png", "--diff", "diff.png")
        write_png(self.path("expected.png"), 60, 40, lambda x, y: (0, 80 if (x, y) == (5, 6) else 0, 0))
        self.expect(0, "diff.png", "expected.png", "--fail", "0", "--fail-percent", "0")
        done = self.compare("small.png", "a.png", "--diff", "none.png")
        self.assertEqual(done.returncode, 6)
        self.assertIn("none.png not written", done.stderr)
        self.assertFalse(os.path.exists(self.path("none.png")))

    def test_unreadable_images(self):
        with open(self.path("random.png"), "wb") as file:
            file.write(os.urandom(5000))
        open(self.path("empty.png"), "wb").close()
        open(self.path("x.null"), "wb").close()
        os.mkfifo(self.path("pipe.png"))
        for name in ("missing.png", "random.png", "empty.png", "pipe.png", "x.null", "."):
            self.expect(3, name, "a.png", error=name)
            self.expect(3, "a.png", name, error=name)

    def test_file_cut_short(self):
        with open(self.path("a.png"), "rb") as whole, open(self.path("cut.png"), "wb") as cut:
            cut.write(whole.read()[:120])
        done = self.compare("cut.png", "a.png")  # libpng adds a line of its own before ours
        self.assertEqual(done.returncode, 3)
        self.assertIn("hybridrt: cut.png: broken image", done.stderr)

    def test_bad_options(self):
        for option, value in (("--fail", "-1"), ("--fail", "nan"), ("--fail-percent", "101"), ("--hard-fail", "x"),
                              ("--hard-fail", "inf"), ("--fail-percent", "")):
            self.expect(2, "a.png", "a.png", f"{option}={value}", error=option)
        self.expect(2, "a.png", error="REFERENCE")
        self.expect(2, "a.png", "a.png", "--fial", "1", error="did you mean --fail?")
        self.expect(2, "a.png", "a.png", "--diff", "diff.xyz", error="diff.xyz")
        self.expect(2, "a.png", "a.png", "--diff", "diff.null", error="diff.null")

    def test_unwritable_difference(self):
        self.expect(5, "a.png", "a.png", "--diff", "a.png/diff.png", error="Not a directory")

        def tight_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50, 50))

        self.expect(5, "a.png", "black.png", "--diff", "diff.png", error="File too large", preexec_fn=tight_files)
        self.assertFalse([name for name in os.listdir(self.folder.name) if "diff" in name])


if __name__ == "__main__":
    unittest.main()
