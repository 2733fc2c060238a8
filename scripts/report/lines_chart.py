"""Charts with a line per combination of axes: scaling, growth, error."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Optional

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from .canvas import Canvas, add_legend, legend_columns, legend_rows, make_canvas
from .combinations import Key, first_ones, grouped, position, varying
from .look import MOST_LINES, line_style, shortened
from .setting_name import heading
from .summaries import Summary
from .sweep import Axis

LEGEND_LETTERS = 40
MOST_LETTERS = 72


def lines_over(axis: Axis, axes: Sequence[Axis], summaries: Sequence[Summary],
               place: Callable[[Axis, Summary], Optional[float]] = position) -> tuple[dict[str, list[Summary]], list[str]]:
    """The settings along `axis`, sorted by `place`, for each combination of the other varied axes that has at least two; by a text
    for the legend ("" if there is one combination only). And notes on what was left out."""
    others = varying([other for other in axes if other is not axis], summaries)
    groups: dict[Key, list[Summary]] = {
        key: sorted(group, key=lambda summary: place(axis, summary))
        for key, group in grouped(summaries, others).items() if len(group) > 1}
    kept, notes = first_ones(groups, MOST_LINES, "combinations of the other axes")
    return {heading(others, key, LEGEND_LETTERS): group for key, group in kept.items()}, notes


def legend_of(names: Sequence[str], extra: Sequence[tuple[Line2D, str]] = ()) -> tuple[list[Line2D], list[str], int]:
    """Handles, labels and columns; a single line needs no legend."""
    handles = [Line2D([], [], **line_style(place)) for place, name in enumerate(names) if name]
    labels = [shortened(name, MOST_LETTERS) for name in names if name]
    handles += [handle for handle, _ in extra]
    labels += [text for _, text in extra]
    return handles, labels, legend_columns(labels)


def lines_canvas(title: str, facts: str, legend: tuple[list[Line2D], list[str], int], heights: Sequence[float]) -> Canvas:
    """One panel below the other."""
    handles, labels, columns = legend
    canvas = make_canvas(title, facts, headings=[""] * len(heights), panel_height=heights[0], columns=1,
                         legend_rows=legend_rows(len(labels), columns))
    if labels:
        add_legend(canvas, handles, labels, columns)
    return canvas


def draw_lines(axes: Axes, groups: Sequence[Sequence[Summary]], x: Callable[[Summary], float],
               y: Callable[[Summary], float]) -> None:
    for place, group in enumerate(groups):
        axes.plot([x(summary) for summary in group], [y(summary) for summary in group], zorder=3, **line_style(place))
