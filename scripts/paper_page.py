#!/usr/bin/env python3
"""Writes docs/paper.md from what scripts/reproduce_paper.sh measured.

    scripts/paper_page.py OUT PAGE.md

The page's text before the mark is written by people and kept; tables and charts follow it.
"""
import csv
import json
import pathlib
import shutil
import statistics
import sys

from results_file import text_before_tables

PASSES = ["shadow_map", "id", "mark", "readback", "trace", "upload", "shade", "download"]
GPU_PASSES = ["shadow_map", "id", "mark", "readback", "upload", "shade", "download"]


def rows_of(folder):
    """A sweep's rows without the settings that failed."""
    with open(folder / "sweep.csv", newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if not row["error"]]


def chosen(rows, **values):
    return [row for row in rows if all(row[name] == value for name, value in values.items())]


def median(rows, column):
    """None where nothing was measured."""
    values = [float(row[column]) for row in rows if row[column]]
    return statistics.median(values) if values else None


def frame_ms(rows, **values):
    return median(chosen(rows, **values), "wall_ms")


def number(value, form="{:.1f}"):
    return "–" if value is None else form.format(value)


def ratio(above, below):
    return None if above is None or below is None else above / below


def fps(ms):
    return number(ratio(1000, ms))


def share_of_pass_4(rows):
    """Percent of the passes' time."""
    if not rows:
        return None
    trace = median(rows, "trace_ms")
    return 100 * trace / (trace + sum(median(rows, f"{name}_ms") for name in GPU_PASSES))


def simd_ms(out, target, scene):
    """The hybrid's frame by frame_bench under an instruction set."""
    path = out / f"simd-{target}.csv"
    if not path.exists():
        return None
    with open(path, newline="", encoding="utf-8") as file:
        return next((float(row["hybrid"]) for row in csv.DictReader(file) if row["scene"].startswith(scene)), None)


def claims(out):
    balls, threads, shadows = rows_of(out / "balls"), rows_of(out / "threads"), rows_of(out / "shadows")
    grey, cpu = rows_of(out / "reflection-gl"), rows_of(out / "reflection-cpu")

    def in_flight(gl, shadow):
        return ratio(frame_ms(balls, gl=gl, shadows=shadow, frames_in_flight="1"),
                     frame_ms(balls, gl=gl, shadows=shadow, frames_in_flight="2"))

    def shadow_cell(mode, gl):
        rows = chosen(shadows, shadows=mode, gl=gl)
        wrong = [median(rows, column) for column in ("false_lit", "false_shadow")]
        return f"{fps(median(rows, 'wall_ms'))} fps; {number(wrong[0], '{:.0f}')} pixels wrongly lit, " \
               f"{number(wrong[1], '{:.0f}')} wrongly dark"

    simd = [ratio(simd_ms(out, "SSE4", scene), simd_ms(out, "AVX3", scene)) for scene in ("scene:spheres", "scene:thin")]
    return [
        ("Figure 5: 500,000 triangles, 10 % mirrors", "8 fps",
         f"{fps(frame_ms(balls, gl='egl', shadows='blur', frames_in_flight='2'))} fps (`blur`)",
         f"{fps(frame_ms(balls, gl='off', shadows='blur', frames_in_flight='2'))} fps (`blur`), "
         f"{fps(frame_ms(balls, gl='off', shadows='exact', frames_in_flight='2'))} (`exact`)"),
        ("Figure 4: CPU and GPU work at once, on neighbouring frames", "no number",
         f"two frames in flight are {number(in_flight('egl', 'blur'), '{:.2f}')} × as fast as one",
         "one frame at a time keeps all threads busy"),
        ("Figure 6: the ray tracer is the bottleneck, the GPU is under-worked", "at every share of mirrors",
         "pass 4 takes " + number(share_of_pass_4(chosen(grey, reflection_percent="0")), "{:.0f}") + " % of the passes' time at 0, "
         + number(share_of_pass_4(chosen(grey, reflection_percent="100")), "{:.0f}") + " % at 100 % mirrors",
         "pass 4 takes " + number(share_of_pass_4(chosen(cpu, reflection_percent="0")), "{:.0f}") + " % at 0, "
         + number(share_of_pass_4(chosen(cpu, reflection_percent="100")), "{:.0f}") + " % at 100 % mirrors"),
        ("Figure 7: two threads against one, on two processors", "2.0 × as fast",
         number(ratio(*(frame_ms(rows_of(out / f"threads-gl-{n}")) for n in (1, 2))), "{:.2f}") + " ×",
         number(ratio(*(frame_ms(threads, threads=n) for n in ("1", "2"))), "{:.2f}") + " ×"),
        ("Section 5.4: SIMD against none", "at least 10 % faster", "not told apart",
         f"AVX-512 against SSE4: {number(simd[0], '{:.2f}')} × (balls), {number(simd[1], '{:.2f}')} × (thin)"),
        ("Figure 8: shadow map alone", "7 fps, with artefacts", shadow_cell("map", "egl"), shadow_cell("map", "off")),
        ("Figure 9: boundaries refined, kernel 5×5", "6 fps, “exact shadows”", shadow_cell("blur", "egl"), shadow_cell("blur", "off")),
        ("(ours: `--shadows exact`)", "", shadow_cell("exact", "egl"), shadow_cell("exact", "off")),
    ]


def claims_table(out):
    lines = ["| the paper | there | here, software OpenGL | here, all passes on the CPU | here, a GPU |", "|---|---|---|---|---|"]
    lines += [f"| {' | '.join(cells)} | not measured |" for cells in claims(out)]
    return "\n".join(lines)


def kernel_table(out):
    lines = ["| kernel | ms a frame | shadow rays asked | pixels wrongly lit | wrongly dark |", "|---|---|---|---|---|"]
    rows = rows_of(out / "kernel")
    for kernel in dict.fromkeys(row["blur_kernel"] for row in rows):
        mine = chosen(rows, blur_kernel=kernel)
        cells = [number(median(mine, "wall_ms"))] + [number(median(mine, column), "{:.0f}")
                                                     for column in ("pixels_marked", "false_lit", "false_shadow")]
        lines.append(f"| {kernel}×{kernel} | {' | '.join(cells)} |")
    return "\n".join(lines)


def growth_table(out):
    lines = ["| triangles | software OpenGL, ms | passes 1, 2, 3, 5 | all on the CPU, ms | passes 1, 2, 3, 5 |",
             "|---|---|---|---|---|"]
    rows = rows_of(out / "growth")
    for triangles in dict.fromkeys(row["triangles"] for row in rows):
        cells = []
        for gl in ("egl", "off"):
            mine = chosen(rows, triangles=triangles, gl=gl)
            share = share_of_pass_4(mine)
            cells += [number(median(mine, "wall_ms")), number(None if share is None else 100 - share, "{:.0f} %")]
        lines.append(f"| {int(triangles):,} | {' | '.join(cells)} |")
    return "\n".join(lines)


def chart(out, page, sweep, name, what):
    """Copies a chart beside the page and returns the line that shows it."""
    images = page.parent / "images"
    target = images / f"paper-{sweep}.svg"
    shutil.copyfile(out / sweep / f"{name}.svg", target)
    return f"![{what}](images/{target.name})"


def main():
    out, page = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    facts = json.loads((out / "balls" / "sweep.json").read_text(encoding="utf-8"))
    machine = f"{facts['processor']}, {facts['threads']} threads; {facts['gl_renderer']}; hybridrt {facts['version']} " \
              f"({facts['commit']}). Medians over frames and rounds."
    parts = [
        text_before_tables(page).rstrip(), machine, claims_table(out),
        "## Pass times over mirrors (figure 6)",
        chart(out, page, "reflection-gl", "passes-reflection-percent", "pass times over the share of mirrors, software OpenGL"),
        chart(out, page, "reflection-cpu", "passes-reflection-percent", "the same, all passes on the CPU"),
        "## Threads (figure 7)", chart(out, page, "threads", "scaling", "speed-up over threads"),
        "## What the kernel buys (section 5.5)", kernel_table(out),
        chart(out, page, "kernel", "error-blur-kernel", "error over the kernel's size"),
        "## Does the bottleneck move to the GPU as triangles grow? (section 5.2)", growth_table(out),
        chart(out, page, "growth", "growth", "time over triangles"),
    ]
    page.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()
