"""The page's table of passes: each setting's median and quartiles of each pass."""
from __future__ import annotations

from collections.abc import Sequence
from html import escape

from .number_text import ms_text
from .passes_chart import pass_names
from .summaries import PASSES, Summary


def passes_part(summaries: Sequence[Summary]) -> str:
    """Without passes that no setting runs; empty if none was timed."""
    used = [name for name in PASSES if any(summary.pass_quartiles[name].high > 0 for summary in summaries)]
    if not used:
        return ""
    names = pass_names(summaries)
    head = "".join(f'<th scope="col" class="number">{escape(names[name])}</th>' for name in used)
    rows = "\n".join(
        f'<tr><td class="number">{summary.setting.number}</td><th scope="row">{escape(summary.setting.label)}</th>'
        + "".join(f'<td class="number">{_cell(summary, name)}</td>' for name in used) + "</tr>" for summary in summaries)
    return ('<section id="passes">\n<h2>Passes</h2>\n<p>Times in ms: the median over frames and rounds, with the first and the '
            'third quartile.</p>\n<div class="sideways" tabindex="0" role="region" aria-label="Table of passes"><table>\n<thead>'
            f'<tr><th scope="col" class="number">no.</th><th scope="col">setting</th>{head}</tr></thead>\n<tbody>\n{rows}\n'
            "</tbody></table></div>\n</section>\n")


def _cell(summary: Summary, name: str) -> str:
    times = summary.pass_quartiles[name]
    if times.high == 0:
        return ""
    return f"{ms_text(times.middle)} <small>({ms_text(times.low)}–{ms_text(times.high)})</small>"
