"""What `hybridrt sweep --preset stability` wrote, as plain values."""
from __future__ import annotations

import csv
import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional

from .report_error import ReportError

MEASURES = {
    "off": "pixels off by more than 2/255, % of all",
    "shadows": "pixels with a wrong shadow, % of those in shadow",
    "flicker": "pixels that change wrongly from frame to frame, % of those that change"}


@dataclass(frozen=True)
class Point:
    value: float
    percent_bad: float
    non_finite: int


@dataclass(frozen=True)
class Contender:
    """A method with its shadows along a trial. `points` from harmless to severe. `fails_from` is None where it holds to
    the end, `holds_to` where it fails from the start. Pictures are paths relative to the folder, "" where it holds."""
    name: str
    points: tuple[Point, ...]
    holds_to: Optional[float]
    fails_from: Optional[float]
    picture: str
    truth: str
    difference: str


@dataclass(frozen=True)
class Trial:
    name: str
    title: str
    reason: str
    scene: str
    parameter: str
    is_option: bool
    unit: str
    measure: str
    options: tuple[str, ...]
    truth: str
    contenders: tuple[Contender, ...]


@dataclass(frozen=True)
class Stability:
    folder: Path
    facts: dict[str, str]
    most_bad_percent: float
    trials: tuple[Trial, ...]


def holds_stability(folder: Path) -> bool:
    return (folder / "stability.json").is_file()


def read_stability(folder: Path) -> Stability:
    """Trials that were not finished are left out. Raises ReportError if a file is missing or not what was written."""
    try:
        data = json.loads((folder / "stability.json").read_text(encoding="utf-8"))
        points = _rows(folder / "stability.csv")
        thresholds = _rows(folder / "thresholds.csv")
        trials = tuple(_trial(entry, points, thresholds) for entry in data["trials"])
        return Stability(folder, {name: str(data[name]) for name in
                                  ("version", "commit", "processor", "date", "form", "width_px", "height_px")},
                         float(data["most_bad_percent"]), tuple(trial for trial in trials if trial.contenders))
    except OSError as error:
        raise ReportError(f"{error.filename} cannot be read: {error.strerror}; run `hybridrt sweep --preset stability` "
                          "again") from None
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ReportError(f"{folder} does not hold what `hybridrt sweep --preset stability` writes "
                          f"({type(error).__name__}: {error}); run it again") from None


def _rows(path: Path) -> list[dict[str, str]]:
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def _trial(entry: dict[str, Any], points: list[dict[str, str]], thresholds: list[dict[str, str]]) -> Trial:
    values = [float(value) for value in entry["values"]]
    falls = values[-1] < values[0]
    contenders = tuple(
        Contender(row["contender"], _points(entry["name"], row["contender"], points, falls), _number(row["holds_to"]),
                  _number(row["fails_from"]), row["picture"], row["truth"], row["difference"])
        for row in thresholds if row["trial"] == entry["name"])
    return Trial(entry["name"], entry["title"], entry["reason"], entry["scene"], entry["parameter"], bool(entry["is_option"]), entry["unit"],
                 entry["measure"], tuple(entry["options"]), entry["truth"], contenders)


def _points(trial: str, contender: str, points: list[dict[str, str]], falls: bool) -> tuple[Point, ...]:
    chosen = [Point(float(row["value"]), float(row["percent_bad"]), int(row["non_finite"])) for row in points
              if row["trial"] == trial and row["contender"] == contender]
    return tuple(sorted(chosen, key=lambda point: -point.value if falls else point.value))


def _number(text: str) -> Optional[float]:
    value = float(text) if text else None
    if value is not None and not math.isfinite(value):
        raise ValueError(f"{text} is no number")
    return value
