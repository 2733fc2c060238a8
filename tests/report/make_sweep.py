"""Makes up a sweep that looks like a real one: sweep.csv, sweep.json and small pictures. The same seed, the same files.

    python3 tests/report/make_sweep.py DIR [--preset pareto|paper|scaling|growth|pixels|many|long]
"""
from __future__ import annotations

import argparse
import csv
import itertools
import json
import math
import random
from dataclasses import dataclass, field
from pathlib import Path

AXES = ("scene", "width_px", "height_px", "method", "shadows", "blur_kernel_px", "shadow_map_px", "shadow_warp",
        "reflection_depth", "samples", "accel", "threads", "frames_in_flight", "form", "triangles")
PASSES = ("shadow_map_ms", "id_ms", "mark_ms", "readback_ms", "trace_ms", "upload_ms", "shade_ms", "download_ms")
THREAD_TIMES = ("id_cpu_ms", "mark_cpu_ms", "trace_cpu_ms", "shade_cpu_ms", "shadow_cpu_ms", "secondary_cpu_ms")
COUNTS = ("pixels", "pixels_hit", "pixels_marked", "pixels_reflective", "pixels_refractive", "shadow_rays",
          "reflection_rays", "refraction_rays")
ACCURACY = ("rmse", "psnr_db", "max_error", "ssim", "pixels_different", "false_lit", "false_shadow", "other_triangle",
            "non_finite")
CHANGES_TRUTH = ("triangles", "reflection-percent", "width")
DEFAULTS = {"scene": "scene:spheres,triangles=500000", "width_px": "1024", "height_px": "768", "method": "hybrid",
            "shadows": "map", "blur_kernel_px": "5", "shadow_map_px": "2048", "shadow_warp": "lispsm",
            "reflection_depth": "1", "samples": "1", "accel": "embree", "threads": "8", "frames_in_flight": "2",
            "form": "gl", "triangles": "500000"}


@dataclass
class Sweep:
    """What to make. `axes`: texts per axis name; `failing`: reasons per setting number."""
    axes: dict[str, list[str]]
    rounds: int = 3
    frames: int = 2
    seed: int = 1
    accuracy: bool = True
    pictures: bool = True
    failing: dict[int, str] = field(default_factory=dict)
    facts: dict[str, object] = field(default_factory=dict)


PRESETS = {
    "pareto": Sweep({"method": ["hybrid", "raytrace", "rasterize"], "shadows": ["map", "blur", "rays", "exact"],
                     "shadow-map": ["512", "2048", "4096"]}, failing={5: "no GL context: EGL_BAD_ALLOC (0x3003)"}),
    "paper": Sweep({"reflection-percent": ["0", "5", "10", "25", "50", "75", "100"], "shadows": ["map", "exact"]}),
    "scaling": Sweep({"threads": ["1", "2", "4", "8", "16"], "method": ["hybrid", "raytrace"], "accel": ["embree", "kdtree"]},
                     accuracy=False),
    "growth": Sweep({"triangles": ["1000", "10000", "100000", "1000000", "10000000"], "shadows": ["map", "exact"]}),
    "pixels": Sweep({"size": ["1920x1080", "640x480", "7680x4320"], "method": ["hybrid", "raytrace"]}, accuracy=False),
    "many": Sweep({"triangles": ["1000", "100000", "1000000"], "shadows": ["map", "rays", "exact"],
                   "blur-kernel": ["3", "5", "9", "15"], "frames-in-flight": ["1", "2"]}, facts={"busy": 0.23}),
    "long": Sweep({"method": ["hybrid" + 30 * "_and_more", "raytrace with a name of many words " * 4],
                   "triangles": ["1234", "567890"]},
                  facts={"scene": "/home/somebody/models" + 12 * "/and_a_folder" + "/car.obj",
                         "gl_renderer": "NVIDIA H200/PCIe/SSE2"}),
}


def make_sweep(folder: Path, sweep: Sweep) -> None:
    chance = random.Random(sweep.seed)
    folder.mkdir(parents=True, exist_ok=True)
    columns = {name: name.replace("-", "_") for name in sweep.axes}
    combinations = [dict(zip(sweep.axes, values)) for values in itertools.product(*sweep.axes.values())]
    header = list(dict.fromkeys(["setting", "round", "frame", *columns.values(), *AXES, "wall_ms", "first_frame_ms", "load_ms",
                                 "accel_build_ms", "peak_memory_mib", *PASSES, *THREAD_TIMES, *COUNTS, *ACCURACY, "error"]))
    errors = [_error(values, chance) for values in combinations]
    with open(folder / "sweep.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, header, lineterminator="\n", restval="")
        writer.writeheader()
        for turn in range(1, sweep.rounds + 1):
            for number, values in enumerate(combinations, 1):
                start = {"setting": number, "round": turn, **DEFAULTS,
                         **{columns[name]: value for name, value in values.items()}}
                if number in sweep.failing:
                    writer.writerow({**start, "error": sweep.failing[number]})
                    continue
                for frame in range(1, sweep.frames + 1):
                    row = {**start, "frame": frame, **_times(values, chance)}
                    if sweep.accuracy:
                        row.update(_accuracy(errors[number - 1] * (1 + 0.01 * frame)))
                    writer.writerow(row)
    (folder / "sweep.json").write_text(json.dumps(_facts(folder, sweep, columns, combinations), indent=1), encoding="utf-8")


def _number(values: dict[str, str], name: str, default: float) -> float:
    try:
        return float(values.get(name, default))
    except ValueError:
        return default


def _times(values: dict[str, str], chance: random.Random) -> dict[str, object]:
    """Of one frame: pass 4 over the threads, passes 1 and 2 over the triangles, with a few percent of noise."""
    triangles, threads = _number(values, "triangles", 5e5), _number(values, "threads", 8)
    mirrors = _number(values, "reflection-percent", 10)
    method, shadows = values.get("method", "hybrid"), values.get("shadows", "map")
    kernel, map_px = _number(values, "blur-kernel", 5), _number(values, "shadow-map", 2048)
    rays = {"map": 0, "blur": 2 + 0.5 * kernel, "rays": 30, "exact": 6}.get(shadows, 5)
    primary = 45 if method == "raytrace" else 0
    slow = 1.7 if values.get("accel") == "kdtree" else 1
    traced = slow * (rays + primary + 0.9 * mirrors ** 1.15) * (1 + 0.09 * math.log10(triangles))
    traced *= 8 / threads * (1 + 0.02 * threads)
    raster = method != "raytrace"
    times = {
        "shadow_map_ms": raster * (1 + 8e-6 * triangles + 1.2e-7 * map_px ** 2), "id_ms": raster * (2 + 1.4e-5 * triangles),
        "mark_ms": raster * (0.4 + 0.05 * kernel), "readback_ms": raster * 0.9, "trace_ms": traced, "upload_ms": raster * 0.8,
        "shade_ms": 3.4 if raster else 0.0, "download_ms": raster * 1.1}
    times = {name: time * math.exp(chance.gauss(0, 0.04)) for name, time in times.items()}
    overlap = 0.75 if values.get("frames-in-flight", "2") == "2" else 1.02
    wall = overlap * sum(times.values()) * math.exp(chance.gauss(0, 0.02))
    share = min(0.78, mirrors / 128) * (1 + chance.gauss(0, 0.001))
    pixels = 1024 * 768
    return {**{name: f"{time:.4f}" for name, time in times.items()}, "wall_ms": f"{wall:.4f}",
            "first_frame_ms": f"{wall * 3 + 20:.4f}", "load_ms": "139.2000",
            "accel_build_ms": f"{triangles * 2.2e-4 * slow:.4f}", "peak_memory_mib": f"{20 + 3.4e-4 * triangles:.1f}",
            "pixels": pixels, "pixels_hit": int(0.91 * pixels),
            "pixels_marked": int(0.04 * pixels), "pixels_reflective": int(share * pixels), "pixels_refractive": 0,
            "shadow_rays": int(rays * 1000), "reflection_rays": int(share * pixels), "refraction_rays": 0,
            **{name: f"{0.98 * threads * traced / 6:.4f}" for name in THREAD_TIMES}}


def _error(values: dict[str, str], chance: random.Random) -> float:
    if values.get("shadows") in ("exact", "rays") and values.get("method", "hybrid") != "rasterize":
        return 0.0 if values["shadows"] == "exact" else 2.1e-5 * math.exp(chance.gauss(0, 0.3))
    base = 0.02 if values.get("shadows", "map") == "map" else 0.004 / _number(values, "blur-kernel", 5)
    return base * (2048 / _number(values, "shadow-map", 2048)) ** 0.7 * math.exp(chance.gauss(0, 0.2))


def _accuracy(rmse: float) -> dict[str, object]:
    wrong = int(rmse * 4e5)
    return {"rmse": f"{rmse:.9g}", "psnr_db": "inf" if rmse == 0 else f"{-20 * math.log10(rmse):.6f}",
            "max_error": f"{min(1.0, rmse * 40):.6g}", "ssim": f"{1 - rmse:.9g}", "pixels_different": wrong,
            "false_lit": wrong // 3, "false_shadow": wrong // 5, "other_triangle": wrong // 50, "non_finite": 0}


def _facts(folder: Path, sweep: Sweep, columns: dict[str, str], combinations: list[dict[str, str]]) -> dict[str, object]:
    settings = []
    truths: dict[tuple[str, ...], str] = {}
    for number, values in enumerate(combinations, 1):
        entry: dict[str, object] = {
            "number": number, "label": " ".join(f"{name}={value}" for name, value in values.items()),
            "picture": None, "difference": None, "amplification": 8, "truth": None}
        if sweep.pictures and number not in sweep.failing:
            scene = tuple(values[name] for name in values if name in CHANGES_TRUTH)
            truth = truths.setdefault(scene, f"pictures/truth-{len(truths):04x}.png")
            entry.update(picture=f"pictures/{number:04}.png", difference=f"pictures/{number:04}.difference.png", truth=truth)
            _pictures(folder, entry, number, sweep.seed)
        settings.append(entry)
    return {
        "version": "1.1.0", "commit": "f9abebc", "compiler": "GCC 12.2.0", "scene": "scene:spheres",
        "command_line": ["hybridrt", "sweep", "scene:spheres",
                         *[f"--{name}={','.join(values)}" for name, values in sweep.axes.items()]],
        "date": "2026-03-01T12:00:00Z", "processor": "AMD EPYC 7R13 Processor", "threads": 8,
        "gl_renderer": "llvmpipe (LLVM 15.0.6, 256 bits)", "busy": 0.02, "rounds": sweep.rounds,
        "frames": f"1-{sweep.frames}" if sweep.frames > 1 else "1", "preset": None,
        "truth": {"method": "reference", "samples": 1, "kind": "reference" if sweep.accuracy else "none",
                  "note": "the method's error without aliasing" if sweep.accuracy else ""},
        "axes": [{"name": name, "column": columns[name], "values": values, "changes_truth": name in CHANGES_TRUTH}
                 for name, values in sweep.axes.items()],
        "settings": settings, **sweep.facts}


def _pictures(folder: Path, entry: dict[str, object], number: int, seed: int) -> None:
    """Balls on a floor; a setting's picture differs from the truth a little along the balls' edges."""
    from PIL import Image, ImageChops, ImageDraw

    (folder / "pictures").mkdir(exist_ok=True)

    def balls(shift: float) -> Image.Image:
        chance = random.Random(seed)
        image = Image.linear_gradient("L").resize((160, 120)).convert("RGB")
        draw = ImageDraw.Draw(image)
        for _ in range(12):
            x, y, r = chance.uniform(0, 160), chance.uniform(40, 110), chance.uniform(5, 22)
            colour = tuple(chance.randrange(40, 255) for _ in range(3))
            draw.ellipse((x - r, y + 0.6 * r, x + 1.4 * r + shift, y + r), fill=(20, 20, 24))
            draw.ellipse((x - r, y - r, x + r, y + r), fill=colour)
        return image

    truth, picture = balls(0), balls(number % 4)
    truth.save(folder / str(entry["truth"]))
    picture.save(folder / str(entry["picture"]))
    ImageChops.difference(truth, picture).point(lambda value: min(255, 8 * value)).save(folder / str(entry["difference"]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--preset", choices=PRESETS, default="pareto")
    arguments = parser.parse_args()
    make_sweep(arguments.folder, PRESETS[arguments.preset])


if __name__ == "__main__":
    main()
