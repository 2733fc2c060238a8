"""The clock: whole jobs, from the start of a rival's process to its end, when the last picture is on disk."""
from __future__ import annotations

import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from .error import PeersError
from .rival import Rival
from .scenes import RaceScene

REPEATED_BELOW_S = 20  # longer runs are measured once


@dataclass
class Job:
    """Some frames of a scene by a rival: the seconds of each round."""
    scene: str
    rival: str
    frames: int
    seconds: list[float] = field(default_factory=list)
    parse_seconds: list[float] = field(default_factory=list)  # of them, spent on parsing the scene again for each frame
    estimated: bool = False  # from fewer frames

    def median_s(self) -> float:
        return statistics.median(self.seconds)


@dataclass(frozen=True)
class Plan:
    frames: list[int]  # ascending
    rounds: int
    threads: int
    estimate_above_s: float  # a run that would take longer is estimated, not measured


def race(scenes: list[RaceScene], rivals: list[Rival], plan: Plan) -> list[Job]:
    """All jobs, in turns: each round visits every scene and number of frames, and the rivals one after the other."""
    jobs: list[Job] = []
    for scene in scenes:
        for rival in rivals:
            jobs += [Job(scene.name, rival.key, frames) for frames in plan.frames]
    for turn in range(plan.rounds):
        for scene in scenes:
            for frames in plan.frames:
                first = turn % len(rivals)
                for rival in rivals[first:] + rivals[:first]:
                    visit(jobs, scene, rival, frames, plan)
    return jobs


def visit(jobs: list[Job], scene: RaceScene, rival: Rival, frames: int, plan: Plan) -> None:
    mine = [job for job in jobs if (job.scene, job.rival) == (scene.name, rival.key)]
    job = next(job for job in mine if job.frames == frames)
    if job.estimated or (job.seconds and job.median_s() > REPEATED_BELOW_S):
        return
    shorter = [j for j in mine if j.frames < frames and not j.estimated]
    if not job.seconds and len(shorter) >= 2:
        expected = [straight_on(shorter[-2:], "seconds", frames), straight_on(shorter[-2:], "parse_seconds", frames)]
        if expected[0] > plan.estimate_above_s:
            job.seconds, job.parse_seconds, job.estimated = [expected[0]], [expected[1]], True
            return
    seconds, parse_seconds = run(scene, rival, frames, plan.threads)
    job.seconds.append(seconds)
    job.parse_seconds.append(parse_seconds)
    print(f"{scene.name}, {rival.name}, {frames} frames: {seconds:.2f} s", file=sys.stderr, flush=True)


def straight_on(two: list[Job], values: str, frames: int) -> float:
    """The straight line through two jobs' medians, at `frames`."""
    (x0, y0), (x1, y1) = ((job.frames, statistics.median(getattr(job, values))) for job in two)
    return y1 + (frames - x1) * (y1 - y0) / (x1 - x0)


def run(scene: RaceScene, rival: Rival, frames: int, threads: int) -> tuple[float, float]:
    """Seconds in all and of parsing. Raises PeersError where a rival fails or pictures are missing."""
    output = pictures_folder(scene, rival)
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir()
    log_path = scene.folder / f"{rival.key}.log"
    with open(log_path, "w", encoding="utf-8") as log:
        start = time.monotonic()
        for command in rival.commands(scene, frames, threads, output):
            if subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode:
                raise PeersError(f"{scene.name}: {rival.name} failed; see {log_path}")
        seconds = time.monotonic() - start
    if len(pictures(scene, rival)) != frames:
        raise PeersError(f"{scene.name}: {rival.name} wrote {len(pictures(scene, rival))} of {frames} pictures; see {log_path}")
    parsed = rival.parse_seconds(log_path.read_text(encoding="utf-8", errors="replace")) if rival.parse_seconds else 0.0
    return seconds, parsed


def pictures_folder(scene: RaceScene, rival: Rival) -> Path:
    return scene.folder / f"{rival.key}.out"


def pictures(scene: RaceScene, rival: Rival) -> list[Path]:
    """Of the latest run, in order."""
    return sorted(pictures_folder(scene, rival).glob("*.png"))


def steady_ms(jobs: list[Job]) -> float | None:
    """A frame more, without what is parsed again for each: by the longest measured job and the next shorter one."""
    measured = [job for job in jobs if job.seconds and not job.estimated]
    if len(measured) < 2:
        return None
    few, many = measured[-2:]
    whole, parsing = (statistics.median(many_s) - statistics.median(few_s) for many_s, few_s in
                      ((many.seconds, few.seconds), (many.parse_seconds, few.parse_seconds)))
    return 1000 * (whole - parsing) / (many.frames - few.frames)
