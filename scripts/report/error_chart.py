"""How the error depends on a numeric axis."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Optional

from .chart import Chart, file_name
from .combinations import REFLECTIVE_AXES, is_numeric, position, values_of
from .error_axis import draw_error_axis, error_axis
from .facts_text import facts_text
from .lines_chart import draw_lines, legend_of, lines_canvas, lines_over
from .numeric_axis import label_of, show_values
from .pareto_front import comparable
from .summaries import Summary
from .sweep import Axis, Sweep

LEAST_VALUES = 3
HEIGHT = 3.4


def error_chart(sweep: Sweep, summaries: Sequence[Summary], axis: Axis) -> Optional[Chart]:
    """Over `axis`; None if that is not numeric, or has fewer than three values of known accuracy."""
    candidates = comparable(summaries)
    if not is_numeric(axis, candidates) or len(values_of(axis, candidates)) < LEAST_VALUES:
        return None
    lines, notes = lines_over(axis, sweep.axes, candidates)
    shown = [summary for group in lines.values() for summary in group]
    if not shown:
        return None
    facts = facts_text(sweep, with_truth=True)
    canvas = lines_canvas(f"Error over {axis.name}", facts, legend_of(list(lines)), [HEIGHT])
    axes = canvas.panels[0]
    scale = error_axis(shown, 72 * HEIGHT)
    draw_lines(axes, list(lines.values()), lambda summary: position(axis, summary), scale.y)
    draw_error_axis(axes, scale)
    show_values(axes, [position(axis, summary) for summary in shown])
    axes.set_xlabel(label_of(axis))
    axes.set_ylabel("RMSE of display values, 0 to 1")
    measured = " The x axis is the share of pixels that was measured." if axis.name in REFLECTIVE_AXES else ""
    other_truths = " Where a value changes the truth, each is compared with its own." if axis.changes_truth else ""
    return Chart(
        name=file_name("error", axis.name), title=f"Error over {axis.name}",
        meaning=f"The error against the truth (root mean square), on a logarithmic axis.{measured}{other_truths}",
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure, notes=tuple(notes))
