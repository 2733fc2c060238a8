"""report.html of a stability run: one file that needs no other."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from .chart import Chart
from .inline_svg import inline_svg
from .page_style import STYLE
from .pictures import read_picture
from .stability import MEASURES, Contender, Stability, Trial


def stability_page(stability: Stability, charts: Sequence[Chart], files: Mapping[str, bytes]) -> str:
    """`files` holds each chart's NAME.svg; one chart per trial."""
    title = "Where methods fail"
    facts = stability.facts
    parts = "".join(_trial_part(stability, trial, chart, files[f"{chart.name}.svg"])
                    for trial, chart in zip(stability.trials, charts))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<link rel="icon" href="data:,">\n'
        f"<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n"
        f"<p>Each trial drives a small scene from where all is well to where methods fail. A method fails where more than "
        f"{stability.most_bad_percent:g} % of the pixels that the trial looks at are bad; the threshold is found by "
        f"bisection. hybridrt {escape(facts['version'])} ({escape(facts['commit'])}), {escape(facts['processor'])}, "
        f"{escape(facts['date'])}.</p>\n{parts}</main>\n</body>\n</html>\n")


def outcome(contender: Contender, unit: str) -> str:
    """Where a contender can be trusted, in words."""
    if contender.fails_from is None:
        return "holds to the end"
    if contender.holds_to is None:
        return "fails from the start"
    return f"holds to {contender.holds_to:.3g} {unit}".rstrip()


def _trial_part(stability: Stability, trial: Trial, chart: Chart, svg: bytes) -> str:
    lines = "".join(f"<tr><th>{escape(contender.name)}</th><td>{escape(outcome(contender, trial.unit))}</td></tr>"
                    for contender in trial.contenders)
    return (f'<section id="{escape(trial.name)}"><h2>{escape(trial.title)}</h2>\n'
            f"<p>{escape(trial.reason.capitalize())}. Bad: {escape(MEASURES[trial.measure])}.</p>\n"
            f'<figure class="chart" id="chart-{chart.name}"><div class="card">{inline_svg(chart, svg)}</div>'
            f'<figcaption><p class="facts">{escape(chart.facts)}</p></figcaption></figure>\n'
            f'<div class="sideways"><table><tbody>{lines}</tbody></table></div>\n{_pictures(stability, trial)}</section>\n')


def _pictures(stability: Stability, trial: Trial) -> str:
    """Of the first contender that fails, at the value where it starts to."""
    failing = next((contender for contender in trial.contenders if contender.picture), None)
    if not failing:
        return ""
    figures = ""
    for name, caption in ((failing.picture, f"{failing.name} at {failing.fails_from:.3g}"), (failing.truth, "the truth"),
                          (failing.difference, "the difference, amplified")):
        picture = read_picture(stability.folder, name)
        if picture:
            figures += (f'<figure><img loading="lazy" width="{picture.width_px}" height="{picture.height_px}" '
                        f'alt="{escape(trial.title)}: {escape(caption)}" src="{picture.data_uri}">'
                        f"<figcaption>{escape(caption)}</figcaption></figure>")
    return f'<div class="pictures">{figures}</div>\n'
