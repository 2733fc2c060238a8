"""What a sweep is, as plain values."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Optional

TIMES = ("wall_ms", "first_frame_ms", "load_ms", "accel_build_ms", "shadow_map_ms", "id_ms", "mark_ms", "readback_ms",
         "trace_ms", "upload_ms", "shade_ms", "download_ms")
COUNTS = ("peak_memory_mib", "pixels", "pixels_reflective")
ACCURACY = ("rmse", "psnr_db", "max_error", "ssim", "pixels_different", "false_lit", "false_shadow", "other_triangle",
            "non_finite")


@dataclass(frozen=True)
class Axis:
    """What was varied. `column` is its column in sweep.csv; `values` are texts, in the order given."""
    name: str
    column: str
    values: tuple[str, ...]
    changes_truth: bool


@dataclass(frozen=True)
class Truth:
    """What the pictures are compared with. `kind`: reference, folder or none."""
    method: str
    samples: int
    kind: str
    note: str


@dataclass(frozen=True)
class Setting:
    """One point of the sweep. `values` has a text per axis name; `rows` the known figures of each frame of each round;
    a setting with `errors` has no figures. Pictures are paths relative to the sweep's folder, or None."""
    number: int
    label: str
    values: dict[str, str]
    shadows: str
    rows: tuple[dict[str, float], ...]
    errors: tuple[str, ...]
    picture: Optional[str]
    difference: Optional[str]
    truth: Optional[str]
    amplification: float


@dataclass(frozen=True)
class Sweep:
    """`facts` are version, commit and the like, as texts; `busy` is the share of the machine that others used."""
    folder: Path
    facts: dict[str, str]
    gl_renderer: Optional[str]
    busy: float
    truth: Truth
    axes: tuple[Axis, ...]
    settings: tuple[Setting, ...]
