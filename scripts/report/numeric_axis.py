"""Axes of a chart that carry numbers."""
from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullFormatter, NullLocator

from .combinations import REFLECTIVE_AXES
from .sweep import Axis

LOG_FROM_RATIO = 30  # largest by smallest: from here on a linear axis would crowd the small ones
UNITS = {"_px": "pixels", "_ms": "ms", "_percent": "%", "_deg": "degrees"}


def label_of(axis: Axis) -> str:
    """With the unit, where the axis has one."""
    if axis.name in REFLECTIVE_AXES:
        return "reflective pixels, measured, %"
    unit = next((unit for ending, unit in UNITS.items() if axis.column.endswith(ending)), "")
    return f"{axis.name}, {unit}" if unit else axis.name


def is_wide(values: Sequence[float]) -> bool:
    """Whether `values` want a logarithmic axis."""
    return min(values) > 0 and max(values) >= LOG_FROM_RATIO * min(values)


def show_values(axes: Axes, values: Sequence[float]) -> None:
    """Scales the x axis for data at `values`; few whole ones become the ticks."""
    distinct = sorted(set(values))
    wide = is_wide(distinct)
    if wide:
        axes.set_xscale("log")
        log_ticks(axes, "x", distinct[0], distinct[-1])
    if len(distinct) <= 8 and all(value == int(value) for value in distinct) and _far_apart(distinct, wide):
        axes.xaxis.set_major_locator(FixedLocator(distinct))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: number_tick(value)))


def log_ticks(axes: Axes, which: str, low: float, high: float) -> None:
    """Ticks of a logarithmic axis, only between `low` and `high`."""
    decades = math.log10(high / low) if high > low else 0.0
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    minor: list[float] = []
    if decades < 0.9:
        major = [step * 10.0 ** exponent for exponent in exponents for step in (1, 1.5, 2, 3, 4, 5, 6, 8)]
        if sum(low <= value <= high for value in major) < 3:
            major = list(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high))
    else:
        steps = (1, 2, 5) if decades < 2.2 else (1,)
        major = [step * 10.0 ** exponent for exponent in exponents for step in steps]
        minor = [step * 10.0 ** exponent for exponent in exponents for step in range(2, 10)] if decades < 6 else []
    target = getattr(axes, f"{which}axis")
    target.set_major_locator(FixedLocator([value for value in major if low <= value <= high] or [low]))
    target.set_minor_locator(FixedLocator([value for value in minor if low <= value <= high and value not in major]))
    target.set_major_formatter(FuncFormatter(lambda value, _: number_tick(value)))
    target.set_minor_formatter(NullFormatter())


def number_tick(value: float) -> str:
    """1024, 20k, 1.5M, 0.05, 1e-5."""
    for size, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= max(size, 1e4) and round(value) % (size / 10) == 0:
            return f"{value / size:.4g}{letter}"
    return f"{value:.0f}" if value >= 1e4 else f"{value:.4g}".replace("e-0", "e-")


def _far_apart(values: Sequence[float], wide: bool) -> bool:
    """Whether ticks at `values` leave room for their numbers."""
    places = [math.log(value) for value in values] if wide else values
    return all(b - a >= 0.055 * (places[-1] - places[0]) for a, b in zip(places, places[1:]))
