"""The command: reads DIR/sweep.csv and DIR/sweep.json, writes charts and report.html into DIR."""
from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path

from .output_file import write_atomically
from .read_sweep import read_sweep
from .report_error import ReportError
from .stability import holds_stability, read_stability

WORLD_IS_WRONG = 3


def main(arguments: Sequence[str]) -> int:
    """Prints the names of the files that it wrote; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="report", description="Draws the charts and the page of a sweep: DIR/report.html, DIR/NAME.svg and DIR/NAME.png.")
    parser.add_argument("folder", metavar="DIR", type=Path, help="what `hybridrt sweep` wrote: sweep.csv and sweep.json")
    folder = parser.parse_args(arguments).folder
    try:
        for name in write_report(folder):
            print(folder / name)
    except ReportError as error:
        print(f"report: {error}", file=sys.stderr)
        return WORLD_IS_WRONG
    return 0


def write_report(folder: Path) -> list[str]:
    """The names of the files written, in `folder`. Raises ReportError."""
    if holds_stability(folder):
        return _write_stability_report(folder)
    sweep = read_sweep(folder)
    _require_matplotlib(folder / "sweep.csv")
    from .chart import png_of, svg_of
    from .draw import draw
    from .look import house_look
    from .page import page
    from .summaries import summarize

    summaries = summarize(sweep)
    files: dict[str, bytes] = {}
    with warnings.catch_warnings(), house_look():
        warnings.filterwarnings("ignore", message="Glyph .* missing from")  # the page's reader has other fonts
        drawn = draw(sweep, summaries)
        for chart in drawn.charts:
            files[f"{chart.name}.svg"] = svg_of(chart.figure)
            files[f"{chart.name}.png"] = png_of(chart.figure)
    files["report.html"] = page(sweep, summaries, drawn, files).encode("utf-8")
    return _write_all(folder, files)


def _write_stability_report(folder: Path) -> list[str]:
    stability = read_stability(folder)
    _require_matplotlib(folder / "stability.csv")
    from .chart import png_of, svg_of
    from .look import house_look
    from .stability_chart import stability_chart
    from .stability_page import stability_page

    files: dict[str, bytes] = {}
    with house_look():
        charts = [stability_chart(stability, trial) for trial in stability.trials]
        for chart in charts:
            files[f"{chart.name}.svg"] = svg_of(chart.figure)
            files[f"{chart.name}.png"] = png_of(chart.figure)
    files["report.html"] = stability_page(stability, charts, files).encode("utf-8")
    return _write_all(folder, files)


def _require_matplotlib(figures: Path) -> None:
    try:
        import matplotlib.figure  # noqa: F401, the charts need it
    except ImportError:
        raise ReportError("the charts need Matplotlib, which this Python has not; install python3-matplotlib "
                          f"(Debian, Ubuntu) or run `pip install matplotlib`; the figures are in {figures}") from None


def _write_all(folder: Path, files: dict[str, bytes]) -> list[str]:
    for name, content in files.items():
        write_atomically(folder / name, content)
    return list(files)
