#!/usr/bin/env python3
"""Measures what each pass costs and writes it as a Markdown table.

    scripts/pass_times.py [-o docs/results/pass_times.md] [--triangles 500000] [--rounds 5] [--frames 12]

The paper's measuring scene: balls, 1024x768, 10 % of them mirrors. Every row is one set of options. Rounds are
interleaved (a row's runs are spread over the whole time), the first frames of a run are left out (drivers compile
then), and the table shows medians over all frames, with the quartiles of the frame time.
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import tempfile

PASSES = ["shadow_map", "id", "mark", "readback", "trace", "upload", "shade", "download"]
WARM_UP_FRAMES = 2
ROWS = [
    ("EGL, 1 in flight", ["--gl", "egl", "--frames-in-flight", "1"]),
    ("EGL, 2 in flight", ["--gl", "egl", "--frames-in-flight", "2"]),
    ("OSMesa, 1 in flight", ["--gl", "osmesa", "--frames-in-flight", "1"]),
    ("OSMesa, 2 in flight", ["--gl", "osmesa", "--frames-in-flight", "2"]),
    ("EGL, shadows rays, 1 in flight", ["--gl", "egl", "--shadows", "rays", "--frames-in-flight", "1"]),
    ("all passes on the CPU", ["--gl", "off"]),
    ("EGL, kd-tree, 1 in flight", ["--gl", "egl", "--accel", "kdtree", "--frames-in-flight", "1"]),
    ("raytrace, Embree (the rival)", ["--method", "raytrace"]),
    ("raytrace, kd-tree", ["--method", "raytrace", "--accel", "kdtree"]),
]


def run(binary, scene, options, frames, folder):
    command = [binary, "render", scene, "--frames", str(frames), "-o", f"{folder}/f.####.bmp", "--quiet", *options]
    subprocess.run(command, check=True)
    with open(f"{folder}/timings.csv", newline="") as file:
        rows = list(csv.DictReader(file))[WARM_UP_FRAMES:]
    facts = json.loads(pathlib.Path(folder, "run.json").read_text())
    return [{name: float(value) for name, value in row.items()} for row in rows], facts


def table(results, shadow_map_ms):
    lines = ["| | " + " | ".join(PASSES) + " | frame (quartiles) | frames/s |", "|---|" + "---|" * (len(PASSES) + 2)]
    for name, rows in results.items():
        walls = [row["wall_ms"] for row in rows]
        low, middle, high = statistics.quantiles(walls, n=4)
        cells = [f"{statistics.median(row[p + '_ms'] for row in rows):.1f}" for p in PASSES]
        cells[0] = f"{cells[0]} ({shadow_map_ms[name]:.0f} once)" if shadow_map_ms[name] else cells[0]
        lines.append(f"| {name} | " + " | ".join(cells) + f" | **{middle:.1f}** ({low:.1f}–{high:.1f}) | {1000 / middle:.2f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", help="Markdown file (default: standard output)")
    parser.add_argument("--binary", default="build/release/bin/hybridrt")
    parser.add_argument("--triangles", type=int, default=500_000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--frames", type=int, default=12)
    arguments = parser.parse_args()

    scene = f"scene:spheres,triangles={arguments.triangles},reflective=10"
    results = {name: [] for name, _ in ROWS}
    shadow_map_ms = {name: 0.0 for name, _ in ROWS}
    facts = {}
    for _ in range(arguments.rounds):
        for name, options in ROWS:
            with tempfile.TemporaryDirectory() as folder:
                rows, facts_of_run = run(arguments.binary, scene, options, arguments.frames, folder)
                with open(f"{folder}/timings.csv", newline="") as file:
                    shadow_map_ms[name] = float(next(csv.DictReader(file))["shadow_map_ms"])
            results[name] += rows
            facts = facts if facts.get("gl") else facts_of_run

    first = next(iter(results.values()))
    mean = {key: statistics.mean(row[key] for row in first) for key in first[0]}
    text = f"""# What each pass costs

`scripts/pass_times.py --triangles {arguments.triangles} --rounds {arguments.rounds} --frames {arguments.frames}`

{scene}, 1024x768, an orbit; {facts['processor']}, {facts['threads']} threads; {facts['gl']['renderer']},
{facts['gl']['version']}; hybridrt {facts['version']} ({facts['commit']}). Milliseconds, medians of
{len(first)} frames per row. A software GL shares the processors with pass 4, so with two frames in flight the passes
overlap and each takes longer; what counts there is the frame time.

{table(results, shadow_map_ms)}

A frame of the first row: {mean['pixels_hit']:.0f} pixels see a surface, {mean['pixels_marked']:.0f} are marked,
{mean['pixels_reflective']:.0f} mirror; {mean['shadow_rays']:.0f} shadow rays, {mean['reflection_rays']:.0f} reflection rays.
"""
    if arguments.output:
        pathlib.Path(arguments.output).write_text(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
