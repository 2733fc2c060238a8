"""Reads sweep.csv and sweep.json."""
from __future__ import annotations

import csv
import json
import math
import re
import shlex
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Optional

from .report_error import ReportError
from .sweep import ACCURACY, COUNTS, TIMES, Axis, Setting, Sweep, Truth

FACTS = ("version", "commit", "compiler", "scene", "date", "processor", "threads", "rounds", "frames", "preset")
Row = dict[str, str]  # of sweep.csv
NEEDED_COLUMNS = ("setting", "round", "frame", "wall_ms", "error")


@dataclass(frozen=True)
class Measured:
    """What sweep.csv holds, by the settings' numbers: known figures of each frame, texts of columns, reasons of failures."""
    rows: dict[int, list[dict[str, float]]] = field(default_factory=dict)
    texts: dict[int, dict[str, str]] = field(default_factory=dict)
    errors: dict[int, list[str]] = field(default_factory=dict)

    def add(self, row: Row, columns: Iterable[str], where: str) -> None:
        number = int(_figure(row["setting"], "setting", where) or 0)
        self.texts.setdefault(number, {name: _text(row[name]) for name in columns if name in row})
        if row["error"]:
            self.errors.setdefault(number, []).append(_text(row["error"]))
        else:
            self.rows.setdefault(number, []).append(_figures(row, where))


def read_sweep(folder: Path) -> Sweep:
    """The sweep in `folder`. Raises ReportError if a file is missing or not what `hybridrt sweep` writes."""
    if not folder.is_dir():
        raise ReportError(f"{folder} is not a folder; give the one that `hybridrt sweep` wrote")
    path = folder / "sweep.json"
    data = _read_json(path)
    try:
        axes = tuple(_axis(axis) for axis in data["axes"])
        truth = data.get("truth") or {}
        measured = _read_csv(folder / "sweep.csv", axes)
        settings = tuple(_setting(entry, axes, measured) for entry in data["settings"])
        command_line = shlex.join(_text(word) for word in data.get("command_line") or [])
        sweep = Sweep(
            folder=folder,
            facts={**{name: _text(data.get(name)) for name in FACTS}, "command_line": command_line},
            gl_renderer=_text(data.get("gl_renderer")) or None,
            busy=float(data.get("busy") or 0),
            truth=Truth(_text(truth.get("method")), int(truth.get("samples") or 1), _text(truth.get("kind")) or "none",
                        _text(truth.get("note"))),
            axes=axes, settings=settings)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ReportError(f"{path} is not what `hybridrt sweep` writes ({type(error).__name__}: {_text(error)}); "
                          "run the sweep again") from None
    _check(sweep, measured)
    return sweep


def _read_json(path: Path) -> dict[str, Any]:
    try:
        data = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}; run `hybridrt sweep` first") from None
    except ValueError as error:
        raise ReportError(f"{path} is not JSON: {error}; run the sweep again") from None
    if not isinstance(data, dict):
        raise ReportError(f"{path} is not what `hybridrt sweep` writes (no object); run the sweep again")
    return data


def _read_csv(path: Path, axes: Iterable[Axis]) -> Measured:
    measured = Measured()
    columns = sorted({axis.column for axis in axes} | {"shadows"})
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file)
            missing = [name for name in NEEDED_COLUMNS if name not in (reader.fieldnames or ())]
            if missing:
                raise ReportError(f"{path} has no column {missing[0]}; run the sweep again")
            for row in reader:
                where = f"{path}, line {reader.line_num}"
                if None in row or None in row.values():
                    raise ReportError(f"{where}: not as many cells as the header has; run the sweep again")
                measured.add(row, columns, where)
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}; run `hybridrt sweep` first") from None
    except (csv.Error, UnicodeDecodeError) as error:
        raise ReportError(f"{path} is not a CSV file in UTF-8: {error}; run the sweep again") from None
    return measured


def _figures(row: Row, where: str) -> dict[str, float]:
    figures = {}
    for name in TIMES + COUNTS + ACCURACY:
        value = _figure(row.get(name, ""), name, where)
        if value is not None:
            figures[name] = value
    if figures.get("wall_ms", 0) <= 0:
        raise ReportError(f"{where}: neither a wall_ms above 0 nor an error; run the sweep again")
    return figures


def _figure(text: str, name: str, where: str) -> Optional[float]:
    """None for an empty cell. Only the accuracy can be infinite, or not a number where a picture is not."""
    if not text.strip():
        return None
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) and (name not in ACCURACY or text.strip().lstrip("+-").lower() not in ("inf", "nan")):
        raise ReportError(f"{where}: {name} is {text!r}, which is no number; run the sweep again")
    return value


def _axis(data: dict[str, Any]) -> Axis:
    return Axis(_text(data["name"]), str(data["column"]), tuple(_text(value) for value in data["values"]),
                bool(data.get("changes_truth")))


def _setting(data: dict[str, Any], axes: Iterable[Axis], measured: Measured) -> Setting:
    number = int(data["number"])
    texts = measured.texts.get(number, {})
    failed = list(dict.fromkeys(measured.errors.get(number, [])))
    if number not in measured.rows and not failed:
        failed = ["it was not measured; the sweep may have been stopped"]
    return Setting(
        number=number, label=_text(data.get("label")) or f"setting {number}",
        values={axis.name: texts.get(axis.column, "") for axis in axes}, shadows=texts.get("shadows", ""),
        rows=() if failed else tuple(measured.rows[number]), errors=tuple(failed),
        picture=data.get("picture"), difference=data.get("difference"), truth=data.get("truth"),
        amplification=float(data.get("amplification") or 1))


def _check(sweep: Sweep, measured: Measured) -> None:
    known = [setting.number for setting in sweep.settings]
    if len(set(known)) < len(known):
        raise ReportError(f"{sweep.folder / 'sweep.json'} holds a setting's number twice; run the sweep again")
    strangers = sorted(measured.texts.keys() - set(known))
    if strangers:
        raise ReportError(f"{sweep.folder / 'sweep.csv'} has setting {strangers[0]}, sweep.json has not: the files are not "
                          "of one sweep; run it again")
    if not sweep.settings:
        raise ReportError(f"{sweep.folder / 'sweep.json'} has no settings, so there is nothing to draw; run the sweep again")


def _text(value: Any) -> str:
    """As text; what neither XML nor UTF-8 can hold becomes U+FFFD, line ends become spaces."""
    spaced = re.sub(r"[\t\r\n]+", " ", "" if value is None else str(value))
    return re.sub("[\x00-\x1f\x7f\ud800-\udfff\ufffe\uffff]", "\ufffd", spaced)
