"""What accuracy costs: time against error, with the front of the settings that no other beats."""
from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Optional

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from .canvas import add_legend, make_canvas, panel_letters
from .chart import Chart, Point
from .combinations import first_ones, varying
from .error_axis import ErrorAxis, draw_error_axis, error_axis
from .facts_text import facts_text
from .look import FAINT, INK, shortened
from .number_text import error_text, ms_text
from .numeric_axis import log_ticks
from .pareto_front import pareto_front, truth_groups
from .place_labels import Label, place_labels
from .setting_name import heading, short_name
from .summaries import Summary
from .sweep import Axis, Sweep

MOST_PANELS = 6
ON_FRONT = {"marker": "o", "markersize": 7.5, "markerfacecolor": "#D55E00", "markeredgecolor": INK, "markeredgewidth": 0.9}
OFF_FRONT = {"marker": "s", "markersize": 5, "markerfacecolor": "white", "markeredgecolor": "#0072B2", "markeredgewidth": 1.2}
STEP = {"color": "#D55E00", "linewidth": 1.4}
EQUAL_TEXT_BOX = (0.0, 0.0, 92.0, 12.0)


def pareto_chart(sweep: Sweep, summaries: Sequence[Summary]) -> Optional[Chart]:
    """None if no setting's accuracy is known."""
    truth_axes, all_groups = truth_groups(sweep.axes, summaries)
    if not all_groups:
        return None
    groups, notes = first_ones(all_groups, MOST_PANELS, "combinations that change the truth")
    shown = [summary for group in groups.values() for summary in group]
    height = 4.1 if len(groups) == 1 else 2.7
    facts = facts_text(sweep, with_truth=True)
    canvas = make_canvas("Time against error", facts, legend_rows=1, panel_height=height, below=0.5,
                         headings=[heading(truth_axes, key, panel_letters(len(groups))) for key in groups])
    scale = error_axis(shown, 72 * height)
    varied = varying(sweep.axes, shown)
    left_out = 0
    for place, (axes, key) in enumerate(zip(canvas.panels, groups)):
        left_out += _panel(axes, groups[key], [axis for axis in varied if axis not in truth_axes], scale, small=len(groups) > 1)
        if place % 2 == 0:
            axes.set_ylabel("RMSE of display values, 0 to 1")
        axes.set_xlabel("ms a frame")
    handles = [Line2D([], [], linestyle="", **ON_FRONT), Line2D([], [], **STEP), Line2D([], [], linestyle="", **OFF_FRONT)]
    texts = ["on the Pareto front", "the front", "beaten; the table tells its number"]
    kinds = 3 if any(len(pareto_front(group)) < len(group) for group in groups.values()) else 2
    add_legend(canvas, handles[:kinds], texts[:kinds], kinds)
    if left_out:
        notes.append(f"There was no room for {left_out} of the names and numbers; the points' tooltips and the table have "
                     "them.")
    unsound = [str(summary.setting.number) for summary in summaries if summary.accuracy and not summary.accuracy.sound]
    if unsound:
        notes.append("Left out, for pixels that are no numbers or figures that contradict each other: "
                     f"setting {', '.join(unsound)}.")
    return Chart(
        name="pareto", title="Time against error",
        meaning="A point is a setting: the median time of a frame and the error against the truth (root mean square). Down "
                "and to the left is better. On the front are the settings that no other one beats in time or error without "
                "being worse in the other. Where the bars of two settings overlap, which is the faster one is not certain."
                + (" Only settings with the same truth are compared, so there is a panel for each." if truth_axes else ""),
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure, notes=tuple(notes),
        points=tuple(Point(_gid(summary), summary.setting.number, _tooltip(summary)) for summary in shown))


def _panel(axes: Axes, group: Sequence[Summary], named: Sequence[Axis], scale: ErrorAxis, small: bool) -> int:
    """`named`: axes whose values are said. Returns how many numbers found no room."""
    front = pareto_front(group)
    draw_error_axis(axes, scale)
    low, high = min(summary.wall.low for summary in group), max(summary.wall.high for summary in group)
    low, high = low / (high / low * 1.5) ** 0.2, high * (high / low * 1.5) ** 0.12
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    log_ticks(axes, "x", low, high)

    corners: list[tuple[float, float]] = [(front[0].wall.middle, scale.top)]
    for summary in front:
        corners += [(summary.wall.middle, corners[-1][1]), (summary.wall.middle, scale.y(summary))]
    corners.append((high, corners[-1][1]))
    axes.plot(*zip(*corners), **STEP, zorder=2)
    bars = [[(summary.wall.low, scale.y(summary)), (summary.wall.high, scale.y(summary))] for summary in group]
    on_front = {summary.setting.number for summary in front}
    for bar in bars:
        axes.plot(*zip(*bar), color=FAINT, linewidth=1, zorder=2.5)
    for summary in sorted(group, key=lambda summary: summary.setting.number in on_front):
        style = ON_FRONT if summary.setting.number in on_front else OFF_FRONT
        axes.plot([summary.wall.middle], [scale.y(summary)], linestyle="", gid=_gid(summary), zorder=6, **style)

    size, width = (7.5, 26) if small else (8.5, 36)
    labels = [Label(summary.wall.middle, scale.y(summary), _front_text(summary, named, width), size,
                    short=str(summary.setting.number)) for summary in front]
    labels += [Label(summary.wall.middle, scale.y(summary), str(summary.setting.number), 7)
               for summary in group if summary.setting.number not in on_front]
    return place_labels(axes, labels, [EQUAL_TEXT_BOX] if scale.bottom < scale.low else [], [corners, *bars])


def _front_text(summary: Summary, axes: Sequence[Axis], width: int) -> str:
    """`axes`: those whose values a reader needs."""
    text = shortened(f"{summary.setting.number} {short_name(summary, axes)}", 3 * width - 4)
    return "\n".join(textwrap.wrap(text, width, break_on_hyphens=False))


def _tooltip(summary: Summary) -> str:
    return (f"{summary.setting.number}: {summary.setting.label}\n{ms_text(summary.wall.middle)} ms a frame, "
            f"RMSE {error_text(summary.accuracy)}")


def _gid(summary: Summary) -> str:
    return f"point-{summary.setting.number}"
