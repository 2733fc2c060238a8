#!/usr/bin/env python3
"""From the start of a process to its first picture on disk, against what that takes at least; writes a table.

  scripts/first_image.py [--build build/release] [--size 1024x768] [--rounds 5] [--threads 2]
                         [-o docs/results/first_image.md] [SCENE ...]

At least: reading the scene and building what a frame needs, each on its own with all threads (memory_bench), and one warm
frame (the median of a sequence's later frames). Runs take turns; medians, in brackets the least and the most.
A procedural scene is written as an OBJ first (hybridrt scene).
"""
import argparse
import csv
import json
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from results_file import processor, text_before_tables

SCENES = ["scene:spheres,triangles=500000", "scene:thin,triangles=500000"]
STRUCTURES = ("scene", "topology", "sheets", "clusters", "light buffer")


def as_file(hybridrt, scene, folder):
    if not scene.startswith("scene:"):
        return scene
    file = folder / (scene.split(":")[1].split(",")[0] + ".obj")
    subprocess.run([hybridrt, "scene", scene.removeprefix("scene:"), "-o", file], check=True, stdout=subprocess.DEVNULL)
    return str(file)


def structures_ms(memory_bench, file, threads):
    text = subprocess.run([memory_bench, f"--threads={threads}", file], check=True, capture_output=True, text=True).stdout
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return {row["structure"]: float(row["ms"]) for row in rows}


class Runs:
    """hybridrt render of one scene."""

    def __init__(self, hybridrt, file, options, folder):
        self.folder = folder
        self.command = [hybridrt, "render", file, "-q", "--gl", "off", "--size", options.size, "--threads",
                        str(options.threads), "-o", folder / "f.####.png"]

    def whole_ms(self):
        """One frame, from outside; what run.json says about it."""
        begin = time.monotonic()
        subprocess.run([*self.command, "--frames", "1"], check=True)
        whole = 1000 * (time.monotonic() - begin)
        return whole, json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    def warm_frame_ms(self):
        subprocess.run([*self.command, "--frames", "8"], check=True)
        with open(self.folder / "timings.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return statistics.median(float(row["wall_ms"]) + float(row["write_ms"]) for row in rows[2:])


def spread(values):
    return f"{statistics.median(values):.0f} ({min(values):.0f}–{max(values):.0f})"


def lines_of(scene, options, folder):
    file = as_file(options.build / "bin/hybridrt", scene, folder)
    runs = Runs(options.build / "bin/hybridrt", file, options, folder)
    wholes, facts, parts, frames = [], [], [], []
    for _ in range(options.rounds):
        whole, fact = runs.whole_ms()
        wholes.append(whole)
        facts.append(fact)
        parts.append(structures_ms(options.build / "bin/memory_bench", file, options.threads))
        frames.append(runs.warm_frame_ms())
    needs_rays = facts[0]["accel_build_ms"] > 0
    needed = [*STRUCTURES, *(["Embree"] if needs_rays else [])]
    least = [sum(part[name] for name in needed) + frame for part, frame in zip(parts, frames)]
    ratio = [whole / bound for whole, bound in zip(wholes, least)]
    yield (f"| {scene.split('/')[-1]} | {spread(wholes)} | {spread(least)} | **{statistics.median(ratio):.2f}** "
           f"({min(ratio):.2f}–{max(ratio):.2f}) |")
    yield ", ".join(f"{name} {statistics.median(part[name] for part in parts):.0f}" for name in needed) + \
        f", a warm frame with its file {statistics.median(frames):.0f}; the run itself: " + \
        ", ".join(f"`{key}` {statistics.median(fact[key] for fact in facts):.0f}"
                  for key in ("load_ms", "accel_build_ms", "ready_ms", "rendering_ms", "drain_ms"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=Path("build/release"))
    parser.add_argument("--size", default="1024x768")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("-o", "--output", type=Path, default=Path("docs/results/first_image.md"))
    parser.add_argument("scenes", nargs="*", default=SCENES)
    options = parser.parse_args()
    table, notes = [], []
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            row, note = lines_of(scene, options, Path(folder))
            table.append(row)
            notes.append(f"- {scene.split('/')[-1]}, milliseconds: {note}.")
            print(row, note, sep="\n", flush=True)
    options.output.write_text(text_before_tables(options.output) + "\n".join([
        "", f"`scripts/first_image.py --size {options.size} --rounds {options.rounds} --threads {options.threads}`, {processor()}:", "",
        "| OBJ | first picture on disk, ms | at least, ms | ratio |", "|---|---|---|---|", *table, "", *notes, ""]),
        encoding="utf-8")


if __name__ == "__main__":
    main()
