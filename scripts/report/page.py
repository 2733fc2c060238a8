"""report.html: one file that needs no other."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from .chart import Chart, Drawn
from .facts_text import counted, truth_text
from .inline_svg import inline_svg
from .page_passes import passes_part
from .page_pictures import pictures_part
from .page_style import STYLE
from .page_table import table_part
from .summaries import Summary
from .summary_text import numbers_on_front, summary_sentences, warnings_of
from .sweep import Sweep


def page(sweep: Sweep, summaries: Sequence[Summary], drawn: Drawn, files: Mapping[str, bytes]) -> str:
    """`files` holds each chart's NAME.svg."""
    preset = f"{sweep.facts['preset']}: " if sweep.facts["preset"] else ""
    title = f"Speed and accuracy – {preset}{sweep.facts['scene'] or 'a sweep'}"
    charts = "".join(_chart(chart, files[f"{chart.name}.svg"]) for chart in drawn.charts)
    missing = "".join(f"<p>{escape(text)}</p>\n" for text in drawn.missing)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<link rel="icon" href="data:,">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{escape(title)}</h1>\n"
        f"{_summary(sweep, summaries)}"
        f'<section id="charts">\n<h2>Charts</h2>\n{missing}{charts}</section>\n'
        f"{table_part(sweep, summaries, numbers_on_front(sweep, summaries))}"
        f"{passes_part(summaries)}"
        f"{pictures_part(sweep, summaries)}"
        f"{_facts(sweep)}</main>\n</body>\n</html>\n")


def _summary(sweep: Sweep, summaries: Sequence[Summary]) -> str:
    first, *findings = summary_sentences(sweep, summaries)
    if len(findings) > 1:
        text = f"<p>{escape(first)}</p>\n<ul>" + "".join(f"<li>{escape(line)}</li>" for line in findings) + "</ul>\n"
    else:
        text = f"<p>{escape(' '.join([first, *findings]))}</p>\n"
    text += "".join(f'<p class="warning">{escape(warning)}</p>\n' for warning in warnings_of(sweep, summaries))
    failed = [setting for setting in sweep.settings if setting.errors]
    if failed:
        text += "<ul>" + "".join(
            f'<li class="failed">Setting {setting.number} ({escape(setting.label)}) failed: '
            f'{escape("; ".join(setting.errors))}</li>' for setting in failed) + "</ul>\n"
    return text


def _chart(chart: Chart, svg: bytes) -> str:
    notes = "".join(f"<p>{escape(note)}</p>" for note in chart.notes)
    return (f'<figure class="chart" id="chart-{chart.name}"><div class="card">{inline_svg(chart, svg)}</div>'
            f'<figcaption><p>{escape(chart.meaning)}</p>{notes}<p class="facts">{escape(chart.facts)}</p>'
            f'<p><a href="{chart.name}.svg">SVG</a> <a href="{chart.name}.png">PNG</a></p></figcaption></figure>\n')


def _facts(sweep: Sweep) -> str:
    facts = sweep.facts
    entries = [
        ("scene", facts["scene"]), ("processor", facts["processor"]), ("threads", facts["threads"]),
        ("GL", sweep.gl_renderer or "none: all passes on the CPU"),
        ("used by others", f"{100 * sweep.busy:.0f} % of the machine"),
        ("hybridrt", " ".join(part for part in (facts["version"], facts["commit"]) if part)), ("compiler", facts["compiler"]),
        ("date", facts["date"]), ("measured", f"frames {facts['frames'] or '?'}, {counted(facts['rounds'], 'round')}"),
        ("compared with", truth_text(sweep.truth).removeprefix("truth: ") if sweep.truth.kind != "none" else "nothing"),
        ("axes", "; ".join(f"{axis.name}: {', '.join(axis.values)}" for axis in sweep.axes))]
    lines = "".join(f"<dt>{name}</dt><dd>{escape(text)}</dd>" for name, text in entries if text)
    return (f'<section id="facts">\n<h2>How it was measured</h2>\n'
            f'<p><code>{escape(facts["command_line"])}</code></p>\n<dl>{lines}</dl>\n'
            '<p>All figures: <a href="sweep.csv">sweep.csv</a>, <a href="sweep.json">sweep.json</a>.</p>\n</section>\n')
