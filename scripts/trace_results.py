#!/usr/bin/env python3
"""Runs tests/bench/trace_bench on several scenes and writes docs/results/trace.md.

  scripts/trace_results.py [--rounds 5] [--build build/release] [-o docs/results/trace.md] [SCENE ...]

Rounds are interleaved at random by Google Benchmark; the tables show medians, and the spread where it is wide.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

from results_file import processor, text_before_tables

TRIANGLES = 500000
SETS = ["primary", "shadow_all", "shadow_marked", "reflected_flat", "reflected_curved", "refracted"]
BACKENDS = ["embree", "embree_packets", "kd_scalar", "kd_simd", "light_buffer"]


def measure(bench, scene, rounds):
    """Results for one scene: {benchmark: {counter: [value of each round]}}, and the line that describes the scene."""
    command = [bench, f"--scene={scene}", f"--benchmark_repetitions={rounds}", "--benchmark_min_time=0.1",
               "--benchmark_enable_random_interleaving=true", "--benchmark_format=json"]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    about, text = output.split("\n", 1)
    results = {}
    for run in json.loads(text)["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        values = results.setdefault(run["run_name"].replace("/real_time", ""), {})
        for key in ("real_time", "Mrays/s", "wrong", "bytes/triangle"):
            if key in run:
                values.setdefault(key, []).append(run[key])
    return about, results


def median(results, name, key):
    values = results.get(name, {}).get(key)
    return statistics.median(values) if values else None


def spread(results, name, key):
    values = results[name][key]
    return f"{min(values):.0f}–{max(values):.0f}"


def rate_row(results, ray_set):
    rates = {backend: median(results, f"{ray_set}/{backend}", "Mrays/s") for backend in BACKENDS}
    if not rates["embree"]:
        return None
    best = max(rates["embree"], rates["embree_packets"])
    cells = []
    for backend in BACKENDS:
        if rates[backend] is None:
            cells.append("–")
            continue
        ratio = f" ({rates[backend] / best:.2f})"
        wrong = median(results, f"{ray_set}/{backend}", "wrong")
        cells.append(f"{rates[backend]:.1f}{ratio}" + (f" *{wrong:.0f}*" if wrong is not None else ""))
    return f"| {ray_set.replace('_', ' ')} | " + " | ".join(cells) + " |"


def section(about, results):
    lines = [f"## {about.split(';')[0]}", "", about.split("; ", 1)[1] + ".", ""]
    lines += ["| rays, Mrays/s of one thread (ratio to Embree's best) *wrong answers* | Embree | Embree, packets of 16 | "
              "kd-tree, scalar | kd-tree, SIMD | light buffer |", "|---|---|---|---|---|---|"]
    lines += [row for row in (rate_row(results, ray_set) for ray_set in SETS) if row]
    together = {b: median(results, f"shadow_all/{b}/all_threads", "Mrays/s") for b in ("embree_packets", "light_buffer")}
    lines += ["", f"All threads, shadow all: Embree's packets {together['embree_packets']:.1f}, "
              f"light buffer {together['light_buffer']:.1f} Mrays/s "
              f"({together['light_buffer'] / together['embree_packets']:.2f}).", "",
              "| | build, ms (range) | bytes per triangle |", "|---|---|---|"]
    for name, label in (("kd_tree", "kd-tree"), ("embree", "Embree, high quality"), ("light_buffer", "light buffer")):
        size = median(results, f"build/{name}", "bytes/triangle")
        lines.append(f"| {label} | {median(results, f'build/{name}', 'real_time'):.0f} "
                     f"({spread(results, f'build/{name}', 'real_time')}) | {f'{size:.0f}' if size else '–'} |")
    lines += ["", "| whole frame, all threads | ms (range) |", "|---|---|"]
    for name, label in (("raytrace", "`--method raytrace`: Embree's packets, light buffer"),
                        ("raytrace_traced_shadows", "the same, shadow rays traced"),
                        ("raytrace_kd_tree", "the same, kd-tree and light buffer"),
                        ("plain_embree", "plain Embree program (tests/bench/embree_frame.cpp)")):
        lines.append(f"| {label} | {median(results, f'frame/{name}', 'real_time'):.0f} "
                     f"({spread(results, f'frame/{name}', 'real_time')}) |")
    return lines + [""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--build", type=Path, default=Path("build/release"))
    parser.add_argument("-o", "--output", type=Path, default=Path("docs/results/trace.md"))
    parser.add_argument("scenes", nargs="*", help="default: the procedural ones")
    args = parser.parse_args()
    scenes = args.scenes or [f"scene:{name},triangles={TRIANGLES}" for name in ("chess", "thin", "spheres")]

    lines = [text_before_tables(args.output)]
    names = " ".join(Path(scene).name if os.path.exists(scene) else scene for scene in scenes)
    lines += [f"`scripts/trace_results.py --rounds {args.rounds} {names}`, on {processor()}, medians.", ""]
    for scene in scenes:
        print(scene, file=sys.stderr)
        lines += section(*measure(args.build / "bin/trace_bench", scene, args.rounds))
    args.output.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
