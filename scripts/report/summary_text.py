"""What a sweep found, in plain words."""
from __future__ import annotations

from collections.abc import Sequence

from .combinations import Key, grouped, key_text, varying
from .facts_text import counted
from .look import shortened
from .number_text import error_text, ms_text
from .pareto_front import pareto_front, truth_groups
from .setting_name import short_name
from .summaries import Summary
from .sweep import Axis, Sweep

BUSY = 0.1
MOST_GROUPS = 6
NAME_LETTERS = 80


def summary_sentences(sweep: Sweep, summaries: Sequence[Summary]) -> list[str]:
    """A sentence or a few on what was measured; then, for each scene that was compared, the fastest, the most accurate and
    the front."""
    failed = len(sweep.settings) - len(summaries)
    said = (f"{counted(str(len(sweep.settings)), 'setting')} of {sweep.facts['scene'] or 'a scene'}"
            + (f", of which {failed} failed." if failed else "."))
    if not summaries:
        return [said + " Nothing was measured."]
    scene_axes = varying([axis for axis in sweep.axes if axis.changes_truth], summaries)
    groups = grouped(summaries, scene_axes)
    named = [axis for axis in varying(sweep.axes, summaries) if axis not in scene_axes]
    lines = [f"{_heading(scene_axes, key)}{_findings(group, named)}" for key, group in list(groups.items())[:MOST_GROUPS]]
    if len(groups) > MOST_GROUPS:
        lines.append(f"The other {len(groups) - MOST_GROUPS} combinations are in the table.")
    return [said, *lines]


def warnings_of(sweep: Sweep, summaries: Sequence[Summary]) -> list[str]:
    """What makes the figures less than they seem."""
    said = []
    if sweep.busy > BUSY:
        said.append(f"Others used {100 * sweep.busy:.0f} % of the machine meanwhile: the times are not to be trusted. "
                    "Measure again when it is idle.")
    for summary in summaries:
        if summary.accuracy and not summary.accuracy.sound:
            said.append(f"Setting {summary.setting.number} ({summary.setting.label}) has pixels that are no numbers, or "
                        "figures of accuracy that contradict each other; it is left out where errors are compared.")
    return said


def numbers_on_front(sweep: Sweep, summaries: Sequence[Summary]) -> frozenset[int]:
    _, groups = truth_groups(sweep.axes, summaries)
    return frozenset(summary.setting.number for group in groups.values() for summary in pareto_front(group))


def _heading(axes: Sequence[Axis], key: Key) -> str:
    return f"With {key_text(axes, key)}: " if axes else ""


def _findings(group: Sequence[Summary], axes: Sequence[Axis]) -> str:
    """`axes`: those whose values name a setting."""
    fastest = min(group, key=lambda summary: summary.wall.middle)
    said = [f"The fastest is {_name(fastest, axes)} with {ms_text(fastest.wall.middle)} ms a frame"
            + (f" and an RMSE of {error_text(fastest.accuracy)}." if fastest.accuracy else ".")]
    candidates = [summary for summary in group if summary.accuracy and summary.accuracy.sound]
    if not candidates:
        return " ".join(said)
    best = min(summary.accuracy.rmse for summary in candidates)
    most_accurate = sorted((summary for summary in candidates if summary.accuracy.rmse == best),
                           key=lambda summary: summary.wall.middle)
    equals = most_accurate[0].accuracy.equal
    others = len(most_accurate) - 1
    what = "The fastest of those that equal the truth to the last bit" if equals and others else (
        "Equal to the truth to the last bit" if equals else "The most accurate")
    said.append(f"{what} is {_name(most_accurate[0], axes)} with {ms_text(most_accurate[0].wall.middle)} ms"
                + ("." if equals else f" and an RMSE of {error_text(most_accurate[0].accuracy)}."))
    front = pareto_front(candidates)
    if len(front) > 1:
        said.append(f"On the Pareto front are, from fast to accurate: {', '.join(_name(summary, axes) for summary in front)}.")
    else:
        said.append("No other setting beats it in time or in error.")
    return " ".join(said)


def _name(summary: Summary, axes: Sequence[Axis]) -> str:
    return f"{summary.setting.number} ({shortened(short_name(summary, axes), NAME_LETTERS)})"
