"""Videos through pipes: -o - with several frames."""

import itertools
import os
import shutil
import signal
import subprocess
import time
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase, Png

CPU = ("--gl", "off")
HEADER = b"YUV4MPEG2 W96 H72 F25:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n"


def frames_of_y4m(stream, width, height):
    """Rows of 8-bit RGB, three values a pixel: BT.709-6, limited range, in plain numbers."""
    header, _, rest = stream.partition(b"\n")
    frames, size = [], width * height
    while rest:
        assert rest.startswith(b"FRAME\n"), rest[:20]
        y, cb, cr = (rest[6 + plane * size:6 + (plane + 1) * size] for plane in range(3))
        assert len(cr) == size
        rest = rest[6 + 3 * size:]
        rgb = []
        for luma, blue, red in zip(y, cb, cr):
            luma, blue, red = (luma - 16) / 219, (blue - 128) / 224, (red - 128) / 224
            r, b = luma + 1.5748 * red, luma + 1.8556 * blue
            rgb += [255 * r, 255 * (luma - 0.2126 * r - 0.0722 * b) / 0.7152, 255 * b]
        frames.append(rgb)
    return header + b"\n", frames


class PipeTest(CliTestCase):
    def pipe(self, *arguments, code=0):
        done = subprocess.run([BINARY, "render", SCENE, *SMALL, *CPU, "-q", *arguments], cwd=self.folder,
                              capture_output=True, timeout=120)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout

    def pictures(self, *arguments, count):
        self.render(*CPU, *arguments, "-o", "x.####.png")
        return [Png.read(self.path(f"x.{number:04}.png")) for number in range(1, count + 1)]

    def assert_near(self, frame, picture, most):
        expected = list(itertools.chain.from_iterable(picture.rows))
        self.assertEqual(len(frame), len(expected))
        self.assertLessEqual(max(abs(a - b) for a, b in zip(frame, expected)), most)

    def test_y4m_holds_the_pictures_in_order(self):
        pictures = self.pictures("--frames", "4", count=4)
        header, frames = frames_of_y4m(self.pipe("--frames", "4", "-o", "-"), 96, 72)
        self.assertEqual(header, HEADER)
        self.assertEqual(len(frames), 4)
        for frame, picture in zip(frames, pictures):
            self.assert_near(frame, picture, 2)
        self.assertNotEqual(pictures[0].rows, pictures[1].rows)

    def test_rgb24_holds_the_codes(self):
        pictures = self.pictures("--frames", "3", count=3)
        expected = b"".join(bytes(row) for picture in pictures for row in picture.rows)
        self.assertEqual(self.pipe("--frames", "3", "-o", "-", "--pipe", "rgb24"), expected)

    def test_odd_sizes_one_frame_and_rates(self):
        picture = self.pictures("--crop", "3,5,41,33", count=1)[0]
        stream = self.pipe("--crop", "3,5,41,33", "-o", "-", "--pipe", "y4m", "--fps", "30000/1001")
        header, frames = frames_of_y4m(stream, 41, 33)
        self.assertEqual(header, HEADER.replace(b"W96 H72 F25:1", b"W41 H33 F30000:1001"))
        self.assert_near(frames[0], picture, 2)
        for wrong in ("0", "-1", "25/0", "1/2/3", "x", "25/", "1e3", "2000000"):
            self.fail_with(2, "render", SCENE, *SMALL, "-o", "-", "--frames", "2", "--fps=" + wrong, says="--fps")

    def test_what_makes_no_sense(self):
        for wrong, says in ((("-o", "-", "--frames", "2", "--resume"), "-o -"),
                            (("-o", "-", "--frames", "2", "--existing", "refuse"), "-o -"),
                            (("-o", "-", "--frames", "2", "--aov", "id"), "--aov"),
                            (("-o", "-", "--frames", "2", "--json"), "--json"),
                            (("-o", "-", "--frames", "2", "--timings", "-"), "--timings"),
                            (("-o", "-", "--frames", "2", "--alpha"), "--alpha"),
                            (("-o", "-", "--fps", "30"), "--fps"),
                            (("-o", "-", "--pipe", "rgb24", "--fps", "30"), "--fps"),
                            (("-o", "-", "--pipe", "mp4"), "y4m, rgb24"),
                            (("-o", "x.png", "--pipe", "y4m"), "--pipe"),
                            (("-o", "x.png", "--fps", "30"), "--fps"),
                            (("-o", "x.png", "--exr", "half"), "--exr")):
            self.fail_with(2, "render", SCENE, *SMALL, *wrong, says=says)
        self.assertEqual(self.files(), [])

    def test_tables_and_the_contact_sheet_beside_it(self):
        stream = self.pipe("--frames", "3", "-o", "-", "--timings", "t.csv", "--contact-sheet", "sheet.png")
        self.assertEqual(len(frames_of_y4m(stream, 96, 72)[1]), 3)
        self.assertEqual(self.files(), ["sheet.png", "t.csv"])
        self.assertEqual(self.read("t.csv").count(b"\n"), 4)

    def test_a_named_pipe(self):
        os.mkfifo(self.path("f"))
        reader = subprocess.Popen(["cat", "f"], cwd=self.folder, stdout=subprocess.PIPE)
        self.succeed("render", SCENE, *SMALL, *CPU, "-q", "--frames", "2", "-o", "f")
        self.assertEqual(reader.communicate(timeout=60)[0], self.pipe("--frames", "2", "-o", "-"))

    def test_a_reader_that_goes_away_ends_the_run(self):
        for _ in range(5):
            process = self.start("render", SCENE, *SMALL, *CPU, "--frames", "1000000", "-o", "-")
            self.assertEqual(os.read(process.stdout.fileno(), 9), b"YUV4MPEG2")
            process.stdout.close()
            self.assertEqual(process.wait(timeout=60), 5)
            message = process.stderr.read().splitlines()[-1]
            process.stderr.close()
            self.assertRegex(message, "^hybridrt: .*standard output.*Broken pipe")

    def test_a_reader_that_waits_costs_no_memory(self):
        # A frame of 320x240 takes 0.9 MB as floats: 200 of them are 184 MB.
        arguments = [BINARY, "render", SCENE, "--size", "320x240", *CPU, "-q", "--frames", "200", "-o", "-"]
        process = subprocess.Popen(arguments, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(0.2)
        seen, before = -1.0, 0.0
        while seen != before:  # until it renders no more
            before, seen = seen, sum(float(field) for field in self.read(f"/proc/{process.pid}/stat").split()[13:15])
            time.sleep(0.7)
        self.assertIsNone(process.poll(), "it waits")
        peak_kib = int(self.read(f"/proc/{process.pid}/status").split(b"VmHWM:")[1].split()[0])
        self.assertLess(peak_kib, 150 << 10)
        stream, _ = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(len(stream), len(stream.partition(b"\n")[0]) + 1 + 200 * (6 + 3 * 320 * 240))

    def test_a_signal_while_the_reader_waits(self):
        process = self.start("render", SCENE, *SMALL, *CPU, "-q", "--frames", "1000000", "-o", "-")
        time.sleep(2)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=20), 143)
        process.stdout.close()
        process.stderr.close()

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_ffmpeg_reads_it(self):
        pictures = self.pictures("--frames", "3", count=3)
        self.write("x.y4m", "")
        with open(self.path("x.y4m"), "wb") as file:
            file.write(self.pipe("--frames", "3", "-o", "-", "--fps", "24"))
        decode = ["ffmpeg", "-loglevel", "error", "-i", self.path("x.y4m"), "-vf",
                  "scale=in_color_matrix=bt709:in_range=limited:out_range=full:sws_flags=accurate_rnd+full_chroma_int",
                  "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
        done = subprocess.run(decode, capture_output=True, timeout=120)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        size = 3 * 96 * 72
        self.assertEqual(len(done.stdout), 3 * size)
        for number, picture in enumerate(pictures):
            self.assert_near(done.stdout[number * size:(number + 1) * size], picture, 3)
        probe = subprocess.run(["ffprobe", "-loglevel", "error", "-show_entries",
                                "stream=pix_fmt,color_range,r_frame_rate", "-of", "csv=p=0", self.path("x.y4m")],
                               capture_output=True, text=True, timeout=60)
        self.assertEqual(probe.stdout.strip(), "yuv444p,tv,24/1")


if __name__ == "__main__":
    unittest.main()
