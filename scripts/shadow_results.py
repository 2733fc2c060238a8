#!/usr/bin/env python3
"""Measures what shadow modes cost and get wrong; writes docs/results/shadows.md, with --warps shadow_warp.md.

  scripts/shadow_results.py [--warps] [--lights 12] [--triangles 500000] [--options="--fov 30"] [-o FILE] [SCENE ...]

Each mode renders two frames from the same place under each light; times are of the second, when what does not move is
kept. Wrong pixels are those whose shadow differs from `--method reference`, where both see the same triangle.
"""
import argparse
import csv
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from results_file import text_before_tables

MODES = [("map", ["--shadows", "map"])] + \
        [(f"blur {k}×{k}", ["--shadows", "blur", "--blur-kernel", str(k)]) for k in (3, 5, 9, 15)] + \
        [("exact", ["--shadows", "exact"]), ("rays", ["--shadows", "rays"])]
WARP_MODES = [(f"{mode} {warp}", ["--shadows", mode, "--shadow-warp", warp])
              for mode in ("map", "blur") for warp in ("uniform", "lispsm")]


def directions(count):
    """From the zenith down to 0.5 degrees above the horizon, all around."""
    for i in range(count):
        elevation = math.radians(89.5 - 89 * i / max(count - 1, 1))
        azimuth = i * math.pi * (3 - math.sqrt(5))
        yield (math.cos(elevation) * math.sin(azimuth), math.sin(elevation), math.cos(elevation) * math.cos(azimuth))


def pixels(path):
    """The bytes of a binary PPM."""
    data = path.read_bytes()
    _, _, _, rest = data.split(b"\n", 3)
    return rest


class Runner:
    def __init__(self, binary, folder, options):
        self.binary, self.folder, self.options = binary, Path(folder), options

    def render(self, name, scene, light, options):
        """The timings of the second frame, and its shadows and ids."""
        out = self.folder / name
        command = [self.binary, "render", scene, "-q", "--frames", "2", "--frames-in-flight", "1", "--gl", "egl", "--aov", "shadow,id",
                   "--light", ",".join(f"{x:.6f}" for x in light), "-o", out / "p.#.ppm", *self.options,
                   *options]
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        with open(out / "timings.csv", newline="", encoding="ascii") as file:
            row = {key: float(value) for key, value in list(csv.DictReader(file))[-1].items()}
        return row, pixels(out / "p.shadow.2.ppm")[::3], pixels(out / "p.id.2.ppm")


def wrong_pixels(shadow, ids, true_shadow, true_ids):
    """(lit but should be dark, dark but should be lit, other triangle)"""
    false_lit = false_shadow = other = 0
    if shadow == true_shadow and ids == true_ids:
        return 0, 0, 0
    for i, (mine, truth) in enumerate(zip(shadow, true_shadow)):
        if ids[3 * i:3 * i + 3] != true_ids[3 * i:3 * i + 3]:
            other += 1
        elif mine != truth:
            false_lit += mine > truth
            false_shadow += mine < truth
    return false_lit, false_shadow, other


def measure(runner, scene, modes, lights, threads):
    """{mode: [(ms, traced share, false lit, false shadow, other triangle) of each light]}"""
    results = {mode: [] for mode, _ in modes}
    for light in lights:
        _, true_shadow, true_ids = runner.render("truth", scene, light, ["--method", "reference"])
        for mode, options in modes:
            row, shadow, ids = runner.render("mode", scene, light, ["--threads", str(threads), *options])
            tracing = row["trace_ms"] - row["repair_ms"] - row["secondary_cpu_ms"] / threads
            ms = row["shadow_map_ms"] + row["mark_ms"] + tracing
            traced = row["primary_shadow_rays"] / max(row["pixels_hit"], 1)
            results[mode].append((ms, traced, *wrong_pixels(shadow, ids, true_shadow, true_ids), row["repair_ms"]))
        print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return results


def table(results):
    lines = ["| `--shadows` | ms: median (worst) | traced: median (worst) | false lit, all lights | false shadow | "
             "other triangle per frame | repair, ms |", "|---|---|---|---|---|---|---|"]
    for mode, rows in results.items():
        ms, traced, lit, shadow, other, repair = zip(*rows)
        lines.append(f"| {mode} | {statistics.median(ms):.1f} ({max(ms):.1f}) | {100 * statistics.median(traced):.1f} % "
                     f"({100 * max(traced):.1f} %) | {sum(lit)} | {sum(shadow)} | {statistics.median(other):.0f} | "
                     f"{statistics.median(repair):.0f} |")
    return lines


def table_without_times(results):
    lines = ["| `--shadows` | traced: median (worst) | false lit, all lights | false shadow |", "|---|---|---|---|"]
    for mode, rows in results.items():
        _, traced, lit, shadow, _, _ = zip(*rows)
        lines.append(f"| {mode} | {100 * statistics.median(traced):.1f} % ({100 * max(traced):.1f} %) | {sum(lit)} | "
                     f"{sum(shadow)} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lights", type=int, default=12)
    parser.add_argument("--triangles", type=int, default=500000)
    parser.add_argument("--warps", action="store_true", help="compare --shadow-warp, without times")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--build", type=Path, default=Path("build/release"))
    parser.add_argument("--options", default="", help="options of render, for every mode and the reference")
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("scenes", nargs="*", help="default: chess, thin and spheres")
    args = parser.parse_args()
    modes, flag, name = (WARP_MODES, "--warps ", "shadow_warp.md") if args.warps else (MODES, "", "shadows.md")
    output = args.output or Path("docs/results") / name
    scenes = args.scenes or [f"scene:{name},triangles={args.triangles}" for name in ("chess", "thin", "spheres")]
    lines = [text_before_tables(output)]
    names = "".join(f" {Path(scene).name if os.path.exists(scene) else scene}" for scene in args.scenes)
    if args.options:
        flag += f'--options="{args.options}" '
    lines += [f"`scripts/shadow_results.py {flag}--lights {args.lights} --triangles {args.triangles}{names}`, "
              f"{platform.processor() or platform.machine()}, {args.threads} threads.", ""]
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner((args.build / "bin/hybridrt").resolve(), folder, args.options.split())
        for scene in scenes:
            print(scene, end=" ", file=sys.stderr, flush=True)
            results = measure(runner, scene, modes, list(directions(args.lights)), args.threads)
            lines += [f"## {Path(scene).name if os.path.exists(scene) else scene}", "",
                      *(table_without_times(results) if args.warps else table(results)), ""]
    output.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
