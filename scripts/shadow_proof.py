#!/usr/bin/env python3
"""Checks `--shadows exact` through the whole program: every pixel against `--method reference`.

Writes docs/results/proof.md.

  scripts/shadow_proof.py [--quick] [--lights 12] [--size 400x300] [--build build/release] [-o FILE] [SCENE | FOLDER …]

Scenes, and all OBJ and PLY files below folders, are seen from near and from far, each under lights from the zenith
to half a degree above the horizon and one along the view. Exits with 1 if any pixel's shadow is wrong, or none was
seen. Pixels that see the same triangle are compared; the others are counted. --quick: small.
"""
import argparse
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from results_file import text_before_tables
from shadow_results import directions, pixels, wrong_pixels

NEAR, FAR = (1.1, 50), (9, 8)  # distance from the middle in half diagonals, field of view in degrees


def text_of(vector):
    return ",".join(f"{x:.9g}" for x in vector)


def run(command):
    """Runs a command and returns what it prints; its messages are shown only if it fails."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def cameras(binary, scene):
    """(options, direction toward the camera) of each camera."""
    bounds = json.loads(run([binary, "inspect", scene, "--json"]))["bounds"]
    lo, hi = bounds["lo"], bounds["hi"]
    middle = [(a + b) / 2 for a, b in zip(lo, hi)]
    radius = sum((b - a) ** 2 for a, b in zip(lo, hi)) ** 0.5 / 2
    toward = (0.55, 0.4, 0.733)
    for distance, fov in (NEAR, FAR):
        eye = [m + distance * radius * t for m, t in zip(middle, toward)]
        yield ["--eye", text_of(eye), "--target", text_of(middle), "--fov", str(fov)], toward


def render(binary, folder, scene, options):
    run([binary, "render", scene, "-q", "--frames", "1", "--reflection-depth", "0", "--aov", "shadow,id",
         "-o", folder / "p.#.ppm", *options])
    with open(folder / "timings.csv", newline="", encoding="ascii") as file:
        row = next(csv.DictReader(file))
    return row, pixels(folder / "p.shadow.1.ppm")[::3], pixels(folder / "p.id.1.ppm")


def prove(binary, scene, lights, size):
    """Receivers, those that asked a ray, wrong shadows, pixels that see another triangle."""
    receivers = asked = wrong = other = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for camera, toward in cameras(binary, scene):
            for light in [*list(directions(lights - 1)), toward]:
                options = [*camera, "--light", text_of(light), "--size", size]
                row, shadow, ids = render(binary, folder, scene, [*options, "--shadows", "exact"])
                _, true_shadow, true_ids = render(binary, folder, scene, [*options, "--method", "reference"])
                false_lit, false_shadow, others = wrong_pixels(shadow, ids, true_shadow, true_ids)
                receivers += int(row["pixels_hit"])
                asked += int(row["primary_shadow_rays"])
                wrong += false_lit + false_shadow
                other += others
    return receivers, asked, wrong, other


def scenes_of(arguments, triangles):
    for argument in arguments or [f"scene:{name},triangles={triangles}" for name in ("chess", "thin", "spheres")]:
        if Path(argument).is_dir():
            yield from sorted(str(path) for path in Path(argument).rglob("*") if path.suffix in (".obj", ".ply"))
        else:
            yield argument


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--lights", type=int, default=12)
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--build", type=Path, default=Path("build/release"))
    parser.add_argument("-o", "--output", type=Path, default=Path("docs/results/proof.md"))
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: chess, thin and spheres")
    args = parser.parse_args()
    binary = (args.build / "bin/hybridrt").resolve()
    total = [0, 0, 0, 0]
    lines = [text_before_tables(args.output),
             f"`scripts/shadow_proof.py`, {args.size} pixels, {args.lights} lights, 2 cameras.", "",
             "| scene | receivers | asked a ray | wrong shadows | other triangle |", "|---|---|---|---|---|"]

    def add_row(name, counts):
        receivers, asked, wrong, other = counts
        lines.append(f"| {name} | {receivers:,} | {100 * asked / max(receivers, 1):.1f} % | {wrong} | {other} |")
        print(lines[-1], file=sys.stderr, flush=True)

    for scene in scenes_of(args.scenes, 20000 if args.quick else 500000):
        counts = prove(binary, scene, args.lights, args.size)
        total = [a + b for a, b in zip(total, counts)]
        add_row(Path(scene).name if Path(scene).exists() else scene, counts)
    add_row("all", total)
    args.output.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 1 if total[2] or not total[0] else 0


if __name__ == "__main__":
    sys.exit(main())
