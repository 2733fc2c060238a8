"""Shared by the tests of scripts/report: a folder per test, sweeps of a few rows, runs of the command, a reader of pages."""
from __future__ import annotations

import csv
import json
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
REPORT = ROOT / "scripts" / "report"
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True

from report.read_sweep import read_sweep  # noqa: E402
from report.summaries import summarize  # noqa: E402

try:
    import matplotlib.figure  # noqa: F401
    HAS_MATPLOTLIB = True
except ImportError:
    HAS_MATPLOTLIB = False
needs_matplotlib = unittest.skipUnless(HAS_MATPLOTLIB, "this Python has no Matplotlib; install python3-matplotlib")


class ReportTestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, rows, axes=None, settings=None, **facts):
        """A sweep of `rows`, each a dictionary; without axes the settings' numbers are the only axis."""
        axes = axes or [{"name": "kind", "column": "kind", "values": [], "changes_truth": False}]
        numbers = sorted({row["setting"] for row in rows})
        settings = settings or [{"number": number, "label": f"kind={number}"} for number in numbers]
        (self.folder / "sweep.json").write_text(json.dumps({"axes": axes, "settings": settings, **facts}))
        rows = [{"round": 1, "frame": 1, "kind": row["setting"], "error": "", **row} for row in rows]
        header = list(dict.fromkeys(["wall_ms", *(name for row in rows for name in row)]))
        with open(self.folder / "sweep.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, header, restval="")
            writer.writeheader()
            writer.writerows(rows)
        return self.folder

    def summaries(self):
        return summarize(read_sweep(self.folder))

    def run_report(self, *arguments):
        return subprocess.run([sys.executable, str(REPORT), *map(str, arguments)], capture_output=True, text=True,
                              timeout=300, check=False)

    def report(self):
        """The names of the files written, and the page."""
        done = self.run_report(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        names = [Path(line).name for line in done.stdout.splitlines()]
        return names, (self.folder / "report.html").read_text(encoding="utf-8")


class Page(HTMLParser):
    """What a test wants of the page: the table's cells, addresses, ids, tags that are not closed."""
    EMPTY = frozenset(("meta", "link", "img", "br", "hr"))

    def __init__(self, text):
        super().__init__()
        self.rows, self.addresses, self.ids, self.open, self.tags, self.text = [], [], [], [], [], ""
        self._cell = None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        if tag not in self.EMPTY:
            self.open.append(tag)
        for name, value in attributes:
            if name in ("src", "href", "xlink:href", "srcset", "action", "data"):
                self.addresses.append((tag, value))
            if name == "id":
                self.ids.append(value)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self._cell = ""

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.EMPTY:
            self.handle_endtag(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()
        if tag in ("td", "th"):
            self.rows[-1].append(self._cell)
            self._cell = None

    def handle_data(self, data):
        self.text += data
        if self._cell is not None:
            self._cell += data
