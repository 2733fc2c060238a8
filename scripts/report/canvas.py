"""The sheet that a chart is drawn on: title, legend, panels and facts, at distances in inches."""
from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .look import FAINT, plain, shortened

WIDTH = 6.4
LEFT, RIGHT = 0.78, 0.16
TITLE = 0.36
LEGEND_ROW = 0.17
PANEL_TITLE = 0.24
HEADING_LINE = 0.15
MOST_HEADING_LINES = 3
ROW_GAP = 0.16
COLUMN_GAP = 0.4
FACTS_LINE = 0.145
FACTS_CHARACTERS = 112


@dataclass(frozen=True)
class Canvas:
    figure: Figure
    panels: list[Axes]
    facts_height_pt: float


def make_canvas(title: str, facts: str, *, headings: Sequence[str], panel_height: float, below: float = 0.5,
                legend_rows: int = 0, columns: int = 2) -> Canvas:
    """Panels with `headings` (one without needs none), `panel_height` inches high, row by row, with the same y axis along
    a row; `below` each is the room of its x axis."""
    count = len(headings)
    columns = min(columns, count)
    rows = -(-count // columns)
    letters = panel_letters(count)
    wrapped = [textwrap.wrap(shortened(text, MOST_HEADING_LINES * letters - 12), letters, break_on_hyphens=False)
               for text in headings]
    most = max(map(len, wrapped))
    heading = PANEL_TITLE + (most - 1) * HEADING_LINE if most else 0.06
    lines = textwrap.wrap(facts, FACTS_CHARACTERS) or [""]
    facts_height = len(lines) * FACTS_LINE + 0.12
    top = TITLE + legend_rows * LEGEND_ROW
    height = top + rows * (heading + panel_height + below) + (rows - 1) * ROW_GAP + facts_height

    figure = Figure(figsize=(WIDTH, height))
    FigureCanvasAgg(figure)
    figure.text(0.12 / WIDTH, 1 - 0.11 / height, plain(title), va="top", fontsize=12, fontweight="bold")
    figure.text(0.12 / WIDTH, 0.08 / height, plain("\n".join(lines)), va="bottom", fontsize=7.5, color=FAINT,
                linespacing=1.3, gid="facts")

    width = (WIDTH - LEFT - RIGHT - (columns - 1) * COLUMN_GAP) / columns
    panels: list[Axes] = []
    for place, text in enumerate(wrapped):
        row, column = divmod(place, columns)
        y = height - top - heading - panel_height - row * (heading + panel_height + below + ROW_GAP)
        axes = figure.add_axes((
            (LEFT + column * (width + COLUMN_GAP)) / WIDTH, y / height, width / WIDTH, panel_height / height))
        axes.set_title(plain("\n".join(text)), fontsize=9, pad=5)
        if column:
            axes.tick_params(labelleft=False)
        panels.append(axes)
    return Canvas(figure, panels, 72 * facts_height)


def add_legend(canvas: Canvas, handles: Sequence[object], labels: Sequence[str], columns: int) -> None:
    """Under the title, from left to right, row by row; `legend_rows` of the canvas is its room."""
    height = canvas.figure.get_figheight()
    rows = legend_rows(len(labels), columns)
    # Matplotlib fills columns first: deal the entries out so that rows read in order.
    order = [row * columns + column for column in range(columns) for row in range(rows) if row * columns + column < len(labels)]
    canvas.figure.legend([handles[i] for i in order], [plain(labels[i]) for i in order], loc="upper left", ncol=columns,
                         bbox_to_anchor=(0.12 / WIDTH, 1 - (TITLE - 0.02) / height), borderaxespad=0, borderpad=0,
                         columnspacing=1.4, labelspacing=0.3, handlelength=2.4, handletextpad=0.6)


def legend_rows(entries: int, columns: int) -> int:
    return -(-entries // columns)


def legend_columns(labels: Sequence[str]) -> int:
    """As many as fit beside each other."""
    for columns in range(min(5, len(labels)), 1, -1):
        widest = [max(map(len, labels[column::columns])) for column in range(columns)]
        if sum(letters * 5.6 + 42 for letters in widest) < WIDTH * 72 - 10:
            return columns
    return 1


def panel_letters(panels: int) -> int:
    """How many letters of a heading or of ticks fit in a panel's width, where there are two columns of panels."""
    columns = min(2, panels)
    return int((WIDTH - LEFT - RIGHT - (columns - 1) * COLUMN_GAP) / columns * 72 / 5.1)
