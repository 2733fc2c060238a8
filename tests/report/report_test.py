"""Tests of scripts/report with its charts: made-up sweeps through the real command, and what the page holds."""
from __future__ import annotations

import csv
import json
import re
import statistics
import unittest
import xml.etree.ElementTree as ElementTree

from make_sweep import PRESETS, Sweep, make_sweep
from report_case import Page, ReportTestCase, needs_matplotlib

from report.number_text import ms_text

SHADOWS = {"shadows": ["map", "exact", "rays"]}


@needs_matplotlib
class DrawnTest(ReportTestCase):
    def test_charts_of_each_preset(self):
        wanted = {
            "pareto": ["pareto", "passes-method", "passes-shadows", "passes-shadow-map", "error-shadow-map"],
            "paper": ["pareto", "passes-reflection-percent", "error-reflection-percent", "passes-shadows"],
            "scaling": ["passes-threads", "scaling", "passes-method", "passes-accel"],
            "growth": ["pareto", "passes-triangles", "growth", "error-triangles", "passes-shadows"],
            "pixels": ["passes-size", "growth-size", "passes-method"]}
        for preset, names in wanted.items():
            with self.subTest(preset):
                make_sweep(self.folder, PRESETS[preset])
                files, page = self.report()
                self.assertEqual(files, [f"{name}.{kind}" for name in names for kind in ("svg", "png")] + ["report.html"])
                self.assertFalse(list(self.folder.glob(".*")))
                for name in names:
                    svg = (self.folder / f"{name}.svg").read_text(encoding="utf-8")
                    ElementTree.fromstring(svg)
                    self.assertIn("AMD EPYC", svg)
                    self.assertIn("sans-serif", svg)
                    self.assertEqual((self.folder / f"{name}.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
                    self.assertIn(f'href="{name}.svg"', page)

    def test_growth_tells_loading_and_memory(self):
        for preset, name, labels in (("growth", "growth", ("peak memory, bytes a triangle", "loading and building, ms", "ms a frame")),
                                     ("pixels", "growth-size", ("peak memory, bytes a pixel", "ms a frame"))):
            make_sweep(self.folder, PRESETS[preset])
            self.report()
            svg = (self.folder / f"{name}.svg").read_text(encoding="utf-8")
            self.assertEqual([label for label in labels if label not in svg], [])

    def test_same_input_same_bytes(self):
        make_sweep(self.folder, PRESETS["pareto"])
        names, _ = self.report()
        first = {name: (self.folder / name).read_bytes() for name in names}
        self.report()
        self.assertEqual([name for name in names if (self.folder / name).read_bytes() != first[name]], [])

    def test_the_page_needs_no_other_file(self):
        make_sweep(self.folder, PRESETS["pareto"])
        names, text = self.report()
        page = Page(text)
        self.assertEqual(page.open, [])
        self.assertNotIn("script", page.tags)
        for tag, address in page.addresses:
            if address.startswith("#"):
                self.assertIn(address[1:], page.ids, address)
            elif tag == "a":
                self.assertIn(address, [*names, "sweep.csv", "sweep.json"])
            else:
                self.assertTrue(address.startswith("data:"), address[:80])
        self.assertEqual(re.findall(r"url\((?!#)|@import", text), [])
        references = re.findall(r"url\(#([^)]*)\)", text)
        self.assertTrue(references)
        self.assertLessEqual(set(references), set(page.ids))
        self.assertEqual(len(page.ids), len(set(page.ids)))

    def test_the_table_tells_what_the_csv_holds(self):
        make_sweep(self.folder, Sweep(SHADOWS, rounds=5, frames=1, pictures=False))
        _, text = self.report()
        header, *rows = Page(text).rows
        with open(self.folder / "sweep.csv", newline="") as file:
            measured = list(csv.DictReader(file))
        rows, (pass_header, *pass_rows) = rows[:3], rows[3:]
        for row in pass_rows:
            cells = dict(zip(pass_header, row))
            times = sorted(float(line["trace_ms"]) for line in measured if line["setting"] == cells["no."])
            self.assertEqual(cells["4 rays on the CPU"], f"{ms_text(times[2])} ({ms_text(times[1])}–{ms_text(times[3])})")
        self.assertEqual((len(rows), len(pass_rows)), (3, 3))
        for row in rows:
            cells = dict(zip(header, row))
            mine = [line for line in measured if line["setting"] == cells["no."]]
            walls = sorted(float(line["wall_ms"]) for line in mine)
            self.assertEqual(len(walls), 5)
            self.assertEqual(cells["ms a frame"], f"{walls[2]:.1f}")
            self.assertEqual(cells["quartiles"], f"{walls[1]:.1f}–{walls[3]:.1f}")
            self.assertEqual(cells["first frame"], f"{statistics.median(float(line['first_frame_ms']) for line in mine):.0f}")
            self.assertEqual(cells["build"], f"{float(mine[0]['accel_build_ms']):.0f}")
            self.assertEqual(cells["RMSE"], f"{float(mine[0]['rmse']):.3g}")
            wanted = "equal" if mine[0]["psnr_db"] == "inf" else f"{float(mine[0]['psnr_db']):.1f}"
            self.assertEqual(cells["PSNR, dB"], wanted)
            for heading, column in (("pixels different", "pixels_different"), ("falsely lit", "false_lit"),
                                    ("falsely in shadow", "false_shadow"), ("other triangle", "other_triangle")):
                self.assertEqual(cells[heading], mine[0][column])

    def test_the_front_is_marked_in_words(self):
        self.write([{"setting": 1, "wall_ms": 10, "rmse": 0.5}, {"setting": 2, "wall_ms": 20, "rmse": 0},
                    {"setting": 3, "wall_ms": 30, "rmse": 0.1}])
        _, text = self.report()
        header, *rows = Page(text).rows
        self.assertEqual([row[header.index("front")] for row in rows], ["on it", "on it", ""])
        self.assertIn("The fastest is 1 ", text)
        self.assertIn("Equal to the truth to the last bit is 2 ", text)

    def test_equal_pictures_stand_in_the_band(self):
        from report.error_axis import error_axis
        self.write([{"setting": 1, "wall_ms": 10, "rmse": 0.5}, {"setting": 2, "wall_ms": 20, "rmse": 0}])
        summaries = self.summaries()
        axis = error_axis(summaries, 300)
        self.assertTrue(axis.bottom < axis.y(summaries[1]) < axis.low < axis.y(summaries[0]) < axis.top)
        self.assertEqual(axis.y(summaries[0]), 0.5)
        without = error_axis(summaries[:1], 300)
        self.assertEqual(without.bottom, without.low)
        self.report()
        self.assertIn("equal to the last bit", (self.folder / "pareto.svg").read_text())
        self.write([{"setting": 1, "wall_ms": 10, "rmse": 0.5}])
        self.report()
        self.assertNotIn("equal to the last bit", (self.folder / "pareto.svg").read_text())

    def test_all_equal(self):
        self.write([{"setting": 1, "wall_ms": 10, "rmse": 0}, {"setting": 2, "wall_ms": 20, "rmse": 0}])
        names, text = self.report()
        self.assertIn("pareto.svg", names)
        self.assertIn("The fastest of those that equal the truth to the last bit is 1 ", text)

    def test_points_are_links_with_tooltips(self):
        make_sweep(self.folder, PRESETS["pareto"])
        _, text = self.report()
        for number in [number for number in range(1, 37) if number != 5]:
            self.assertRegex(text, rf'<a href="#setting-{number}"><title>{number}: [^<]*ms a frame, RMSE [^<]*</title>')
        self.assertNotIn("<a ", (self.folder / "pareto.svg").read_text())

    def test_failed_settings_are_named(self):
        make_sweep(self.folder, Sweep(SHADOWS, failing={2: "no GL context: <EGL> & co"}))
        _, text = self.report()
        self.assertIn("of which 1 failed", text)
        self.assertEqual(text.count("no GL context: &lt;EGL&gt; &amp; co"), 3)  # summary, table, pictures
        self.assertNotIn("<EGL>", text)

    def test_every_setting_failed(self):
        make_sweep(self.folder, Sweep(SHADOWS, failing={1: "one", 2: "two", 3: "three"}))
        names, text = self.report()
        self.assertEqual(names, ["report.html"])
        self.assertIn("Nothing was measured", text)
        for reason in ("one", "two", "three"):
            self.assertIn(f"failed: {reason}", text)

    def test_markup_in_names_stays_text(self):
        hostile = "$x^2$<script>alert(1)</script> \"&'"
        make_sweep(self.folder, Sweep({"shadows": ["map", hostile], "blur-kernel": ["3", "5", "7"]}, facts={
            "scene": hostile, "processor": hostile, "gl_renderer": hostile, "command_line": ["hybridrt", hostile],
            "truth": {"method": hostile, "samples": 4, "kind": "reference", "note": hostile}}))
        _, text = self.report()
        page = Page(text)
        self.assertNotIn("script", page.tags)
        self.assertNotIn("<script", text)
        self.assertIn(hostile, page.text)
        for path in self.folder.glob("*.svg"):
            root = ElementTree.parse(path).getroot()
            self.assertFalse([element for element in root.iter() if element.tag.endswith("script")])
            self.assertIn("$x^2$<script>", "".join(root.itertext()), path.name)

    def test_control_characters_and_lone_surrogates(self):
        self.write([{"setting": 1, "wall_ms": 1, "rmse": 0.1}], settings=[{"number": 1, "label": "a\x00b\ud800c"}])
        _, text = self.report()
        self.assertIn("a\ufffdb\ufffdc", text)

    def test_missing_and_broken_pictures(self):
        make_sweep(self.folder, Sweep(SHADOWS))
        (self.folder / "pictures" / "0001.png").unlink()
        (self.folder / "pictures" / "0002.difference.png").write_bytes(b"\x89PNG\r\n\x1a\nno")
        path = self.folder / "sweep.json"
        facts = json.loads(path.read_text())
        outside = self.folder.with_name(self.folder.name + ".png")
        self.addCleanup(outside.unlink)
        outside.write_bytes((self.folder / "pictures" / "0003.png").read_bytes())
        facts["settings"][2].update(picture=None, truth=f"../{outside.name}", difference=7)
        path.write_text(json.dumps(facts))
        _, text = self.report()
        self.assertEqual(re.findall(r"<figcaption>([^<]*): no picture", text),
                         ["the picture", "the difference, 8 times", "the picture", "the truth", "the difference, 8 times"])

    def test_pictures_are_small_and_have_words(self):
        from PIL import Image
        make_sweep(self.folder, Sweep(SHADOWS))
        Image.effect_noise((1600, 900), 60).save(self.folder / "pictures" / "0001.png")
        _, text = self.report()
        self.assertIn('width="640" height="360" alt="Picture of setting 1, shadows=map" src="data:image/jpeg;base64,', text)
        self.assertIn('alt="Difference of setting 1 from the truth, amplified 8 times"', text)
        self.assertEqual(text.count("<symbol"), 1)  # a truth that all share is there once
        self.assertEqual(text.count('href="#truth-0"'), 3)

    def test_without_accuracy(self):
        make_sweep(self.folder, Sweep({"threads": ["1", "2"], "shadows": ["map", "exact"]}, accuracy=False, pictures=False))
        names, text = self.report()
        self.assertEqual([name for name in names if name.startswith(("pareto", "error"))], [])
        self.assertIn("No accuracy was measured", text)
        self.assertNotIn("RMSE</th>", text)

    def test_one_setting_without_axes(self):
        self.write([{"setting": 1, "wall_ms": 12.5}], axes=[{"name": "a", "column": "a", "values": [], "changes_truth": False}])
        names, text = self.report()
        self.assertEqual(names, ["report.html"])
        self.assertIn("No axis has more than one measured value", text)

    def test_busy_machine(self):
        make_sweep(self.folder, Sweep(SHADOWS, pictures=False, facts={"busy": 0.3}))
        self.assertIn("Others used 30 % of the machine", self.report()[1])
        make_sweep(self.folder, Sweep(SHADOWS, pictures=False, facts={"busy": 0.1}))
        self.assertNotIn("Others used", self.report()[1])

    def test_pictures_that_are_no_numbers_are_not_compared(self):
        self.write([{"setting": 1, "wall_ms": 10, "rmse": 0.5}, {"setting": 2, "wall_ms": 1, "rmse": 0, "non_finite": 3}])
        _, text = self.report()
        header, *rows = Page(text).rows
        self.assertEqual([row[header.index("front")] for row in rows], ["on it", ""])
        self.assertEqual(rows[1][header.index("not numbers")], "3")
        self.assertIn("Left out, for pixels that are no numbers", text)

    def test_aliasing_of_the_truth_is_told(self):
        for samples, words in ((1, "so it has aliasing itself"), (64, "64 samples a pixel, so aliasing counts as an error")):
            make_sweep(self.folder, Sweep(SHADOWS, pictures=False, facts={
                "truth": {"method": "reference", "samples": samples, "kind": "reference", "note": ""}}))
            self.assertIn(words, self.report()[1])
        make_sweep(self.folder, Sweep(SHADOWS, pictures=False, facts={
            "truth": {"method": "", "samples": 64, "kind": "folder", "note": "the pictures in mine"}}))
        text = self.report()[1]
        self.assertIn("pictures of a folder (the pictures in mine)", text)
        self.assertNotIn("a pixel, so", text)

    def test_passes_on_the_cpu_and_their_names(self):
        make_sweep(self.folder, Sweep({"shadows": ["rays", "exact"]}, pictures=False, facts={"gl_renderer": None}))
        self.report()
        svg = (self.folder / "passes-shadows.svg").read_text()
        self.assertIn("all passes on the CPU", svg)
        self.assertIn("1 light buffer<", svg)
        self.assertNotIn("shadow map", svg)

    def test_combinations_left_out_are_told(self):
        make_sweep(self.folder, Sweep({"shadows": ["map", "exact"], "blur-kernel": list("1234567")}, pictures=False))
        self.assertIn("The first 6 of 7 combinations of the other axes are drawn", self.report()[1])

    def test_axes_that_form_no_grid(self):
        axes = [{"name": "method", "column": "method", "values": ["a", "b"], "changes_truth": False},
                {"name": "shadows", "column": "shadows", "values": ["map", "exact"], "changes_truth": False}]
        self.write([{"setting": 1, "method": "a", "shadows": "map", "wall_ms": 3, "trace_ms": 1},
                    {"setting": 2, "method": "a", "shadows": "exact", "wall_ms": 4, "trace_ms": 2},
                    {"setting": 3, "method": "b", "shadows": "", "wall_ms": 5, "trace_ms": 3}], axes)
        names, text = self.report()
        self.assertIn("passes-shadows.svg", names)
        self.assertIn("Left out: 1 combination for which a single value was measured.", text)

    def test_a_folder_that_cannot_be_written(self):
        make_sweep(self.folder, Sweep(SHADOWS, pictures=False))
        (self.folder / "report.html").mkdir()
        done = self.run_report(self.folder)
        self.assertEqual(done.returncode, 3)
        self.assertIn("report.html cannot be written", done.stderr)


if __name__ == "__main__":
    unittest.main()
