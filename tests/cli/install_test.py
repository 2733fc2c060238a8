"""cmake --install: the installed tree works from another folder, on its own.

    install_test.py CMAKE BUILD_FOLDER SOURCE_FOLDER
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, SOURCE = sys.argv[1:4]
del sys.argv[1:4]


class InstallTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.prefix = os.path.join(cls.folder.name, "prefix")
        cls.elsewhere = os.path.join(cls.folder.name, "elsewhere")
        os.mkdir(cls.elsewhere)
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.prefix, "--strip"], check=True, capture_output=True)
        cls.binary = os.path.join(cls.prefix, "bin", "hybridrt")

    def run_installed(self, *arguments, binary=None):
        environment = {name: os.environ[name] for name in os.environ if not name.startswith(("LD_", "HYBRIDRT_"))}
        done = subprocess.run([binary or self.binary, *arguments], cwd=self.elsewhere, env=environment, capture_output=True,
                              text=True, timeout=250)
        self.assertEqual(done.returncode, 0, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def test_version(self):
        self.assertRegex(self.run_installed("--version"), r"hybridrt \d+\.\d+")

    def test_render(self):
        self.run_installed("render", "scene:spheres,triangles=500", "--size", "64x48", "-o", "first/light.####.png")
        folder = os.path.join(self.elsewhere, "first")
        self.assertEqual(sorted(os.listdir(folder)), ["light.0001.png", "run.json", "timings.csv"])
        self.assertGreater(os.path.getsize(os.path.join(folder, "light.0001.png")), 500)

    def test_moved_elsewhere(self):
        moved = os.path.join(self.folder.name, "moved")
        shutil.copytree(self.prefix, moved)
        for name in ("a.exr", "a.jpg"):
            self.run_installed("render", "scene:spheres,triangles=500", "--size", "64x48", "-q", "-o", "second/" + name)
            self.run_installed("compare", "second/" + name, "second/" + name, binary=os.path.join(moved, "bin", "hybridrt"))

    def test_golden(self):
        share = os.path.join(self.prefix, "share", "hybridrt")
        if not os.path.exists(os.path.join(SOURCE, "golden", "golden.json")):
            self.skipTest("no golden list yet")
        self.assertTrue(os.path.exists(os.path.join(share, "golden", "golden.json")), "the golden list is not installed")
        self.assertIn("as expected", self.run_installed("golden", "check"))

    def test_charts(self):
        self.run_installed("sweep", "scene:spheres,triangles=500", "--size", "64x48", "--over", "shadows=none,exact",
                           "--truth-samples", "1", "--rounds", "1", "-o", "sweep")
        self.assertTrue(os.path.exists(os.path.join(self.prefix, "share", "hybridrt", "report", "__main__.py")))
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True).returncode == 0:
            self.assertIn("report.html", os.listdir(os.path.join(self.elsewhere, "sweep")))

    def test_man_page_and_completion(self):
        with open(os.path.join(self.prefix, "share", "man", "man1", "hybridrt.1"), encoding="utf-8") as file:
            self.assertEqual(file.read(), self.run_installed("help", "--man"))
        with open(os.path.join(self.prefix, "share", "bash-completion", "completions", "hybridrt"),
                  encoding="utf-8") as file:
            self.assertEqual(file.read(), self.run_installed("help", "--bash-completion"))

    def test_knows_no_path_of_the_source(self):
        below = [os.path.join(folder, name) for folder, _, names in os.walk(self.prefix) for name in names]
        modules = [path for path in below if path.endswith(".so")]
        self.assertEqual(len(modules), 1)
        for path in [self.binary, *modules]:
            with open(path, "rb") as file:
                content = file.read()
            for folder in (SOURCE, BUILD):
                self.assertNotIn(os.path.abspath(folder).encode() + b"/", content, path)

    def test_documents(self):
        documents = os.path.join(self.prefix, "share", "doc", "hybridrt")
        for name in ("README.md", "CHANGELOG.md", "LICENSE"):
            if os.path.exists(os.path.join(SOURCE, name)):
                self.assertTrue(os.path.exists(os.path.join(documents, name)), name)


if __name__ == "__main__":
    unittest.main()
