"""How time, loading and memory grow with triangles or pixels, and whether the bottleneck moves (the open question of the
paper's section 5.2)."""
from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import NamedTuple, Optional

from matplotlib.axes import Axes

from .chart import Chart
from .facts_text import facts_text
from .lines_chart import draw_lines, legend_of, lines_canvas, lines_over
from .look import COLOURS, FAINT, MOST_LINES
from .numeric_axis import log_ticks
from .summaries import Summary
from .sweep import Axis, Sweep

GPU_PASSES = ("shadow_map_ms", "id_ms", "mark_ms", "shade_ms")
SIZES = ("triangles", "size")  # axes that have this chart
Value = Callable[[Summary], Optional[float]]


class Panel(NamedTuple):
    """Below the first, which has the times of frames."""
    label: str
    value: Value
    meaning: str
    is_share: bool = False


def growth_chart(sweep: Sweep, summaries: Sequence[Summary], axis: Axis) -> Optional[Chart]:
    """Over the axis of triangles, or of the picture's size; None if nothing was measured with at least two of them."""
    thing = "triangle" if axis.name == "triangles" else "pixel"
    if any((size_of(axis, summary) or 0) <= 0 for summary in summaries):
        return None
    lines, notes = lines_over(axis, sweep.axes, summaries, size_of)
    if not lines:
        return None
    groups = list(lines.values())
    facts = facts_text(sweep, with_truth=False)
    panels = [panel for panel in panels_for(axis, thing)
              if any(panel.value(summary) is not None for group in groups for summary in group)]
    canvas = lines_canvas(f"Time over {thing}s", facts, legend_of(list(lines)), [2.9] * (1 + len(panels)))
    time, *rest = canvas.panels
    for place, group in enumerate(groups):
        places = [size_of(axis, summary) for summary in group]
        time.fill_between(places, [summary.wall.low for summary in group], [summary.wall.high for summary in group],
                          color=COLOURS[place % MOST_LINES], alpha=0.2, linewidth=0)
    draw_lines(time, groups, lambda summary: size_of(axis, summary), lambda summary: summary.wall.middle)
    log_scale(time, "ms a frame")
    for axes, panel in zip(rest, panels):
        known = [[summary for summary in group if panel.value(summary) is not None] for group in groups]
        draw_lines(axes, known, lambda summary: size_of(axis, summary), panel.value)
        if panel.is_share:
            axes.axhline(50, color=FAINT, linewidth=1, linestyle=(0, (4, 2)))
            axes.set_ylim(0, 100)
            axes.set_ylabel(panel.label)
        else:
            log_scale(axes, panel.label)
    every = [size_of(axis, summary) for group in groups for summary in group]
    for axes in canvas.panels:
        axes.set_xscale("log")
        log_ticks(axes, "x", min(every), max(every))
        axes.set_xlabel(f"{thing}s")
    return Chart(
        name="growth" if axis.name == "triangles" else f"growth-{axis.name}", title=f"Time over {thing}s",
        meaning=" ".join(["Above: the median time of a frame, with a band from the first to the third quartile; axes are "
                          "logarithmic.", *(panel.meaning for panel in panels)]),
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure, notes=tuple(notes))


def panels_for(axis: Axis, thing: str) -> list[Panel]:
    def peak_bytes(summary: Summary) -> Optional[float]:
        return summary.peak_mib * 2**20 / size_of(axis, summary) if summary.peak_mib else None

    def loading_ms(summary: Summary) -> Optional[float]:
        whole = (summary.load_ms or 0) + (summary.build_ms or 0)
        return whole if whole > 0 else None

    panels = [Panel("passes 1, 2, 3, 5: share, %", gpu_share_percent,
                    "Then: the share of the passes that the paper gives to the GPU (1, 2, 3 and 5) in the time of these and "
                    "pass 4, the rays. Over the dashed line they take longer than the rays: the bottleneck has moved.", True)]
    if axis.name == "triangles":
        panels.append(Panel("loading and building, ms", loading_ms,
                            "Then: reading or making the scene, and building the structure for rays."))
    panels.append(Panel(f"peak memory, bytes a {thing}", peak_bytes,
                        f"Then: the most memory that the process held, by {thing}: on the left what it holds in any case, on "
                        f"the right what a {thing} takes."))
    return panels


def log_scale(axes: Axes, label: str) -> None:
    axes.set_yscale("log")
    axes.set_ylabel(label)
    log_ticks(axes, "y", *axes.get_ylim())


def gpu_share_percent(summary: Summary) -> Optional[float]:
    """Of the time of passes 1 to 5, without transfers; None if no pass was timed."""
    raster = sum(summary.passes[name] for name in GPU_PASSES)
    whole = raster + summary.passes["trace_ms"]
    return 100 * raster / whole if whole else None


def size_of(axis: Axis, summary: Summary) -> Optional[float]:
    """Triangles, or the picture's pixels; None for a text that is no such number."""
    text = summary.setting.values[axis.name]
    sides = re.fullmatch(r"(\d+)x(\d+)", text)
    if sides:
        return float(sides[1]) * float(sides[2])
    try:
        return float(text)
    except ValueError:
        return None
