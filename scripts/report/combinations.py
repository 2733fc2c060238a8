"""Settings grouped by the values of axes."""
from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Optional

from .summaries import Summary
from .sweep import Axis

Key = tuple[str, ...]

REFLECTIVE_AXES = ("reflection-percent", "reflective")


def values_of(axis: Axis, summaries: Iterable[Summary]) -> list[str]:
    """The axis' values that were measured, in the order in which they were asked for."""
    present = dict.fromkeys(summary.setting.values[axis.name] for summary in summaries)
    return [value for value in axis.values if value in present] + [value for value in present if value not in axis.values]


def varying(axes: Iterable[Axis], summaries: Sequence[Summary]) -> list[Axis]:
    """The axes with more than one measured value."""
    return [axis for axis in axes if len(values_of(axis, summaries)) > 1]


def grouped(summaries: Sequence[Summary], axes: Sequence[Axis]) -> dict[Key, list[Summary]]:
    """By the values of `axes`, in the axes' order; without axes one group with an empty key."""
    orders = [{value: place for place, value in enumerate(values_of(axis, summaries))} for axis in axes]
    groups: dict[Key, list[Summary]] = {}
    for summary in summaries:
        groups.setdefault(tuple(summary.setting.values[axis.name] for axis in axes), []).append(summary)
    return dict(sorted(groups.items(), key=lambda item: [order[value] for order, value in zip(orders, item[0])]))


def key_text(axes: Sequence[Axis], key: Key) -> str:
    """"name=value, name=value"."""
    return ", ".join(f"{axis.name}={value}" for axis, value in zip(axes, key))


def first_ones(groups: dict[Key, list[Summary]], most: int, what: str) -> tuple[dict[Key, list[Summary]], list[str]]:
    """At most the first `most` groups, and a note if that leaves some out. `what` names the groups in the note."""
    if len(groups) <= most:
        return groups, []
    return dict(list(groups.items())[:most]), [f"The first {most} of {len(groups)} {what} are drawn; the table and sweep.csv "
                                              "have them all."]


def as_numbers(values: Iterable[str]) -> Optional[list[float]]:
    """All of `values` as finite numbers, or None."""
    try:
        numbers = [float(value) for value in values]
    except ValueError:
        return None
    return numbers if all(map(math.isfinite, numbers)) else None


def is_numeric(axis: Axis, summaries: Sequence[Summary]) -> bool:
    return as_numbers(values_of(axis, summaries)) is not None


def position(axis: Axis, summary: Summary) -> float:
    """Where a setting stands on a numeric axis; for an axis of mirrors the share of pixels that was measured, percent."""
    if axis.name in REFLECTIVE_AXES and summary.reflective_percent is not None:
        return summary.reflective_percent
    return float(summary.setting.values[axis.name])
