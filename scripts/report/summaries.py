"""A setting's many frames as a few figures."""
from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Optional

from .quartiles import Quartiles, quartiles, root_mean_square
from .sweep import Setting, Sweep

PASSES = ("shadow_map_ms", "id_ms", "mark_ms", "readback_ms", "trace_ms", "upload_ms", "shade_ms", "download_ms")


@dataclass(frozen=True)
class Accuracy:
    """Against the truth. `rmse`: root of the mean square over frames; `ssim` and counts of pixels: means over frames;
    `max_error`: the largest; `non_finite`: pixels of all frames. `equal`: every frame, to the last bit."""
    rmse: float
    psnr_db: float
    ssim: Optional[float]
    max_error: Optional[float]
    pixels_different: Optional[float]
    false_lit: Optional[float]
    false_shadow: Optional[float]
    other_triangle: Optional[float]
    non_finite: float
    equal: bool

    @property
    def sound(self) -> bool:
        """False where a picture holds values that are not numbers, or figures that contradict each other."""
        return math.isfinite(self.rmse) and not self.non_finite and (self.rmse > 0 or self.equal)


@dataclass(frozen=True)
class Summary:
    """Medians over rounds and frames, ms."""
    setting: Setting
    wall: Quartiles
    first_frame_ms: Optional[float]
    load_ms: Optional[float]
    build_ms: Optional[float]
    peak_mib: Optional[float]
    passes: dict[str, float]
    pass_quartiles: dict[str, Quartiles]
    reflective_percent: Optional[float]
    accuracy: Optional[Accuracy]


def summarize(sweep: Sweep) -> list[Summary]:
    """Of the settings that did not fail, in the order of the sweep."""
    return [_summary(setting) for setting in sweep.settings if setting.rows]


def _summary(setting: Setting) -> Summary:
    pixels, reflective = sum(_known(setting, "pixels")), sum(_known(setting, "pixels_reflective"))
    return Summary(
        setting=setting,
        wall=quartiles(_known(setting, "wall_ms")),
        first_frame_ms=_median(setting, "first_frame_ms"),
        load_ms=_median(setting, "load_ms"),
        build_ms=_median(setting, "accel_build_ms"),
        peak_mib=_median(setting, "peak_memory_mib"),
        passes={name: _median(setting, name) or 0.0 for name in PASSES},
        pass_quartiles={name: quartiles(_known(setting, name) or [0.0]) for name in PASSES},
        reflective_percent=100 * reflective / pixels if pixels else None,
        accuracy=_accuracy(setting))


def _accuracy(setting: Setting) -> Optional[Accuracy]:
    errors = _known(setting, "rmse")
    if not errors:
        return None
    rmse = root_mean_square(errors)
    non_finite = sum(_known(setting, "non_finite"))
    differing = _mean(setting, "pixels_different")
    return Accuracy(
        rmse=rmse,
        psnr_db=math.inf if rmse == 0 else -20 * math.log10(rmse),
        ssim=_mean(setting, "ssim"),
        max_error=max(_known(setting, "max_error"), default=None),
        pixels_different=differing,
        false_lit=_mean(setting, "false_lit"),
        false_shadow=_mean(setting, "false_shadow"),
        other_triangle=_mean(setting, "other_triangle"),
        non_finite=non_finite,
        equal=rmse == 0 and not non_finite and not differing)


def _known(setting: Setting, name: str) -> list[float]:
    return [row[name] for row in setting.rows if name in row]


def _median(setting: Setting, name: str) -> Optional[float]:
    values = _known(setting, name)
    return statistics.median(values) if values else None


def _mean(setting: Setting, name: str) -> Optional[float]:
    values = _known(setting, name)
    return math.fsum(values) / len(values) if values else None
