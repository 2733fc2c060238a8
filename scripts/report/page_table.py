"""The page's table of settings."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from typing import Optional

from .number_text import count_text, decibel_text, ms_text, similarity_text, small_text
from .summaries import Accuracy, Summary
from .sweep import Sweep

NOTE = ("Times are in ms: medians over frames and rounds; the first frame with its one-off cost, which the median leaves "
        "out. RMSE, PSNR, SSIM and the largest error are of display values; over several frames the RMSE is the root of the "
        "mean square, SSIM and the numbers of pixels are means.")


@dataclass(frozen=True)
class Column:
    """`text` gives a cell; a column of whose cells none is known is left out."""
    heading: str
    text: Callable[[Summary], Optional[str]]


def table_part(sweep: Sweep, summaries: Sequence[Summary], on_front: frozenset[int]) -> str:
    """`on_front`: numbers of the settings on the Pareto front, which are marked."""
    measured = {summary.setting.number: summary for summary in summaries}
    columns = [column for column in _columns() if any(column.text(summary) for summary in summaries)]
    with_front = bool(on_front)
    pictures = any(setting.picture for setting in sweep.settings)
    head = "".join(f'<th scope="col"{kind}>{heading}</th>' for heading, kind in (
        [("no.", ' class="number"'), ("setting", "")] + ([("front", "")] if with_front else [])
        + [(column.heading, ' class="number"') for column in columns]))
    rows = []
    for setting in sweep.settings:
        number = f'<a href="#setting-{setting.number}">{setting.number}</a>' if pictures else str(setting.number)
        cells = f'<td class="number">{number}</td><th scope="row">{escape(setting.label)}</th>'
        if setting.errors:
            reason = escape("; ".join(setting.errors))
            cells += f'<td class="failed" colspan="{len(columns) + with_front}">failed: {reason}</td>'
            rows.append(f"<tr>{cells}</tr>")
            continue
        summary = measured[setting.number]
        marked = setting.number in on_front
        cells += ("<td>on it</td>" if marked else "<td></td>") if with_front else ""
        cells += "".join(f'<td class="number">{column.text(summary) or ""}</td>' for column in columns)
        rows.append(f"""<tr{' class="front"' if marked else ''}>{cells}</tr>""")
    body = "\n".join(rows)
    return (f'<section id="settings">\n<h2>Settings</h2>\n<p>{NOTE}</p>\n<div class="sideways" tabindex="0" role="region" '
            f'aria-label="Table of settings"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>\n'
            "</section>\n")


def _columns() -> list[Column]:
    return [
        Column("ms a frame", lambda summary: ms_text(summary.wall.middle)),
        Column("quartiles", lambda summary: f"{ms_text(summary.wall.low)}–{ms_text(summary.wall.high)}"),
        Column("first frame", lambda summary: _known(summary.first_frame_ms, ms_text)),
        Column("build", lambda summary: _known(summary.build_ms, ms_text)),
        Column("RMSE", _of(lambda accuracy: small_text(accuracy.rmse))),
        Column("PSNR, dB", _of(lambda accuracy: decibel_text(accuracy.psnr_db))),
        Column("SSIM", _of(lambda accuracy: _known(accuracy.ssim, similarity_text))),
        Column("largest error", _of(lambda accuracy: _known(accuracy.max_error, small_text))),
        Column("pixels different", _of(lambda accuracy: _known(accuracy.pixels_different, count_text))),
        Column("falsely lit", _of(lambda accuracy: _known(accuracy.false_lit, count_text))),
        Column("falsely in shadow", _of(lambda accuracy: _known(accuracy.false_shadow, count_text))),
        Column("other triangle", _of(lambda accuracy: _known(accuracy.other_triangle, count_text))),
        Column("not numbers", _of(lambda accuracy: count_text(accuracy.non_finite) if accuracy.non_finite else None))]


def _of(text: Callable[[Accuracy], Optional[str]]) -> Callable[[Summary], Optional[str]]:
    return lambda summary: text(summary.accuracy) if summary.accuracy else None


def _known(value: Optional[float], text: Callable[[float], str]) -> Optional[str]:
    return None if value is None else text(value)
