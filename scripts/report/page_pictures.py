"""The page's part with pictures: each setting's, the truth and their difference side by side."""
from __future__ import annotations

from collections.abc import Sequence
from html import escape

from .number_text import error_text, ms_text
from .pictures import read_picture
from .summaries import Summary
from .sweep import Setting, Sweep

EMPTY = '<div class="none"></div>'


def pictures_part(sweep: Sweep, summaries: Sequence[Summary]) -> str:
    """A truth that several settings share is in the page once; the others show it by reference."""
    if not any(setting.picture for setting in sweep.settings):
        return ""
    measured = {summary.setting.number: summary for summary in summaries}
    truths = {name: read_picture(sweep.folder, name) for name in dict.fromkeys(
        setting.truth for setting in sweep.settings if setting.truth)}
    symbols = "".join(
        f'<symbol id="truth-{place}" viewBox="0 0 {truth.width_px} {truth.height_px}"><image width="{truth.width_px}" '
        f'height="{truth.height_px}" href="{truth.data_uri}"/></symbol>'
        for place, truth in enumerate(truths.values()) if truth)
    store = f'<svg class="store" aria-hidden="true">{symbols}</svg>\n' if symbols else ""
    places = {name: place for place, name in enumerate(truths)}

    def truth_figure(setting: Setting) -> str:
        truth = truths.get(setting.truth)
        if not truth:
            return _figure("the truth: no picture", EMPTY)
        return _figure("the truth", f'<svg role="img" aria-label="The truth for setting {setting.number}" '
                       f'viewBox="0 0 {truth.width_px} {truth.height_px}"><use href="#truth-{places[setting.truth]}"/></svg>')

    parts = []
    for setting in sweep.settings:
        if setting.errors:
            parts.append(_section(setting, "failed: " + "; ".join(setting.errors), ""))
            continue
        summary = measured[setting.number]
        said = f"{ms_text(summary.wall.middle)} ms a frame"
        if summary.accuracy:
            said += f", RMSE {error_text(summary.accuracy)}"
        times = f"{setting.amplification:g} times"
        figures = _image(sweep, setting.picture, "the picture", f"Picture of setting {setting.number}, {setting.label}")
        if summary.accuracy or setting.truth:
            figures += truth_figure(setting) + _image(
                sweep, setting.difference, f"the difference, {times}",
                f"Difference of setting {setting.number} from the truth, amplified {times}")
        parts.append(_section(setting, said, f'<div class="pictures">{figures}</div>'))
    return f'<section id="pictures">\n<h2>Pictures</h2>\n{store}{"".join(parts)}</section>\n'


def _section(setting: Setting, said: str, content: str) -> str:
    return (f'<section class="setting" id="setting-{setting.number}"><h3>{setting.number}: {escape(setting.label)}</h3>'
            f'<p>{escape(said)}</p>{content}</section>\n')


def _image(sweep: Sweep, name: object, caption: str, alternative: str) -> str:
    picture = read_picture(sweep.folder, name)
    if not picture:
        return _figure(f"{caption}: no picture", EMPTY)
    return _figure(caption, f'<img loading="lazy" width="{picture.width_px}" height="{picture.height_px}" '
                   f'alt="{escape(alternative)}" src="{picture.data_uri}">')


def _figure(caption: str, content: str) -> str:
    return f"<figure>{content}<figcaption>{escape(caption)}</figcaption></figure>"
