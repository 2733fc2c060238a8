#!/usr/bin/env python3
"""How near tune's choice is to the best of a full sweep.

    tests/bench/tune_check.py [--binary build/release/bin/hybridrt] [--size 320x240] [--out out/tune_check] [SCENE ...]

For each scene, sweeps every method, shadow mode, kernel, map, depth and number of samples, everywhere or at edges, that tune
may choose, from few samples to many. What is already slower than the best for every goal by half is not tried with more samples: those only
add time. For each goal the fastest setting that meets it and tune's choice are then measured in turns. Prints a Markdown
table; rows stay in the folder.
"""
import argparse
import csv
import itertools
import json
import math
import pathlib
import shutil
import statistics
import subprocess

SCENES = ["scene:chess,triangles=100k", "scene:spheres,triangles=100k", "scene:thin,triangles=100k"]
GOALS_DB = [30, 36]
TRUTH_SAMPLES = 16
DEPTHS = [0, 1, 2, 4, 8, 16]
HOPELESS = 1.5  # times the best


def settings_with_one_sample():
    shadows = {"hybrid": ["none", "exact", "rays", "map", "blur"], "raytrace": ["none", "rays"], "raster": ["none", "map"]}
    maps = {"map": [{"shadow-map": size} for size in (512, 2048, 8192)],
            "blur": [{"shadow-map": size, "blur-kernel": kernel} for size in (512, 2048) for kernel in (3, 9, 31)]}
    for method, depth in itertools.product(shadows, DEPTHS):
        if method == "raster" and depth > 0:
            continue  # it has no rays
        for mode in shadows[method]:
            for more in maps.get(mode, [{}]):
                yield {"method": method, "shadows": mode, "reflection-depth": depth, **more}


class Checker:
    def __init__(self, arguments, scene):
        self.binary, self.scene, self.size = arguments.binary, scene, arguments.size
        self.name = scene.split(":")[-1].split(",")[0]
        self.out = pathlib.Path(arguments.out) / self.name
        self.out.mkdir(parents=True, exist_ok=True)

    def run(self, *words):
        return subprocess.run([self.binary, *words], check=True, stdout=subprocess.PIPE, text=True).stdout

    def sweep(self, part, settings, rounds, *more):
        """The median time and the least PSNR of each of the settings."""
        files = []
        for i, setting in enumerate(settings):
            files.append(self.out / f"{part}-{i}.json")
            files[-1].write_text(json.dumps(setting))
        folder = self.out / part
        self.run("sweep", self.scene, "--size", self.size, "--over", "config=" + ";".join(map(str, files)),
                 "--rounds", str(rounds), "--no-charts", "-q", "-o", str(folder), *more)
        with open(folder / "sweep.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        results = []
        for path in files:
            own = [row for row in rows if row["config"] == str(path)]
            times = [float(row["wall_ms"]) for row in own if row["wall_ms"]]
            decibels = [float(row["psnr_db"]) for row in own if row["psnr_db"]]
            results.append((statistics.median(times), min(decibels, default=math.nan)))
        return results

    def kept_truth(self):
        """The first sweep's, for those that follow."""
        picture, = (self.out / "samples-1" / "truth").iterdir()
        folder = self.out / "truth"
        folder.mkdir(exist_ok=True)
        shutil.copy(picture, folder / "0001.png")
        return ["--truth", str(folder)]

    def best_of_sweep(self):
        """For each goal the fastest setting that meets it, or None."""
        best = {goal: (math.inf, None) for goal in GOALS_DB}
        tried = list(settings_with_one_sample())
        truth, counts = [], []
        samples = 1
        while samples <= TRUTH_SAMPLES // 2 and tried:
            settings = [{**setting, "samples": samples} for setting in tried]
            if samples > 1:
                settings += [{**setting, "adaptive": "true"} for setting in settings if setting["shadows"] not in ("map", "blur")]
            counts.append(len(settings))
            results = self.sweep(f"samples-{samples}", settings, 2, *(truth or ["--truth-samples", str(TRUTH_SAMPLES)]))
            if samples == 1:
                truth = self.kept_truth()
            for setting, (ms, decibels) in zip(settings, results):
                for goal in GOALS_DB:
                    if decibels >= goal and ms < best[goal][0]:
                        best[goal] = (ms, setting)
            slowest_best = max(ms for ms, _ in best.values())
            tried = [setting for setting, (ms, _) in zip(tried, results) if ms < HOPELESS * slowest_best]
            samples *= 2
        print(f"{self.name}: {' + '.join(map(str, counts))} settings", flush=True)
        return {goal: setting for goal, (_, setting) in best.items()}

    def tuned(self, goal):
        return json.loads(self.run("tune", self.scene, "--size", self.size, "--max-error", f"{goal}dB", "--truth-samples",
                                   str(TRUTH_SAMPLES), "-q"))

    def rows(self):
        for goal, best in self.best_of_sweep().items():
            if best is None:
                yield f"| {self.name} | {goal} dB | none | | |"
                continue
            (best_ms, _), (tuned_ms, _) = self.sweep(f"duel-{goal}", [best, self.tuned(goal)], 15, "--truth-samples", "0")
            yield f"| {self.name} | {goal} dB | {best_ms:.1f} | {tuned_ms:.1f} | {tuned_ms / best_ms:.2f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="build/release/bin/hybridrt")
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--out", default="out/tune_check")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    arguments = parser.parse_args()
    table = [row for scene in arguments.scenes for row in Checker(arguments, scene).rows()]
    print("\n| scene | goal | best of the sweep, ms | tune's choice, ms | tune / best |\n|---|---|---|---|---|")
    print("\n".join(table))


if __name__ == "__main__":
    main()
