"""What a setting is called where there is little room."""
from __future__ import annotations

import re
from collections.abc import Sequence

from .combinations import Key, as_numbers, key_text
from .summaries import Summary
from .sweep import Axis

SAYS_NOTHING = frozenset(("on", "off", "none", "auto", "yes", "no", "true", "false", "default", ""))


def short_name(summary: Summary, axes: Sequence[Axis]) -> str:
    """The values of `axes`, with an axis' name only where its value alone would not say what it is. A label that is more than
    the axes' names and values stays as it is."""
    rest = summary.setting.label
    for name, value in summary.setting.values.items():
        rest = _without_pair(rest, name, value)
    if rest or not axes:
        return summary.setting.label
    return _values_text(axes, [summary.setting.values[axis.name] for axis in axes])


def heading(axes: Sequence[Axis], key: Key, letters: int) -> str:
    """What a group of settings with these values is called: "name=value, ..." if there is room for that."""
    full = key_text(axes, key)
    return full if len(full) <= letters else _values_text(axes, key)


def _values_text(axes: Sequence[Axis], values: Sequence[str]) -> str:
    """Held together by no-break spaces where a name belongs to its value."""
    return ", ".join(f"{axis.name}\N{NO-BREAK SPACE}{value}" if value in SAYS_NOTHING or as_numbers([value]) else value
                     for axis, value in zip(axes, values))


def _without_pair(label: str, name: str, value: str) -> str:
    pair = re.escape(f"{name}={value}")
    return re.sub(rf"(^|[\s,;]+){pair}(?=$|[\s,;])", "", label).strip(" ,;")
