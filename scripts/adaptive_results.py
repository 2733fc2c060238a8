#!/usr/bin/env python3
"""Measures --adaptive and writes docs/results/adaptive.md.

  scripts/adaptive_results.py [--build build/release] [--size 1024x768] [--rounds 5] [-o docs/results/adaptive.md] [SCENE ...]

The error is that against all 16 samples everywhere; times are medians of rounds in turns (hybridrt sweep).
"""
import argparse
import csv
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from results_file import text_before_tables

SCENES = ["scene:spheres,triangles=500000", "scene:chess,triangles=500000", "scene:thin,triangles=500000",
          "../shared/scenes/sibenik/sibenik.obj"]
MOST = 16


def rows_of(binary, scene, options, rounds, folder):
    truth = folder / "truth"
    common = [scene, *options, "--frames", "3", "--frames-in-flight", "1", "--reflection-depth", "1", "--gl", "off"]
    subprocess.run([binary, "render", *common, "-q", "--samples", str(MOST), "-o", truth / "f.####.png"], check=True)
    subprocess.run([binary, "sweep", *common, "--over", f"samples=1,8,{MOST}", "--over", "adaptive=false,true", "--rounds",
                    str(rounds), "--truth", truth, "--no-charts", "-o", folder / "sweep"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(folder / "sweep" / "sweep.csv", newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if not row["error"]]


def table(rows, pixels):
    def of(samples, adaptive):
        return [row for row in rows if row["samples"] == str(samples) and row["adaptive"] == adaptive]

    def ms(chosen):
        return statistics.median(float(row["wall_ms"]) for row in chosen)

    one = ms(of(1, "false"))
    for samples, adaptive in ((1, "false"), (8, "true"), (8, "false"), (MOST, "true"), (MOST, "false")):
        chosen = of(samples, adaptive)
        worst = min(float(row["psnr_db"]) for row in chosen)
        share = statistics.median(int(row["pixels_resampled"]) for row in chosen) / pixels
        times = sorted(float(row["wall_ms"]) for row in chosen)
        yield (f"| {samples}{' adaptive' if adaptive == 'true' else ''} | {f'{100 * share:.1f} %' if share else ''} | "
               f"{'' if worst == float('inf') else f'{worst:.1f}'} | {ms(chosen):.1f} ({times[0]:.1f}–{times[-1]:.1f}) | "
               f"{ms(chosen) / one:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=Path("build/release"))
    parser.add_argument("--size", default="1024x768")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("-o", "--output", type=Path, default=Path("docs/results/adaptive.md"))
    parser.add_argument("scenes", nargs="*", default=SCENES)
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    text = text_before_tables(options.output)
    for scene in options.scenes:
        if not scene.startswith("scene:") and not Path(scene).exists():
            print(f"{scene} is not here and left out", file=sys.stderr)
            continue
        with tempfile.TemporaryDirectory() as folder:
            rows = rows_of(options.build / "bin" / "hybridrt", scene, ["--size", options.size], options.rounds, Path(folder))
        text += f"\n`{Path(scene).name}`\n\n| samples | pixels with all | PSNR, dB | ms (least–most) | times one sample |\n"
        text += "|---|---|---|---|---|\n" + "\n".join(table(rows, width * height)) + "\n"
        print(scene, file=sys.stderr)
    options.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
