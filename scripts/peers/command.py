"""The command: prepares scenes, races, writes the table, the JSON beside it and the pictures."""
from __future__ import annotations

import argparse
import dataclasses
import json
import math
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from results_file import processor, text_before_tables

from . import scenes as race_scenes
from .error import PeersError
from .race import Plan, pictures, race
from .rival import Rival, all_rivals
from .side_by_side import draw
from .table import tables, target_lines

ROOT = Path(__file__).resolve().parent.parent.parent


def parse(arguments: Sequence[str], about: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="peers.py", description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="hybrid,raytrace,povray,cycles,f3d", metavar="LIST", help="rivals (default: %(default)s)")
    parser.add_argument("--scenes", default="spheres,chess,sibenik", metavar="LIST", help="default: %(default)s")
    parser.add_argument("--frames", default="1,12,100", metavar="LIST", help="numbers of frames, at most 100 (default: %(default)s)")
    parser.add_argument("--rounds", type=int, default=3, help="for runs under 20 seconds; longer ones are measured once (default: %(default)s)")
    parser.add_argument("--estimate-slow", type=float, default=math.inf, metavar="S",
                        help="runs that would take longer than S seconds are estimated from fewer frames and marked (default: none)")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), help="default: all (%(default)s)")
    parser.add_argument("--size", default="1024x768", metavar="WxH", help="default: %(default)s")
    parser.add_argument("--triangles", type=int, default=500000, metavar="N", help="of scenes that are made (default: %(default)s)")
    parser.add_argument("--sibenik", type=Path, default=ROOT / "../shared/scenes/sibenik/sibenik.obj", metavar="FILE.obj",
                        help="the cathedral's OBJ, which is not part of the project; without the file the scene is left out")
    parser.add_argument("--hybridrt", type=Path, default=ROOT / "build/release/bin/hybridrt", metavar="FILE")
    parser.add_argument("--work", type=Path, default=ROOT / "out/peers", metavar="DIR", help="scenes, pictures, logs: a folder a scene")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.md",
                        help="the page; text above its tables is kept (default: DIR/peers.md). The JSON goes to DIR/peers.json")
    parser.add_argument("--images", type=Path, metavar="DIR", help="where pictures side by side go (default: beside the page)")
    parser.add_argument("--install", action="store_true", help="install the rivals' Debian packages first")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str], about: str) -> int:
    """Returns the exit code."""
    try:
        run(parse(arguments, about))
    except PeersError as error:
        print(f"peers.py: {error}", file=sys.stderr)
        return 3
    return 0


def run(options: argparse.Namespace) -> None:
    hybridrt = options.hybridrt.resolve()
    if not hybridrt.exists():
        raise PeersError(f"{hybridrt}: not there; scripts/build.sh release builds it")
    work = options.work.resolve()
    plan = Plan(numbers(options.frames), options.rounds, options.threads, options.estimate_slow)
    require_scenes(options)
    rivals, left_out = chosen_rivals(options, hybridrt)
    scenes = prepared_scenes(options, hybridrt, work, rivals, left_out)
    jobs = race(scenes, rivals, plan)
    write_json(work / "peers.json", options, scenes, rivals, jobs)

    page = options.output or work / "peers.md"
    images = options.images or page.parent
    links, psnr_db = {}, {}
    for scene in scenes:
        first = {rival.key: pictures(scene, rival)[0] for rival in rivals}
        for key in first.keys() - {"hybrid"} if "hybrid" in first else ():
            psnr_db[scene.name, key] = psnr(hybridrt, first[key], first["hybrid"])
        shown = [rival for rival in rivals if rival.key != "raytrace" or "hybrid" not in first]
        image = images / f"peers-{scene.name}.png"
        if draw([rival.name for rival in shown], [first[rival.key] for rival in shown], image):
            links[scene.name] = os.path.relpath(image, page.parent)
    lines = [text_before_tables(page), command_line(options), ""]
    lines += ["; ".join(dict.fromkeys(rival.version_line() for rival in rivals)) + f". {processor()}, {plan.threads} threads.", ""]
    lines += [f"Left out: {'; '.join(left_out)}.", ""] if left_out else []
    lines += target_lines(scenes, rivals, jobs) + tables(scenes, rivals, jobs, psnr_db, links)
    page.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print(page)


def chosen_rivals(options: argparse.Namespace, hybridrt: Path) -> tuple[list[Rival], list[str]]:
    """Those that can run, and why the others cannot. Raises PeersError where one is not installed."""
    rivals = all_rivals(hybridrt)
    keys = options.only.split(",")
    if unknown := set(keys) - {rival.key for rival in rivals}:
        raise PeersError(f"--only {options.only}: no rival is called {sorted(unknown)[0]}; there are {', '.join(r.key for r in rivals)}")
    rivals = [rival for rival in rivals if rival.key in keys]
    packages = [rival.package for rival in rivals if rival.package and not rival.is_installed()]
    if packages and options.install:
        install = [*([] if os.geteuid() == 0 else ["sudo"]), "apt-get", "install", "-y", "--no-install-recommends", *packages]
        if subprocess.run(install, stdout=subprocess.DEVNULL).returncode:
            raise PeersError(f"{' '.join(install)}: failed")
    elif packages:
        raise PeersError(f"not installed: {', '.join(packages)}; add --install, or choose others by --only")
    reasons = {rival.key: rival.can_run() for rival in rivals}
    return ([rival for rival in rivals if reasons[rival.key] is None],
            [f"{rival.name}, which {reasons[rival.key]}" for rival in rivals if reasons[rival.key] is not None])


def require_scenes(options: argparse.Namespace) -> None:
    if unknown := [name for name in options.scenes.split(",") if name not in race_scenes.LOOKS]:
        raise PeersError(f"--scenes {options.scenes}: no scene is called {unknown[0]}; there are {', '.join(race_scenes.LOOKS)}")


def prepared_scenes(options: argparse.Namespace, hybridrt: Path, work: Path, rivals: Sequence[Rival],
                    left_out: list[str]) -> list[race_scenes.RaceScene]:
    width, height = (int(side) for side in options.size.split("x"))
    scenes = []
    for name in options.scenes.split(","):
        if name == "sibenik" and not options.sibenik.exists():
            left_out.append(f"sibenik, as {options.sibenik.name} is not there (--sibenik FILE.obj)")
            continue
        print(f"preparing {name}", file=sys.stderr, flush=True)
        scene = race_scenes.prepare(name, hybridrt, work / name, options.triangles, (width, height), options.sibenik.resolve())
        for rival in rivals:
            rival.prepare(scene)
        scenes.append(scene)
    return scenes


def numbers(text: str) -> list[int]:
    values = sorted({int(n) for n in text.split(",")})
    if values[0] < 1 or values[-1] > 100:
        raise PeersError(f"--frames {text}: write numbers from 1 to 100")
    return values


def psnr(hybridrt: Path, picture: Path, reference: Path) -> float:
    run = subprocess.run([hybridrt, "compare", picture, reference, "--json"], capture_output=True, text=True)
    if run.returncode not in (0, 6):
        raise PeersError(run.stderr.strip())
    value = json.loads(run.stdout)["psnr_db"]
    return math.inf if value is None else float(value)


def command_line(options: argparse.Namespace) -> str:
    words = [f"--{name} {getattr(options, name)}" for name in ("only", "scenes", "frames", "rounds", "threads", "size", "triangles")]
    slow = [] if math.isinf(options.estimate_slow) else [f"--estimate-slow {options.estimate_slow:g}"]
    return f"`scripts/peers.py {' '.join(words + slow)}`"


def write_json(path: Path, options: argparse.Namespace, scenes: Sequence[race_scenes.RaceScene], rivals: Sequence[Rival], jobs) -> None:
    facts = {"command": command_line(options).strip("`"), "processor": processor(),
             "versions": {rival.key: rival.version_line() for rival in rivals},
             "triangles": {scene.name: scene.triangles for scene in scenes},
             "jobs": [dataclasses.asdict(job) for job in jobs]}
    path.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
