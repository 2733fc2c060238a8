"""What more threads gain (the paper's figure 7, as speed-up)."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Optional

from matplotlib.lines import Line2D

from .chart import Chart
from .combinations import is_numeric
from .facts_text import facts_text
from .lines_chart import legend_of, lines_canvas, lines_over
from .look import FAINT, line_style
from .numeric_axis import show_values
from .summaries import Summary
from .sweep import Axis, Sweep

IDEAL = {"color": FAINT, "linewidth": 1.2, "linestyle": (0, (2, 2))}


def scaling_chart(sweep: Sweep, summaries: Sequence[Summary], axis: Axis) -> Optional[Chart]:
    """Over the axis of threads; None if nothing was measured with at least two numbers of threads."""
    if not is_numeric(axis, summaries):
        return None
    base = min(_threads(axis, summary) for summary in summaries)
    lines, notes = lines_over(axis, sweep.axes, summaries)
    without_base = [name for name, group in lines.items() if _threads(axis, group[0]) != base]
    lines = {name: group for name, group in lines.items() if name not in without_base}
    notes += [f"Left out, for it was not measured with {base:g}: {name}." for name in without_base]
    if not lines:
        return None
    facts = facts_text(sweep, with_truth=False)
    canvas = lines_canvas("Speed-up by threads", facts, legend_of(list(lines), [(Line2D([], [], **IDEAL), "ideal")]), [3.6])
    axes = canvas.panels[0]
    counts = sorted({_threads(axis, summary) for group in lines.values() for summary in group})
    axes.plot([base, counts[-1]], [1, counts[-1] / base], **IDEAL)
    for place, group in enumerate(lines.values()):
        first = group[0].wall.middle
        middles = [first / summary.wall.middle for summary in group]
        spread = [[middle - first / summary.wall.high for middle, summary in zip(middles, group)],
                  [first / summary.wall.low - middle for middle, summary in zip(middles, group)]]
        axes.errorbar([_threads(axis, summary) for summary in group], middles, yerr=spread, capsize=2.5, elinewidth=1,
                      zorder=3, **line_style(place))
    show_values(axes, counts)
    axes.set_xlabel("threads")
    axes.set_ylabel(f"speed-up over {base:g} thread{'' if base == 1 else 's'}")
    axes.set_ylim(bottom=0)
    return Chart(
        name="scaling", title="Speed-up by threads",
        meaning="The median time of a frame with the fewest threads, divided by that with more. The dashed line is what the "
                "threads would gain if nothing held them up.",
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure, notes=tuple(notes))


def _threads(axis: Axis, summary: Summary) -> float:
    return float(summary.setting.values[axis.name])
