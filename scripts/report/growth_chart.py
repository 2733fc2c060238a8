"""How time grows with triangles, and whether the bottleneck moves (the open question of the paper's section 5.2)."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Optional

from .chart import Chart
from .combinations import is_numeric
from .facts_text import facts_text
from .lines_chart import draw_lines, legend_of, lines_canvas, lines_over
from .look import COLOURS, FAINT, MOST_LINES
from .numeric_axis import log_ticks
from .summaries import Summary
from .sweep import Axis, Sweep

GPU_PASSES = ("shadow_map_ms", "id_ms", "mark_ms", "shade_ms")


def growth_chart(sweep: Sweep, summaries: Sequence[Summary], axis: Axis) -> Optional[Chart]:
    """Over the axis of triangles; None if nothing was measured with at least two numbers of triangles."""
    if not is_numeric(axis, summaries):
        return None
    lines, notes = lines_over(axis, sweep.axes, summaries)
    if not lines or min(_triangles(axis, group[0]) for group in lines.values()) <= 0:
        return None
    facts = facts_text(sweep, with_truth=False)
    shares = any(gpu_share_percent(summary) is not None for group in lines.values() for summary in group)
    canvas = lines_canvas("Time over triangles", facts, legend_of(list(lines)), [2.9] * (2 if shares else 1))
    time, *rest = canvas.panels
    for place, group in enumerate(lines.values()):
        places = [_triangles(axis, summary) for summary in group]
        time.fill_between(places, [summary.wall.low for summary in group], [summary.wall.high for summary in group],
                          color=COLOURS[place % MOST_LINES], alpha=0.2, linewidth=0)
    draw_lines(time, list(lines.values()), lambda summary: _triangles(axis, summary), lambda summary: summary.wall.middle)
    time.set_yscale("log")
    time.set_ylabel("ms a frame")
    log_ticks(time, "y", *time.get_ylim())
    for share in rest:
        known = [[summary for summary in group if gpu_share_percent(summary) is not None] for group in lines.values()]
        draw_lines(share, known, lambda summary: _triangles(axis, summary), gpu_share_percent)
        share.axhline(50, color=FAINT, linewidth=1, linestyle=(0, (4, 2)))
        share.set_ylim(0, 100)
        share.set_ylabel("passes 1, 2, 3, 5: share, %")
    every = [_triangles(axis, summary) for group in lines.values() for summary in group]
    for axes in canvas.panels:
        axes.set_xscale("log")
        log_ticks(axes, "x", min(every), max(every))
        axes.set_xlabel("triangles")
    return Chart(
        name="growth", title="Time over triangles",
        meaning="Above: the median time of a frame, with a band from the first to the third quartile; both axes are "
                "logarithmic. Below: the share of the passes that the paper gives to the GPU (1, 2, 3 and 5) in the time of "
                "these and pass 4, the rays. Over the dashed line they take longer than the rays: the bottleneck has moved.",
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure, notes=tuple(notes))


def gpu_share_percent(summary: Summary) -> Optional[float]:
    """Of the time of passes 1 to 5, without transfers; None if no pass was timed."""
    raster = sum(summary.passes[name] for name in GPU_PASSES)
    whole = raster + summary.passes["trace_ms"]
    return 100 * raster / whole if whole else None


def _triangles(axis: Axis, summary: Summary) -> float:
    return float(summary.setting.values[axis.name])
