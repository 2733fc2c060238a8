"""hybridrt golden and compare: every planted defect is caught."""

import json
import os
import re
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

    def test_our_own_list_says_what_draws(self):
        here = os.path.join(os.path.dirname(__file__), "..", "..", "golden", "golden.json")
        with open(here, encoding="utf-8") as file:
            for case in json.load(file)["cases"]:
                self.assertEqual(case["options"].count("--gl"), 1, case["name"])

    def test_update_then_check_passes(self):
        done = self.check(0, "--junit", "junit.xml")
        self.assertIn("1 of 1", done.stdout)
        self.assertEqual((self.expected.width, self.expected.height), (96, 72))
        suite = xml.etree.ElementTree.parse(self.path("junit.xml")).getroot()
        self.assertEqual(len(list(suite.iter("testcase"))), 1)
        self.assertEqual(list(suite.iter("failure")), [])
        page = self.read("report/report.html").decode()
        for part in ("small", "<img", "a test's own", "hybridrt 0.1.0", "passes on the CPU"):
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
        self.assertTrue({"report.html", "small.png", "small.expected.png", "small.diff.png"} <= set(self.files("report")))
        failures = list(xml.etree.ElementTree.parse(self.path("junit.xml")).getroot().iter("failure"))
        self.assertEqual(len(failures), 1)
        page = self.read("report/report.html").decode()
        for source in re.findall(r'src="([^"]*)"', page):
            self.assertIn(source, ("./small.png", "./small.expected.png", "./small.diff.png"), "the page needs no other folder")
            self.assertTrue(os.path.exists(self.path("report", source)))

    def test_missing_or_broken_expected_picture(self):
        os.remove(self.path("small.png"))
        done = self.check(6)
        self.assertIn("small.png is missing; 'hybridrt golden update --list list.json small' makes it", done.stdout)
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
        for options, says in ((["--frames", "1-101"], "101 frames"),
                              (["--no-such-option"], "--no-such-option"), (["--fov", "0"], "--fov 0"),
                              (["--size", "8x8", "--size", "9x9"], "--size is given 2 times"),
                              (["--threads", "x"], "--threads x"), (["--method", "magic"], "--method magic"),
                              (["--size"], "--size has no value"), (["--help"], "--help"),
                              (["--camera", "gone.json"], "gone.json cannot be opened")):
            self.write_list(options=options)
            for action in (("check", "-o", "report"), ("update",)):
                with self.subTest(options, action=action[0]):
                    done = self.run_binary("golden", *action, "--list", "list.json")
                    self.assertEqual((done.returncode, len(done.stderr.splitlines())), (3, 1))
                    self.assertIn("golden case 'small': ", done.stderr)
                    self.assertIn(says, done.stderr)
        self.write_list(scene="gone.obj")
        self.assertIn("gone.obj", self.check(3).stderr)

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


    def test_every_case_runs_whatever_one_does(self):
        cases = [dict(self.case, name="gone", scene="gone.obj"), dict(self.case, name="bad", options=["--fov", "0"]),
                 dict(self.case, name="black"), self.case]
        self.write("list.json", json.dumps({"cases": cases}))
        Png(96, 72, [bytearray(3 * 96)] * 72).write(self.path("black.png"))
        done = self.check(3, "--junit", "junit.xml")
        self.assertEqual([line.split()[:2] for line in done.stdout.splitlines()[:4]],
                         [["BROKEN", "gone"], ["BROKEN", "bad"], ["FAILED", "black"], ["ok", "small"]])
        self.assertIn("1 of 4 as expected", done.stdout)
        self.assertIn("golden case 'gone': gone.obj", done.stderr)
        self.assertIn("1 more could not be rendered", done.stderr)
        suite = xml.etree.ElementTree.parse(self.path("junit.xml")).getroot()
        self.assertEqual({key: suite.get(key) for key in ("tests", "failures", "errors")},
                         {"tests": "4", "failures": "1", "errors": "2"})

    def test_no_stale_junit(self):
        for spoil in (lambda: self.write("list.json", "{"), lambda: os.remove(self.path("list.json"))):
            self.write("junit.xml", "<testsuite tests='1' failures='0'/>")
            spoil()
            self.check(3, "--junit", "junit.xml")
            errors = list(xml.etree.ElementTree.parse(self.path("junit.xml")).getroot().iter("error"))
            self.assertEqual(len(errors), 1)
            self.assertIn("list.json", errors[0].get("message"))
        self.write_list()
        before = self.read("list.json")
        self.check(2, "--junit", "list.json")
        self.assertEqual(self.read("list.json"), before)

    def test_several_frames(self):
        self.write_list(name="turn", options=["--frames", "2-4", "--sequence", "1-8", *SMALL])
        self.succeed("golden", "update", "--list", "list.json")
        self.assertEqual([name for name in self.files() if name.startswith("turn")],
                         ["turn.0002.png", "turn.0003.png", "turn.0004.png"])
        self.assertIn("3 of 3", self.check(0).stdout)
        Png(96, 72, [bytearray(3 * 96)] * 72).write(self.path("turn.0003.png"))
        self.assertIn("FAILED  turn.0003", self.check(6).stdout)

    def test_update_says_what_changes(self):
        self.assertIn("small.png: unchanged", self.succeed("golden", "update", "--list", "list.json").stdout)
        self.expected.rows[36][3 * 48] ^= 0x80
        self.expected.write(self.path("small.png"))
        said = self.succeed("golden", "update", "--list", "list.json").stdout
        self.assertRegex(said, r"small.png: changed: 0.014 % of the pixels, by at most 0.50")
        os.remove(self.path("small.png"))
        self.assertIn("small.png: new", self.succeed("golden", "update", "--list", "list.json").stdout)

    def test_a_list_is_made(self):
        self.succeed("golden", "init", "mine")
        self.fail_with(2, "golden", "init", "mine", says="mine/golden.json is there")
        self.fail_with(3, "golden", "check", "--list", "mine/golden.json", says=("no cases", "golden add"))
        self.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.succeed("golden", "add", "tri", "tri.obj", "--list", "mine/golden.json", "--size", "40x30", "--eye", "0,0,4")
        self.succeed("golden", "add", "two", SCENE, *SMALL, "--frames", "1-2", "--list", "mine/golden.json", "--reason", "turns")
        cases = json.loads(self.read("mine/golden.json"))["cases"]
        self.assertEqual([case["name"] for case in cases], ["tri", "two"])
        self.assertEqual((cases[0]["scene"], cases[1]["reason"]), ("../tri.obj", "turns"))
        self.assertEqual(cases[0]["options"], ["--size", "40x30", "--eye", "0,0,4", "--gl", "off"])
        self.assertEqual(self.files("mine"), ["golden.json", "tri.png", "two.0001.png", "two.0002.png"])
        done = self.run_binary("golden", "check", "--list", "mine/golden.json", "-o", "report")
        self.assertIn("3 of 3", done.stdout)
        self.fail_with(2, "golden", "add", "tri", "tri.obj", "--list", "mine/golden.json", says=("'tri' already", "update"))
        self.fail_with(3, "golden", "add", "bad", "tri.obj", "--list", "mine/golden.json", "--fov", "0", says="--fov 0")
        self.assertEqual(len(json.loads(self.read("mine/golden.json"))["cases"]), 2)

    def test_a_budget_of_time(self):
        self.write_list(budget=0.0)
        self.assertIn("its budget is 0", self.check(0).stdout)
        self.check(6, "--enforce-time")
        self.write_list(budget=1e6)
        self.check(0, "--enforce-time")


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
