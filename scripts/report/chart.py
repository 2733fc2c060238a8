"""A drawn chart, and its files."""
from __future__ import annotations

import io
import re
from dataclasses import dataclass, field
from typing import Optional

from matplotlib.figure import Figure

PNG_DPI = 180
FONTS = "'DejaVu Sans', Verdana, 'Segoe UI', Roboto, Helvetica, Arial, sans-serif"


@dataclass(frozen=True)
class Point:
    """A mark that stands for a setting: the id of its SVG group, and what a tooltip says."""
    gid: str
    number: int
    tooltip: str


@dataclass(frozen=True)
class Chart:
    """`name` is the files' name; `meaning` says in a sentence or two what is seen; `facts` is the caption with machine and
    commit, which is also drawn at the bottom, `facts_height_pt` high. `notes` tell what is left out."""
    name: str
    title: str
    meaning: str
    facts: str
    facts_height_pt: float
    figure: Figure
    notes: tuple[str, ...] = ()
    points: tuple[Point, ...] = ()


@dataclass
class Drawn:
    """The charts of a sweep, and why others are missing."""
    charts: list[Chart] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)

    def add(self, chart: Optional[Chart]) -> None:
        if chart:
            self.charts.append(chart)


def file_name(*parts: str) -> str:
    """A name that any file system takes."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", "-".join(parts))


def svg_of(figure: Figure) -> bytes:
    """The same bytes for the same figure; text stays text."""
    file = io.BytesIO()
    figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    return re.sub(r"'DejaVu Sans'(, *'?sans-serif'?)?", FONTS, file.getvalue().decode("utf-8")).encode("utf-8")


def png_of(figure: Figure) -> bytes:
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=PNG_DPI, metadata={"Software": None})
    return file.getvalue()
