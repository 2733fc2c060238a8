"""Texts beside points, so that no text covers another or a point. Greedy: each takes the best place still free."""
from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes

from .look import FAINT, INK, plain

Box = tuple[float, float, float, float]  # left, bottom, right, top, in points of the sheet
Spot = tuple[float, float]

DIRECTIONS = 16
LEADER_FROM_PT = 13
POINT_PT = 5.0
GAP_PT = 2.5
DISTANCES = (7, 10, 16, 24, 34, 46, 60, 80, 105, 140, 180, 230)
NEAR_DISTANCES = (6, 8, 11)

# What a place costs, as if it were that many points farther away. What costs COVERS is no place.
COVERS, LEADER_COVERS, ON_LINE = 500, 100, 60


@dataclass(frozen=True)
class Label:
    """`text` at the data's `x`, `y`; where it finds no room, `short` (if there is one), else none."""
    x: float
    y: float
    text: str
    size_pt: float
    short: str = ""


def place_labels(axes: Axes, labels: Sequence[Label], taken: Sequence[Box], avoid: Sequence[Sequence[Spot]]) -> int:
    """Draws them, the first ones first; returns how many found no room for their text. `taken`: boxes in the panel, in points,
    that are no place for a text; `avoid`: lines, as points in the data's units, that texts had better not cover. The axes'
    limits must be final."""
    panel = axes.get_window_extent()
    transform = axes.transData.transform
    marks = [tuple(transform((label.x, label.y))) for label in labels]
    lines = [[tuple(transform(point)) for point in line] for line in avoid]
    surroundings = Surroundings(
        bounds=(panel.x0, panel.y0, panel.x1, panel.y1),
        boxes=[(x - POINT_PT, y - POINT_PT, x + POINT_PT, y + POINT_PT) for x, y in marks]
        + [(left + panel.x0, bottom + panel.y0, right + panel.x0, top + panel.y0) for left, bottom, right, top in taken],
        segments=[segment for line in lines for segment in zip(line, line[1:])])
    without_room = 0
    for label, mark in zip(labels, marks):
        drawn = _place(axes, label, label.text, mark, surroundings)
        without_room += not drawn
        if not drawn and label.short:
            _place(axes, label, label.short, mark, surroundings)
    return without_room


@dataclass(frozen=True)
class Surroundings:
    """What a text must stay within, must not cover, and had better not cross; in points of the sheet."""
    bounds: Box
    boxes: list[Box]
    segments: list[tuple[Spot, Spot]]


def _place(axes: Axes, label: Label, text: str, mark: Spot, around: Surroundings) -> bool:
    """Draws `text` and adds it to what is around; does nothing if there is no room."""
    width, height = _size(axes, text, label.size_pt)
    best, cost = None, float(COVERS)
    for place in _candidates(mark, width, height, DISTANCES if label.short else NEAR_DISTANCES):
        here = _cost(place, mark, around, cost)
        if here < cost:
            best, cost = place, here
    if best is None:
        return False
    around.boxes.append(best)
    around.segments.append((mark, _nearest(best, mark)))
    _draw(axes, label, text, mark, best)
    return True


def _size(axes: Axes, content: str, size_pt: float) -> tuple[float, float]:
    text = axes.text(0, 0, plain(content), fontsize=size_pt)
    extent = text.get_window_extent()
    text.remove()
    return extent.width, extent.height


def _candidates(mark: Spot, width: float, height: float, distances: Sequence[float]) -> Iterator[Box]:
    for distance in distances:
        for step in range(DIRECTIONS):
            angle = 2 * math.pi * (step + 1) / DIRECTIONS
            x, y = mark[0] + distance * math.cos(angle), mark[1] + distance * math.sin(angle)
            left = x - width * (0.5 - 0.5 * math.cos(angle))
            bottom = y - height * (0.5 - 0.5 * math.sin(angle))
            yield left, bottom, left + width, bottom + height


def _cost(place: Box, mark: Spot, around: Surroundings, limit: float) -> float:
    """`limit` or more as soon as it cannot be less."""
    left, bottom, right, top = place
    if left < around.bounds[0] or bottom < around.bounds[1] or right > around.bounds[2] or top > around.bounds[3]:
        return limit
    nearest = _nearest(place, mark)
    cost = math.dist(nearest, mark)
    wide = (left - GAP_PT, bottom - GAP_PT, right + GAP_PT, top + GAP_PT)
    if cost >= limit or any(_overlap(wide, box) for box in around.boxes):
        return limit
    if cost > LEADER_FROM_PT:
        cost += LEADER_COVERS * sum(_crosses(mark, nearest, box) for box in around.boxes)
    return cost + ON_LINE * sum(_crosses(a, b, place) for a, b in around.segments)


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _nearest(box: Box, point: Spot) -> Spot:
    return min(max(point[0], box[0]), box[2]), min(max(point[1], box[1]), box[3])


def _crosses(start: Spot, end: Spot, box: Box) -> bool:
    """Whether the segment meets the box; one that starts inside of it is the point's own and does not count."""
    if box[0] <= start[0] <= box[2] and box[1] <= start[1] <= box[3]:
        return False
    low, high = 0.0, 1.0
    for k in (0, 1):
        step = end[k] - start[k]
        if step == 0:
            if not box[k] <= start[k] <= box[k + 2]:
                return False
            continue
        near, far = sorted(((box[k] - start[k]) / step, (box[k + 2] - start[k]) / step))
        low, high = max(low, near), min(high, far)
    return low <= high


def _draw(axes: Axes, label: Label, text: str, mark: Spot, place: Box) -> None:
    nearest = _nearest(place, mark)
    if math.dist(nearest, mark) > LEADER_FROM_PT:
        axes.annotate("", xy=(label.x, label.y), xytext=(nearest[0] - mark[0], nearest[1] - mark[1]),
                      textcoords="offset points", arrowprops={"arrowstyle": "-", "color": FAINT, "linewidth": 0.6,
                                                              "shrinkA": 0, "shrinkB": POINT_PT}, zorder=4)
    axes.annotate(plain(text), xy=(label.x, label.y), xytext=(place[0] - mark[0], place[1] - mark[1]),
                  textcoords="offset points", fontsize=label.size_pt, color=INK if label.short else FAINT,
                  ha="left", va="bottom", zorder=5,
                  bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.5} if label.short else None)
