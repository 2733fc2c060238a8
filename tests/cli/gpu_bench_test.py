"""scripts/gpu_bench.sh: the pack needs nothing of this machine but C, C++ and GL, and its run.sh measures a software GL.

Called with the binary, which lies in BUILD/bin, and the project's folder.
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BINARY = Path(os.path.abspath(sys.argv.pop(1)))
ROOT = Path(os.path.abspath(sys.argv.pop(1)))
OF_ANY_MACHINE = r"(linux-vdso|ld-linux|libc|libm|libstdc\+\+|libgcc_s)[.-]"


def has_gl():
    doctor = subprocess.run([BINARY, "doctor"], capture_output=True, text=True)
    return "egl:" in doctor.stdout or "EGL" in doctor.stdout


class GpuBenchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.pack = cls.folder / "gpu_bench"
        done = subprocess.run([ROOT / "scripts/gpu_bench.sh", cls.pack], env=dict(os.environ, BUILD=str(BINARY.parent.parent)),
                              capture_output=True, text=True, timeout=200)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_pack(self, *arguments, **changes):
        return subprocess.run([self.pack / "run.sh", "-o", self.folder / "gpu.md", *arguments], cwd=self.folder,
                              env=dict(os.environ, **changes), capture_output=True, text=True, timeout=250)

    def test_it_brings_its_libraries(self):
        listed = subprocess.run(["ldd", self.pack / "bin/hybridrt"], capture_output=True, text=True,
                                env=dict(os.environ, LD_LIBRARY_PATH=str(self.pack / "lib/hybridrt"))).stdout
        foreign = [line for line in listed.splitlines()
                   if str(self.pack) not in line and not re.match(OF_ANY_MACHINE, os.path.basename(line.split()[0]))]
        self.assertEqual(foreign, [])
        self.assertIn("libembree3", listed)
        self.assertNotIn("OpenImageIO", listed)
        self.assertTrue(Path(f"{self.pack}.tar.gz").exists())

    def test_what_is_not_known_is_told(self):
        done = self.run_pack("--sise", "1x1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--sise: not known", done.stderr)

    @unittest.skipUnless(has_gl(), "no OpenGL here")
    def test_a_software_gl_is_checked_and_timed(self):
        done = self.run_pack("--software", "--frames", "3", "--sizes", "10k", "--scenes", "chess", "--size", "96x72")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        table = (self.folder / "gpu.md").read_text()
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line.startswith("| chess")]
        self.assertEqual([row[:3] for row in rows], [["chess, 10k", f"`{s}`", form] for s in ("exact", "blur") for form in ("gl", "cpu")])
        self.assertGreater(float(rows[0][4]), 0)  # ids, ms
        self.assertTrue(rows[0][-1] == "inf" or float(rows[0][-1]) >= 60, rows[0])
        self.assertRegex(table, r"(\d+) of \1 as expected")

    @unittest.skipUnless(has_gl(), "no OpenGL here")
    def test_a_picture_that_differs_fails(self):
        """A compare that says so stands for a GPU that draws another picture."""
        real, fake = self.pack / "bin/hybridrt", self.folder / "real"
        real.rename(fake)
        try:
            real.write_text(f'#!/bin/sh\n[ "$1" != compare ] || {{ echo \'{{"psnr_db":41.5,\'; exit 6; }}\nexec {fake} "$@"\n')
            real.chmod(0o755)
            done = self.run_pack("--software", "--frames", "3", "--sizes", "10k", "--scenes", "spheres", "--size", "32x24")
        finally:
            fake.rename(real)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertIn("**41.5**, **other ids**", (self.folder / "gpu.md").read_text())


if __name__ == "__main__":
    unittest.main()
