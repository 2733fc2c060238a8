"""Where the time goes: the passes over an axis (the paper's figure 6)."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Optional

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .canvas import add_legend, legend_columns, legend_rows, make_canvas, panel_letters
from .chart import Chart, file_name
from .combinations import REFLECTIVE_AXES, first_ones, grouped, is_numeric, position, values_of, varying
from .facts_text import counted, facts_text
from .look import FAINT, INK, plain, shortened
from .numeric_axis import label_of, show_values
from .setting_name import heading
from .summaries import PASSES, Summary
from .sweep import Axis, Sweep

MOST_PANELS = 6
LEAST_FOR_AREA = 4
TICK_LETTERS = 20

# Passes of the paper in colours, transfers between the processors in greys.
STYLES = {
    "shadow_map_ms": ("#0072B2", ""), "id_ms": ("#56B4E9", "///"), "mark_ms": ("#009E73", "..."),
    "readback_ms": ("#D9D9D9", "xxx"), "trace_ms": ("#D55E00", ""), "upload_ms": ("#B0B0B0", "---"),
    "shade_ms": ("#F0C24B", "\\\\\\"), "download_ms": ("#8C8C8C", "+++")}


def passes_chart(sweep: Sweep, summaries: Sequence[Summary], axis: Axis) -> Optional[Chart]:
    """Over `axis`, a panel per combination of the other axes; None if no pass was timed."""
    used = [name for name in PASSES if any(summary.passes[name] > 0 for summary in summaries)]
    if not used:
        return None
    others = varying([other for other in sweep.axes if other is not axis], summaries)
    every = grouped(summaries, others)
    with_several = {key: group for key, group in every.items() if len(group) > 1} or every
    groups, notes = first_ones(with_several, MOST_PANELS, "combinations of the other axes")
    if len(with_several) < len(every):
        notes.append(f"Left out: {counted(str(len(every) - len(with_several)), 'combination')} for which a single value was "
                     "measured.")
    area = is_numeric(axis, summaries) and len(values_of(axis, summaries)) >= LEAST_FOR_AREA
    shown = [summary for group in groups.values() for summary in group]

    names = pass_names(shown)
    handles = [Patch(facecolor=STYLES[name][0], hatch=STYLES[name][1], edgecolor="white", linewidth=0) for name in used]
    handles.append(Line2D([], [], color=INK, marker="o", markersize=4, linewidth=1.4) if area else
                   Line2D([], [], color=INK, marker="_", markersize=14, markeredgewidth=2, linestyle=""))
    labels = [names[name] for name in used] + ["whole frame"]
    columns = legend_columns(labels)
    facts = facts_text(sweep, with_truth=False)
    texts = [shortened(value, TICK_LETTERS) for value in values_of(axis, shown)]
    slanted = not area and sum(map(len, texts)) + 2 * len(texts) > panel_letters(len(groups))
    canvas = make_canvas(
        f"Time of each pass over {axis.name}", facts,
        headings=[heading(others, key, panel_letters(len(groups))) for key in groups],
        panel_height=3.4 if len(groups) == 1 else 1.9, below=0.5 + slanted * max(map(len, texts)) * 0.035,
        legend_rows=legend_rows(len(labels), columns))
    for axes, group in zip(canvas.panels, groups.values()):
        if area:
            _areas(axes, axis, sorted(group, key=lambda summary: position(axis, summary)), used)
            show_values(axes, [position(axis, summary) for summary in shown])
        else:
            _bars(axes, axis, group, used, values_of(axis, shown), slanted)
        axes.set_xlabel(plain(label_of(axis)))
    highest = max(max(summary.wall.high, sum(summary.passes.values())) for summary in shown)
    for place, axes in enumerate(canvas.panels):
        axes.set_ylim(0, 1.06 * highest)
        axes.grid(axis="x", visible=False)
        if place % 2 == 0:
            axes.set_ylabel("ms a frame")
    add_legend(canvas, handles, labels, columns)
    measured = " The x axis is the share of pixels that was measured." if axis.name in REFLECTIVE_AXES else ""
    return Chart(
        name=file_name("passes", axis.name), title=f"Time of each pass over {axis.name}",
        meaning="Median time of each pass, stacked, and of the whole frame from frame to frame. Where passes of several frames "
                f"run side by side, a frame takes less than their sum.{measured}",
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure, notes=tuple(notes))


def pass_names(summaries: Sequence[Summary]) -> dict[str, str]:
    """As the paper numbers them; what the first one makes depends on the shadows."""
    first = {"light buffer" if summary.setting.shadows in ("exact", "rays") else "shadow map" for summary in summaries}
    return {"shadow_map_ms": "1 " + " or ".join(sorted(first, reverse=True)), "id_ms": "2 triangle ids",
            "mark_ms": "3 marking", "readback_ms": "readback", "trace_ms": "4 rays on the CPU", "upload_ms": "upload",
            "shade_ms": "5 shading", "download_ms": "download"}


def _areas(axes: Axes, axis: Axis, group: Sequence[Summary], used: Sequence[str]) -> None:
    places = [position(axis, summary) for summary in group]
    base = [0.0] * len(group)
    for name in used:
        top = [low + summary.passes[name] for low, summary in zip(base, group)]
        colour, hatch = STYLES[name]
        axes.fill_between(places, base, top, facecolor=colour, hatch=hatch, edgecolor="white", linewidth=0)
        base = top
    axes.vlines(places, 0, base, color="white", linewidth=0.6, alpha=0.8)
    axes.errorbar(places, [summary.wall.middle for summary in group], yerr=_spread(group), color=INK, marker="o", markersize=4,
                  linewidth=1.4, elinewidth=1, capsize=2)
    axes.margins(x=0.02)


def _bars(axes: Axes, axis: Axis, group: Sequence[Summary], used: Sequence[str], values: Sequence[str],
          slanted: bool) -> None:
    by_value = {summary.setting.values[axis.name]: summary for summary in group}
    places = [place for place, value in enumerate(values) if value in by_value]
    members = [by_value[values[place]] for place in places]
    base = [0.0] * len(members)
    for name in used:
        times = [summary.passes[name] for summary in members]
        colour, hatch = STYLES[name]
        axes.bar(places, times, 0.62, bottom=base, facecolor=colour, hatch=hatch, edgecolor="white", linewidth=0)
        base = [low + time for low, time in zip(base, times)]
    axes.errorbar(places, [summary.wall.middle for summary in members], yerr=_spread(members), color=INK, marker="_",
                  markersize=22 if len(values) < 8 else 10, markeredgewidth=2, linestyle="", elinewidth=1, capsize=2)
    for place in set(range(len(values))) - set(places):
        axes.annotate("no figures", xy=(place, 0), xytext=(0, 4), textcoords="offset points", rotation=90, ha="center",
                      va="bottom", fontsize=8, color=FAINT)
    axes.set_xticks(range(len(values)), [plain(shortened(value, TICK_LETTERS)) for value in values],
                    rotation=30 if slanted else 0, ha="right" if slanted else "center", rotation_mode="anchor")
    axes.set_xlim(-0.6, len(values) - 0.4)


def _spread(group: Sequence[Summary]) -> list[list[float]]:
    return [[summary.wall.middle - summary.wall.low for summary in group],
            [summary.wall.high - summary.wall.middle for summary in group]]
