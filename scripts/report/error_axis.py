"""The axis of errors: logarithmic, with a band of its own for pictures that equal the truth to the last bit."""
from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from .look import BAND, FAINT
from .numeric_axis import log_ticks
from .summaries import Summary

BAND_PT = 30
EQUAL = "equal to the last bit"


@dataclass(frozen=True)
class ErrorAxis:
    """From `bottom` to `top`; the band lies below `low`, its points stand at `equal`. `low` == `bottom`: no band."""
    bottom: float
    low: float
    top: float
    equal: float
    only_band: bool

    def y(self, summary: Summary) -> float:
        return self.equal if summary.accuracy.equal else summary.accuracy.rmse


def error_axis(summaries: Sequence[Summary], height_pt: float) -> ErrorAxis:
    """For panels of that height that show these settings, all of known and sound accuracy."""
    errors = [summary.accuracy.rmse for summary in summaries if not summary.accuracy.equal]
    middle, ratio = (math.sqrt(min(errors) * max(errors)), max(errors) / min(errors)) if errors else (1e-3, 1.0)
    half = math.sqrt(max(ratio * 4, 10))
    low, top = middle / half, middle * half
    if len(errors) == len(summaries):
        return ErrorAxis(low, low, top, low, False)
    per_pt = (top / low) ** (1 / (height_pt - BAND_PT))
    return ErrorAxis(low / per_pt ** BAND_PT, low, top, low / per_pt ** (BAND_PT - 20), not errors)


def draw_error_axis(axes: Axes, scale: ErrorAxis) -> None:
    axes.set_yscale("log")
    axes.set_ylim(scale.bottom, scale.top)
    log_ticks(axes, "y", scale.low, scale.top)
    if scale.only_band:
        axes.yaxis.set_major_locator(NullLocator())
        axes.yaxis.set_minor_locator(NullLocator())
    if scale.bottom < scale.low:
        axes.axhspan(scale.bottom, scale.low, facecolor=BAND, edgecolor="none", zorder=0)
        axes.axhline(scale.low, color=FAINT, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
        axes.annotate(EQUAL, xy=(0, 0), xycoords="axes fraction", xytext=(4, 2.5), textcoords="offset points",
                      fontsize=7.5, color=FAINT, va="bottom")
