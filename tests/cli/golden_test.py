"""hybridrt golden and compare: every planted defect is caught."""

import json
import os
import struct
import unittest
import xml.etree.ElementTree

from cli_test_case import SCENE, SMALL, CliTestCase, Png


class GoldenTest(CliTestCase):
    def setUp(self):
        super().setUp()
        self.case = {"name": "small", "scene": SCENE, "options": list(SMALL), "reason": "a test's own"}
        self.write_list()
        self.succeed("golden", "update", "--list", "list.json")
        self.expected = Png.read(self.path("small.png"))

    def write_list(self, **changes):
        self.write("list.json", json.dumps({"cases": [dict(self.case, **changes)]}))

    def check(self, code, *arguments):
        done = self.run_binary("golden", "check", "--list", "list.json", "-o", "report", *arguments)
        self.assertEqual(done.returncode, code, f"{done.stdout}\n{done.stderr}")
        return done

    def expect_caught(self):
        self.assertIn("FAILED", self.check(6).stdout)

    def test_update_then_check_passes(self):
        done = self.check(0, "--junit", "junit.xml")
        self.assertIn("1 of 1", done.stdout)
        self.assertEqual((self.expected.width, self.expected.height), (96, 72))
        suite = xml.etree.ElementTree.parse(self.path("junit.xml")).getroot()
        self.assertEqual(len(list(suite.iter("testcase"))), 1)
        self.assertEqual(list(suite.iter("failure")), [])
        page = self.read("report/report.html").decode()
        for part in ("small", "<img", "a test&#39;s own" if "&#39;" in page else "a test's own"):
            self.assertIn(part, page)

    def test_one_pixel_shifted(self):
        rows = [row[:3] + row[:-3] for row in self.expected.rows]
        Png(96, 72, rows).write(self.path("small.png"))
        self.expect_caught()

    def test_one_wrong_pixel(self):
        self.expected.rows[36][3 * 48] ^= 0x80
        self.expected.write(self.path("small.png"))
        self.expect_caught()

    def test_rewritten_but_equal_passes(self):
        self.expected.write(self.path("small.png"))
        self.check(0)

    def test_black_frame(self):
        Png(96, 72, [bytearray(3 * 96)] * 72).write(self.path("small.png"))
        self.expect_caught()

    def test_other_size(self):
        Png(95, 72, [row[:-3] for row in self.expected.rows]).write(self.path("small.png"))
        self.expect_caught()
        self.write_list(options=["--size", "96x71", *SMALL[2:]])
        self.expect_caught()

    def test_changed_light(self):
        self.write_list(options=[*SMALL, "--light", "1,2,0.5"])
        self.expect_caught()

    def test_changed_camera_and_method(self):
        for change in (("--fov", "44"), ("--frames", "2-2", "--sequence", "1-60"), ("--shadows", "none"),
                       ("--reflection-depth", "0")):
            self.write_list(options=[*SMALL, *change])
            self.expect_caught()

    def test_failure_leaves_pictures_and_reports(self):
        Png(96, 72, [bytearray(3 * 96)] * 72).write(self.path("small.png"))
        self.check(6, "--junit", "junit.xml")
        self.assertTrue({"report.html", "small.png", "small.diff.png"} <= set(self.files("report")))
        failures = list(xml.etree.ElementTree.parse(self.path("junit.xml")).getroot().iter("failure"))
        self.assertEqual(len(failures), 1)
        page = self.read("report/report.html").decode()
        for source in ("small.png", "small.diff.png"):
            self.assertIn(source, page)

    def test_missing_or_broken_expected_picture(self):
        os.remove(self.path("small.png"))
        done = self.check(6)
        self.assertIn("small.png is missing", done.stdout)
        self.write("small.png", "no picture")
        self.check(6)

    def test_bad_lists(self):
        for text, says in (("{", "list.json"), ('{"cases":[]}', "no cases"), ("[]", "list.json"),
                           ('{"cases":[{"name":"a","scene":"s","reason":"r","fial":1}]}', "fial"),
                           ('{"cases":[{"name":"a","scene":"s"}]}', "reason")):
            self.write("list.json", text)
            for action in ("check", "update"):
                self.fail_with(3, "golden", action, "--list", "list.json", says=says)
        self.fail_with(3, "golden", "check", "--list", "missing.json", says="missing.json")

    def test_unknown_name(self):
        for action in ("check", "update"):
            self.fail_with(2, "golden", action, "--list", "list.json", "zebra", says="zebra")
        self.assertIn("1 of 1", self.check(0, "small").stdout)

    def test_bad_options_of_a_case(self):
        for options, says in ((["--frames", "1-3"], "3 frames; say which one"),
                              (["--no-such-option"], "--no-such-option"), (["--fov", "0"], "--fov 0"),
                              (["--size", "8x8", "--size", "9x9"], "--size is given 2 times"),
                              (["--threads", "x"], "--threads x"), (["--method", "magic"], "--method magic"),
                              (["--size"], "--size has no value"), (["--help"], "--help"),
                              (["--camera", "gone.json"], "gone.json cannot be opened")):
            self.write_list(options=options)
            for action in (("check", "-o", "report"), ("update",)):
                with self.subTest(options, action=action[0]):
                    self.fail_with(3, "golden", *action, "--list", "list.json", says=("golden case 'small': ", says))
        self.write_list(scene="gone.obj")
        self.fail_with(3, "golden", "check", "--list", "list.json", says=("golden case 'small': ", "gone.obj"))

    def test_update_replaces_only_what_is_named(self):
        other = dict(self.case, name="other")
        self.write("list.json", json.dumps({"cases": [self.case, other]}))
        before = self.read("small.png")
        self.write("small.png", "spoilt")
        self.succeed("golden", "update", "--list", "list.json", "other")
        self.assertEqual(self.read("small.png"), b"spoilt")
        self.succeed("golden", "update", "--list", "list.json")
        self.assertEqual(self.read("small.png"), before)
        self.check(0)


class CompareNonFiniteTest(CliTestCase):
    """Formats that can hold a NaN, written by hand."""

    def write_pfm(self, name, values):
        with open(self.path(name), "wb") as file:
            file.write(b"PF\n4 2\n-1.0\n" + struct.pack("<24f", *values))

    def write_tiff(self, name, values):
        data = struct.pack("<24f", *values)
        fields = [(256, 3, 4), (257, 3, 2), (258, 3, 32), (259, 3, 1), (262, 3, 2), (273, 4, 8), (277, 3, 3),
                  (278, 3, 2), (279, 4, len(data)), (284, 3, 1), (339, 3, 3)]
        entries = b"".join(struct.pack("<HHII", tag, kind, 1, value) for tag, kind, value in fields)
        with open(self.path(name), "wb") as file:
            file.write(b"II*\0" + struct.pack("<I", 8 + len(data)) + data + struct.pack("<H", len(fields)) + entries +
                       struct.pack("<I", 0))

    def test_nan_and_infinity_differ_even_from_themselves(self):
        fine = [i / 24 for i in range(24)]
        for write, name in ((self.write_pfm, "x.pfm"), (self.write_tiff, "x.tif")):
            write("fine." + name[2:], fine)
            self.succeed("compare", "fine." + name[2:], "fine." + name[2:])
            for bad in (float("nan"), float("inf"), float("-inf")):
                write(name, fine[:17] + [bad] + fine[18:])
                for pair in ((name, "fine." + name[2:]), ("fine." + name[2:], name), (name, name)):
                    done = self.run_binary("compare", *pair, "--fail", "1", "--fail-percent", "100", "--hard-fail",
                                           "1")
                    self.assertEqual(done.returncode, 6, (pair, bad, done.stdout, done.stderr))
                    self.assertIn("finite", done.stdout)


if __name__ == "__main__":
    unittest.main()
