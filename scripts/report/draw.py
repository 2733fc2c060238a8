"""Which charts a sweep has."""
from __future__ import annotations

from collections.abc import Sequence

from .chart import Drawn
from .combinations import varying
from .error_chart import error_chart
from .growth_chart import SIZES, growth_chart
from .look import house_look
from .pareto_chart import pareto_chart
from .passes_chart import passes_chart
from .scaling_chart import scaling_chart
from .summaries import Summary
from .sweep import Sweep


def draw(sweep: Sweep, summaries: Sequence[Summary]) -> Drawn:
    """All charts for which there are figures."""
    drawn = Drawn()
    axes = varying(sweep.axes, summaries)
    with house_look():
        drawn.add(pareto_chart(sweep, summaries))
        for axis in axes:
            drawn.add(passes_chart(sweep, summaries, axis))
            drawn.add(scaling_chart(sweep, summaries, axis) if axis.name == "threads" else None)
            drawn.add(growth_chart(sweep, summaries, axis) if axis.name in SIZES else None)
            drawn.add(error_chart(sweep, summaries, axis))
    if not any(summary.accuracy for summary in summaries):
        drawn.missing.append("No accuracy was measured, so time is not set against error.")
    if summaries and not axes:
        drawn.missing.append("No axis has more than one measured value, so nothing is drawn over an axis.")
    return drawn
