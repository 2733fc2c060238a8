"""Colours, markers and line styles: what distinguishes things does so without colour too."""
from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import matplotlib

# Okabe and Ito, Color Universal Design, 2008; in an order in which neighbours differ in lightness too.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999933")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
LINES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (8, 2)))
MOST_LINES = len(COLOURS)

INK = "#222222"
FAINT = "#6B6B6B"
GRID = "#DDDDDD"
BAND = "#EEF3EE"


@contextmanager
def house_look() -> Iterator[None]:
    """Matplotlib's settings for all charts, whatever the user's own are."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update({
            "font.family": ["DejaVu Sans"], "font.size": 10, "axes.labelsize": 10, "axes.titlesize": 10,
            "xtick.labelsize": 9, "ytick.labelsize": 9, "legend.fontsize": 9,
            "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": FAINT, "xtick.color": INK, "ytick.color": INK,
            "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8, "axes.axisbelow": True,
            "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.7, "hatch.linewidth": 0.7,
            "figure.dpi": 72, "legend.frameon": False, "axes.titlelocation": "left",
            "svg.fonttype": "none", "svg.hashsalt": "hybridrt"})
        yield


def line_style(place: int) -> dict[str, object]:
    """For the line with this place among those of a chart."""
    return {"color": COLOURS[place % MOST_LINES], "marker": MARKERS[place % MOST_LINES],
            "linestyle": LINES[place % MOST_LINES], "linewidth": 1.6, "markersize": 5.5}


def plain(text: str) -> str:
    """`text` as Matplotlib shall show it: without mathematics between dollar signs."""
    return text.replace("$", r"\$")


def shortened(text: str, most: int) -> str:
    """At most `most` characters."""
    return text if len(text) <= most else text[:most - 1] + "…"
