"""Figures as texts."""
from __future__ import annotations

import math
from typing import Optional

from .summaries import Accuracy

UNKNOWN = "–"


def ms_text(value: Optional[float]) -> str:
    """At least three digits: 0.042, 1.23, 45.6, 1234."""
    if value is None:
        return UNKNOWN
    if value == 0:
        return "0"
    return f"{value:.{max(0, 2 - math.floor(math.log10(abs(value))))}f}" if abs(value) >= 0.001 else f"{value:.2e}"


def error_text(accuracy: Accuracy) -> str:
    """The RMSE, or that there is none."""
    return "0, equal to the last bit" if accuracy.equal else small_text(accuracy.rmse)


def small_text(value: Optional[float]) -> str:
    """Three digits: 0.0123, 1.23e-06."""
    return UNKNOWN if value is None else f"{value:.3g}"


def decibel_text(value: float) -> str:
    return "equal" if value == math.inf else f"{value:.1f}"


def similarity_text(value: Optional[float]) -> str:
    """Never rounded up to 1."""
    if value is None:
        return UNKNOWN
    return "1" if value == 1 else f"{min(value, 0.99999):.5f}"


def count_text(value: Optional[float]) -> str:
    """A mean number of pixels; whole where it is."""
    if value is None:
        return UNKNOWN
    return f"{value:.0f}" if value == round(value) or value >= 100 else f"{value:.1f}"
