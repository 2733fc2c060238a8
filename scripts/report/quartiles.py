"""Medians, quartiles and means of a few numbers."""
from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Quartiles:
    low: float
    middle: float
    high: float


def quartiles(values: Sequence[float]) -> Quartiles:
    """Of at least one value, interpolated linearly between them (never outside of what was measured)."""
    if len(values) == 1:
        return Quartiles(values[0], values[0], values[0])
    return Quartiles(*statistics.quantiles(values, n=4, method="inclusive"))


def root_mean_square(values: Sequence[float]) -> float:
    return math.sqrt(math.fsum(value * value for value in values) / len(values))
