#!/usr/bin/env python3
"""How near tune's choice is to the best of a full sweep.

    tests/bench/tune_check.py [--binary build/release/bin/hybridrt] [--size 320x240] [--out out/tune_check] [SCENE ...]

For each scene and goal, sweeps every method, shadow mode, kernel, map, depth and number of samples that tune may choose, takes
the fastest setting that meets the goal, then measures it and tune's choice in turns. Prints a Markdown table.
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess

SCENES = ["scene:chess,triangles=100k", "scene:spheres,triangles=100k", "scene:thin,triangles=100k"]
GOALS_DB = [30, 36]
TRUTH_SAMPLES = "16"


def rows_of(folder):
    with open(folder / "sweep.csv", newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if not row["error"]]


def grouped(rows):
    settings = {}
    for row in rows:
        settings.setdefault(row["setting"], []).append(row)
    return settings.values()


def median_ms(rows):
    return statistics.median(float(row["wall_ms"]) for row in rows)


def options_of(row):
    return {"method": row["method"], "shadows": row["shadows"], "reflection-depth": row["reflection_depth"],
            "samples": row["samples"], "shadow-map": row["shadow_map_px"], "blur-kernel": row["blur_kernel_px"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="build/release/bin/hybridrt")
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--out", default="out/tune_check")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    arguments = parser.parse_args()
    out = pathlib.Path(arguments.out)
    out.mkdir(parents=True, exist_ok=True)

    def run(*words):
        return subprocess.run([arguments.binary, *words], check=True, stdout=subprocess.PIPE, text=True).stdout

    print("| scene | goal | best of the sweep, ms | tune's choice, ms | tune / best |\n|---|---|---|---|---|")
    for scene in arguments.scenes:
        common = [scene, "--size", arguments.size]
        name = scene.split(":")[-1].split(",")[0]
        for part, over in (("exact", ["--over", "shadows=none,exact,rays"]),
                           ("map", ["--over", "shadows=map", "--over", "shadow-map=512,2048,8192"]),
                           ("blur", ["--over", "shadows=blur", "--over", "blur-kernel=3,9,31", "--over", "shadow-map=512,2048"])):
            run("sweep", *common, *over, "--over", "method=hybrid,raytrace,raster" if part != "blur" else "method=hybrid",
                "--over", "reflection-depth=1,4,16", "--over", "samples=1,2,4,8", "--truth-samples", TRUTH_SAMPLES,
                "--rounds", "2", "--no-charts", "-q", "-o", str(out / f"{name}-{part}"))
        rows = [row for part in ("exact", "map", "blur") for row in rows_of(out / f"{name}-{part}")]
        for goal in GOALS_DB:
            meeting = [rows for setting in grouped(rows) for rows in [setting]
                       if all(row["psnr_db"] == "inf" or float(row["psnr_db"]) >= goal for row in rows)]
            if not meeting:
                print(f"| {name} | {goal} dB | none | | |")
                continue
            best = options_of(min(meeting, key=median_ms)[0])
            tuned = json.loads(run("tune", *common, "--max-error", f"{goal}dB", "--truth-samples", TRUTH_SAMPLES, "-q"))
            files = []
            for label, options in (("best", best), ("tuned", tuned)):
                files.append(out / f"{name}-{goal}-{label}.json")
                files[-1].write_text(json.dumps(options))
            duel = out / f"{name}-{goal}-duel"
            run("sweep", *common, "--over", f"config={files[0]};{files[1]}", "--truth-samples", "0", "--rounds", "9",
                "--no-charts", "-q", "-o", str(duel))
            ms = [median_ms([row for row in rows_of(duel) if row["config"] == str(file)]) for file in files]
            print(f"| {name} | {goal} dB | {ms[0]:.1f} | {ms[1]:.1f} | {ms[1] / ms[0]:.2f} |", flush=True)


if __name__ == "__main__":
    main()
