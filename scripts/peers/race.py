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
    frame_seconds: list[float] = field(default_factory=list)  # of each frame of the first round, by the rival's own account
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
        expected = straight_on(shorter[-2], shorter[-1], frames)
        if expected > plan.estimate_above_s:
            job.seconds, job.estimated = [expected], True
            return
    seconds, log = run(scene, rival, frames, plan.threads)
    job.seconds.append(seconds)
    if rival.frame_seconds and not job.frame_seconds:
        job.frame_seconds = rival.frame_seconds(log)
    print(f"{scene.name}, {rival.name}, {frames} frames: {seconds:.2f} s", file=sys.stderr, flush=True)


def straight_on(few: Job, many: Job, frames: int) -> float:
    """Seconds for `frames` by the straight line through two jobs' medians."""
    return many.median_s() + (frames - many.frames) * (many.median_s() - few.median_s()) / (many.frames - few.frames)


def run(scene: RaceScene, rival: Rival, frames: int, threads: int) -> tuple[float, str]:
    """Seconds, and what the rival said. Raises PeersError where a rival fails or pictures are missing."""
    output = pictures_folder(scene, rival)
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir()
    log_path = scene.folder / f"{rival.key}.{frames}.log"
    with open(log_path, "w", encoding="utf-8") as log:
        start = time.monotonic()
        for command in rival.commands(scene, frames, threads, output):
            if subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode:
                raise PeersError(f"{scene.name}: {rival.name} failed; see {log_path}")
        seconds = time.monotonic() - start
    if len(pictures(scene, rival)) != frames:
        raise PeersError(f"{scene.name}: {rival.name} wrote {len(pictures(scene, rival))} of {frames} pictures; see {log_path}")
    return seconds, log_path.read_text(encoding="utf-8", errors="replace")


def pictures_folder(scene: RaceScene, rival: Rival) -> Path:
    return scene.folder / f"{rival.key}.out"


def pictures(scene: RaceScene, rival: Rival) -> list[Path]:
    """Of the latest run, in order."""
    return sorted(pictures_folder(scene, rival).glob("*.png"))


def steady_ms(jobs: list[Job]) -> float | None:
    """A frame more: by the longest measured job and the next shorter one, or by the rival's account of its frames."""
    measured = [job for job in jobs if job.seconds and not job.estimated]
    if measured and measured[-1].frame_seconds:
        return 1000 * statistics.median(measured[-1].frame_seconds)
    if len(measured) < 2:
        return None
    few, many = measured[-2:]
    return 1000 * (many.median_s() - few.median_s()) / (many.frames - few.frames)
