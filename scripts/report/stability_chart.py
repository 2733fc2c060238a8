"""How much of the picture is bad along a trial, and where each method starts to fail."""
from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from .canvas import add_legend, legend_rows, make_canvas
from .chart import Chart, file_name
from .lines_chart import legend_of
from .look import BAND, FAINT, line_style
from .numeric_axis import is_wide, log_ticks, number_tick
from .stability import MEASURES, Contender, Stability, Trial

HEIGHT = 2.6
LEAST, MOST = 1e-3, 100.0  # percent; what is below LEAST stands in the band of none
NONE_AT = 4e-4


def stability_chart(stability: Stability, trial: Trial) -> Chart:
    facts = facts_of(stability, trial)
    groups = _with_equal_lines_joined(trial.contenders)
    handles, labels, columns = legend_of([name for name, _ in groups])
    canvas = make_canvas(trial.title, facts, headings=[""], panel_height=HEIGHT, columns=1,
                         legend_rows=legend_rows(len(labels), columns))
    if labels:
        add_legend(canvas, handles, labels, columns)
    axes = canvas.panels[0]
    place_of = _x_axis(axes, trial)
    for place, (_, contender) in enumerate(groups):
        style = line_style(place)
        xs = [place_of(point.value) for point in contender.points]
        ys = [point.percent_bad if point.percent_bad >= LEAST else NONE_AT for point in contender.points]
        axes.plot(xs, ys, zorder=3, **style)
        if contender.fails_from is not None:
            axes.axvline(place_of(contender.fails_from), color=style["color"], linestyle=style["linestyle"], linewidth=0.9,
                         zorder=2)
    axes.set_yscale("log")
    axes.set_ylim(NONE_AT / 2, 1.3 * max(MOST, *(point.percent_bad for contender in trial.contenders
                                                 for point in contender.points)))
    axes.yaxis.set_major_locator(FixedLocator([NONE_AT, 0.001, 0.01, 0.1, 1, 10, 100, 1000, 10000]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: "none" if value < LEAST else f"{value:g}"))
    axes.axhspan(NONE_AT / 2, LEAST * 0.7, facecolor=BAND, edgecolor="none", zorder=0)
    axes.axhline(stability.most_bad_percent, color=FAINT, linewidth=0.9, linestyle=(0, (4, 2)), zorder=1)
    axes.set_xlabel(f"{trial.parameter}, {trial.unit}" if trial.unit else trial.parameter)
    axes.set_ylabel("bad pixels, %")
    return Chart(
        name=file_name(trial.name), title=trial.title,
        meaning=f"Bad: {MEASURES[trial.measure]}. A method fails above the dashed line, {stability.most_bad_percent:g} %; "
                "upright lines stand where it starts to.",
        facts=facts, facts_height_pt=canvas.facts_height_pt, figure=canvas.figure)


def facts_of(stability: Stability, trial: Trial) -> str:
    facts = stability.facts
    form = "passes on the CPU" if facts["form"] == "cpu" else "passes by OpenGL"
    return (f"{trial.scene}, {facts['width_px']} x {facts['height_px']}; {form}; hybridrt {facts['version']} "
            f"({facts['commit']}); truth: method reference {trial.truth}, in double precision. Bad: {MEASURES[trial.measure]}.")


def _with_equal_lines_joined(contenders: Sequence[Contender]) -> list[tuple[str, Contender]]:
    """Contenders with the same figures are one line with all their names."""
    lines: dict[tuple, list[Contender]] = {}
    for contender in contenders:
        lines.setdefault((contender.points, contender.fails_from), []).append(contender)
    return [(", ".join(contender.name for contender in group), group[0]) for group in lines.values()]


def _x_axis(axes: Axes, trial: Trial):
    """Severe values are on the right. Returns where a value stands; 0 stands a step beyond the smallest."""
    values = sorted({point.value for contender in trial.contenders for point in contender.points})
    sizes = sorted(abs(value) for value in values if value != 0)
    order = [point.value for point in trial.contenders[0].points]
    if not is_wide(sizes):
        axes.set_xlim(_ends(min(values), max(values), order[-1] < order[0]))
        return lambda value: value
    step = 10 ** max(1, round(math.log10(sizes[-1] / sizes[0]) / 8))
    zero = sizes[0] / step
    axes.set_xscale("log")
    low, high = zero if 0 in values else sizes[0], sizes[-1]
    log_ticks(axes, "x", sizes[0], high)
    if 0 in values:
        ticks = [zero, *axes.xaxis.get_major_locator().locs]
        axes.xaxis.set_major_locator(FixedLocator(ticks))
    sign = "-" if values[0] < 0 else ""
    axes.xaxis.set_major_formatter(FuncFormatter(
        lambda value, _: "0" if value <= zero * 1.001 and 0 in values else sign + number_tick(value)))
    falls = abs(order[-1]) < abs(order[0])
    margin = (high / low) ** 0.03
    axes.set_xlim((high * margin, low / margin) if falls else (low / margin, high * margin))
    return lambda value: abs(value) if value else zero


def _ends(low: float, high: float, falls: bool) -> tuple[float, float]:
    margin = 0.03 * (high - low)
    return (high + margin, low - margin) if falls else (low - margin, high + margin)
