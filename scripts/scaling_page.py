#!/usr/bin/env python3
"""Writes docs/results/scaling.md from what scripts/scaling.sh measured.

    scripts/scaling_page.py OUT PAGE.md IMAGES

The page's text before the mark is written by people and kept; tables and charts follow it.
"""
import csv
import json
import os
import pathlib
import re
import shutil
import statistics
import sys

from results_file import text_before_tables

TOP = 8  # functions of a profile


def rows_of(folder):
    if not (folder / "sweep.csv").exists():
        return []
    with open(folder / "sweep.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def groups(rows, *columns):
    """By the columns' values, in order."""
    found = {}
    for row in rows:
        found.setdefault(tuple(row[column] for column in columns), []).append(row)
    return found


def median(rows, column):
    values = [float(row[column]) for row in rows if not row["error"] and row[column]]
    return statistics.median(values) if values else None


def text(value, form="{:,.1f}"):
    return "–" if value is None else form.format(value)


def per(numerator, denominator):
    return None if numerator is None or not denominator else numerator / denominator


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows), ""]


def sizes_table(rows, by, head, size_of):
    """Time, loading and memory over triangles or pixels; a size that failed is told with its reason."""
    lines, failures = [], []
    for key, of_size in groups(rows, *by).items():
        hybrid, raytrace = ([row for row in of_size if row["method"] == method] for method in ("hybrid", "raytrace"))
        reasons = sorted({row["error"] for row in of_size if row["error"]})
        failures += reasons
        size = size_of(of_size[0])
        peak = median(hybrid, "peak_memory_mib")
        lines.append([f"{size:,.0f}" if size else " ".join(key), text(median(hybrid, "wall_ms")), text(median(raytrace, "wall_ms")),
                      text(per(median(raytrace, "wall_ms"), median(hybrid, "wall_ms")), "{:.2f}"),
                      text(median(hybrid, "first_frame_ms")), text(median(hybrid, "load_ms"), "{:,.0f}"),
                      text(median(hybrid, "accel_build_ms"), "{:,.0f}"), text(peak, "{:,.0f}"),
                      text(per(peak and peak * 2**20, size), "{:,.0f}")])
    return table([head + "s", "`hybrid`, ms a frame", "`raytrace`", "ratio", "first frame", "loading, ms", "building, ms",
                  "peak, MiB", f"bytes a {head}"], lines) + [f"Not measured: {reason}." for reason in failures]


def triangles_of(row):
    return None if row["error"] else float(row["triangles"])


def pixels_of(row):
    return None if row["error"] else float(row["width_px"]) * float(row["height_px"])


def threads_table(folder):
    lines, counts = [], []
    for scene in sorted(folder.iterdir()) if folder.exists() else ():
        for (method,), rows in groups(rows_of(scene), "method").items():
            by_threads = {int(threads): median(of, "wall_ms") for (threads,), of in groups(rows, "threads").items() if threads}
            counts = sorted(by_threads)
            lines.append([f"`{scene.name}`", f"`{method}`", *(text(by_threads[n]) for n in counts),
                          text(per(by_threads[counts[0]], by_threads[counts[-1]]), "{:.2f} ×")])
    return table(["scene", "method", *(f"{n} thread{'s' if n > 1 else ''}, ms" for n in counts), "speed-up"], lines) if lines else []


def in_flight_table(rows):
    lines = [[f"`{shadows}`", count, text(median(of, "wall_ms"))] for (shadows, count), of in
             groups([row for row in rows if not row["error"]], "shadows", "frames_in_flight").items()]
    return table(["shadows", "frames in flight", "ms a frame"], lines) if lines else []


def profile_lines(path):
    """The functions that take most, with names that people can read."""
    shares = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        found = re.match(r"\s*([\d.]+)%\s+\[(.)\]\s+(.*?)\s*$", line)
        if found:
            loop = re.search(r"parallel_for<(?:hybridrt::)?(?:\(anonymous namespace\)::)?([\w:]+)", found[3])
            name = loop[1] if loop else re.sub(r"hybridrt::|N_\w+?::|\(anonymous namespace\)::|<.*|\(.*| +-.*", "", found[3])
            name = "in the kernel (pages, files)" if found[2] == "k" else f"`{name or found[3]}`"
            shares[name] = shares.get(name, 0) + float(found[1])
    top = sorted(shares.items(), key=lambda item: -item[1])[:TOP]
    return ", ".join(f"{name} {share:.0f} %" for name, share in top)


def machine_line(out):
    path = out / "growth" / "sweep.json"
    if not path.exists():
        return []
    facts = json.loads(path.read_text(encoding="utf-8"))
    return [f"{facts['processor']}, {facts['threads']} threads; hybridrt {facts['version']} ({facts['commit']}). Medians over "
            f"{facts['rounds']} rounds and the frames. 1024×768 unless said otherwise.", ""]


def chart(out, name, images, page, saved_as, title):
    source = out / f"{name}.svg"
    if not source.exists():
        return []
    target = images / f"scaling-{saved_as}.svg"
    shutil.copyfile(source, target)
    return [f"![{title}]({os.path.relpath(target, page.parent)})", ""]


def main():
    out, page, images = (pathlib.Path(argument) for argument in sys.argv[1:4])
    growth, pixels = rows_of(out / "growth"), rows_of(out / "pixels")
    lines = [text_before_tables(page), *machine_line(out)]
    lines += ["## Triangles", "", *sizes_table(growth, ["triangles"] if growth else [], "triangle", triangles_of)]
    lines += ["", *chart(out, "growth/growth", images, page, "triangles", "Time, loading and memory over triangles")]
    lines += ["## Pixels", "", "500,000 triangles.", "", *sizes_table(pixels, ["size"], "pixel", pixels_of)]
    lines += ["", *chart(out, "pixels/growth-size", images, page, "pixels", "Time and memory over pixels")]
    lines += ["## Threads", "", *threads_table(out / "threads")]
    lines += chart(out, "threads/scene:chess,triangles=500k/scaling", images, page, "threads", "Speed-up over threads, chess")
    lines += ["## Frames in flight (software OpenGL)", "", *in_flight_table(rows_of(out / "in-flight"))]
    profiles = sorted((out / "profiles").glob("*.txt"))
    lines += ["## Where the time goes", "", "`perf` of whole jobs, pictures written: shares of all threads' time.", ""] if profiles else []
    lines += table(["job", "functions"], [[path.stem, profile_lines(path)] for path in profiles]) if profiles else []
    page.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()
