#!/usr/bin/env python3
"""Writes docs/stability.md from what scripts/stability.sh measured.

    scripts/stability_page.py OUT PAGE.md

The page's text before the mark is written by people and kept; tables, charts and pictures follow it.
"""
import pathlib
import shutil
import sys

import numpy
from matplotlib import image

from report.stability import MEASURES, read_stability
from results_file import text_before_tables

COLUMNS = ["raster map", "hybrid map", "hybrid blur", "hybrid exact", "hybrid rays", "raytrace"]
GAP_PX = 6


def cell(contender):
    """Where a contender starts to fail."""
    if contender is None:
        return ""
    if contender.fails_from is None:
        return "holds"
    if contender.holds_to is None:
        return "**fails from the start**"
    return f"**{contender.holds_to:.3g}**"


def table(stability, gl):
    lines = ["| trial | from … to | " + " | ".join(COLUMNS) + " |", "|---" * (2 + len(COLUMNS)) + "|"]
    for trial in stability.trials:
        known = {contender.name: contender for contender in trial.contenders}
        in_gl = {contender.name: contender for other in gl.trials if other.name == trial.name for contender in other.contenders}
        points = trial.contenders[0].points
        cells = []
        for name in COLUMNS:
            mine, other = cell(known.get(name)), cell(in_gl.get(name))
            cells.append(mine if mine == other else f"{mine}; GL {other}")
        lines.append(f"| [{trial.title}](#{trial.name}) | {points[0].value:g} … {points[-1].value:g} {trial.unit} | "
                     + " | ".join(cells) + " |")
    return "\n".join(lines)


def write_pictures(folder, contender, target):
    """The picture, the truth and the difference side by side, a white gap between them."""
    pictures = [image.imread(folder / name)[:, :, :3] for name in (contender.picture, contender.truth, contender.difference)]
    gap = numpy.ones((pictures[0].shape[0], GAP_PX, 3), dtype=pictures[0].dtype)
    joined = numpy.hstack([pictures[0], gap, pictures[1], gap, pictures[2]])
    image.imsave(target, (255 * joined + 0.5).astype("uint8"), metadata={"Software": None})


def trial_part(stability, trial, folder, images):
    chart = images / f"{trial.name}.svg"
    shutil.copyfile(folder / f"{trial.name}.svg", chart)
    options = " ".join(([f"--{trial.parameter} V"] if trial.is_option else []) + list(trial.options))
    scene = trial.scene if trial.is_option else f"{trial.scene},{trial.parameter}=V"
    text = [f'<a name="{trial.name}"></a>\n## {trial.title}',
            f"{trial.reason[0].upper()}{trial.reason[1:]}. `{scene}`{f' `{options}`' if options else ''}. "
            f"Bad: {MEASURES[trial.measure]}.",
            f"![bad pixels over {trial.parameter}](images/stability/{chart.name})"]
    failing = next((contender for contender in trial.contenders if contender.picture), None)
    if failing:
        picture = images / f"{trial.name}.png"
        write_pictures(folder, failing, picture)
        text.append(f"![{failing.name} where it starts to fail](images/stability/{picture.name})")
        text.append(f"{failing.name} at {failing.fails_from:.3g} {trial.unit}, where it starts to fail; the truth; the difference, "
                    "amplified 8 times.".replace(" ,", ","))
    return "\n\n".join(text)


def main():
    out, page = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    stability, gl = read_stability(out / "cpu"), read_stability(out / "gl")
    images = page.parent / "images" / "stability"
    images.mkdir(parents=True, exist_ok=True)
    facts = stability.facts
    machine = (f"{facts['width_px']}×{facts['height_px']} pixels; {facts['processor']}; hybridrt {facts['version']} "
               f"({facts['commit']}). A number is the last value at which at most {stability.most_bad_percent:g} % of the "
               "pixels that the trial looks at are bad. Where passes drawn by OpenGL (Mesa's software) differ from those on the "
               "CPU, both stand there.")
    parts = [text_before_tables(page).rstrip(), "## Thresholds", machine, table(stability, gl)]
    parts += [trial_part(stability, trial, out / "cpu", images) for trial in stability.trials]
    page.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()
