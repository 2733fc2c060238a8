"""Which settings no other beats in both time and error."""
from __future__ import annotations

from collections.abc import Sequence

from .combinations import Key, grouped, varying
from .summaries import Summary
from .sweep import Axis


def comparable(summaries: Sequence[Summary]) -> list[Summary]:
    """Those whose accuracy is known and sound."""
    return [summary for summary in summaries if summary.accuracy and summary.accuracy.sound]


def pareto_front(summaries: Sequence[Summary]) -> list[Summary]:
    """Of comparable settings, the fastest first: those that no other one beats in median time or rmse without being worse
    in the other. Ties stay."""
    front = [mine for mine in summaries if not any(_beats(other, mine) for other in summaries)]
    return sorted(front, key=lambda summary: (summary.wall.middle, summary.accuracy.rmse, summary.setting.number))


def truth_groups(axes: Sequence[Axis], summaries: Sequence[Summary]) -> tuple[list[Axis], dict[Key, list[Summary]]]:
    """The varied axes that change the truth, and comparable settings grouped by them: only within a group do settings
    render the same picture."""
    candidates = comparable(summaries)
    truth_axes = varying([axis for axis in axes if axis.changes_truth], candidates)
    return truth_axes, grouped(candidates, truth_axes)


def _beats(mine: Summary, other: Summary) -> bool:
    ours, theirs = (mine.wall.middle, mine.accuracy.rmse), (other.wall.middle, other.accuracy.rmse)
    return ours[0] <= theirs[0] and ours[1] <= theirs[1] and ours != theirs
