"""One turn of the camera, as a camera path of hybridrt with a key at every frame, so that nobody has to interpolate."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

SEQUENCE = 100  # frames of a whole turn; fewer frames are its beginning


class Turn(NamedTuple):
    """A camera's way; lengths in scene units, y up. Azimuth 0 looks along -z and grows toward +x, as in hybridrt's orbits."""
    target: tuple[float, float, float]
    radius: float
    height: float  # of the eye above the target
    from_deg: float
    fov_y_deg: float
    outward: bool = False  # the eye stands at `target` and looks to where it would otherwise stand


def camera_path(turn: Turn) -> dict:
    """A camera path JSON with SEQUENCE keys."""
    keyframes = []
    for i in range(SEQUENCE):
        azimuth = math.radians(turn.from_deg + 360 * i / SEQUENCE)
        on_circle = [turn.target[0] + turn.radius * math.sin(azimuth), turn.target[1] + turn.height,
                     turn.target[2] + turn.radius * math.cos(azimuth)]
        eye, target = (list(turn.target), on_circle) if turn.outward else (on_circle, list(turn.target))
        keyframes.append({"frame": i + 1, "eye": eye, "target": target, "up": [0, 1, 0], "fov_y_deg": turn.fov_y_deg})
    return {"keyframes": keyframes}


class View(NamedTuple):
    """A camera's axes in world space, unit vectors of a right-handed system: right x up = backward = -forward."""
    eye: list[float]
    right: list[float]
    up: list[float]
    forward: list[float]
    fov_y_deg: float


def views_of(path: dict) -> list[View]:
    """The view of each key of a camera path JSON."""
    views = []
    for key in path["keyframes"]:
        forward = unit([t - e for t, e in zip(key["target"], key["eye"])])
        right = unit(cross(forward, key["up"]))
        views.append(View(key["eye"], right, cross(right, forward), forward, key["fov_y_deg"]))
    return views


def unit(v: Sequence[float]) -> list[float]:
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a: Sequence[float], b: Sequence[float]) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
