"""What was measured, as Markdown."""
from __future__ import annotations

from collections.abc import Sequence

from .race import Job, steady_ms
from .rival import Rival
from .scenes import RaceScene

WHOLE_TARGETS = {1: 3, 100: 20}  # times as fast as each rival, by the number of frames
STEADY_TARGET = 20


def tables(scenes: Sequence[RaceScene], rivals: Sequence[Rival], jobs: Sequence[Job], psnr_db: dict[tuple[str, str], float],
           images: dict[str, str]) -> list[str]:
    """One section a scene; `images` are links to the pictures, `psnr_db` says how like hybrid's a rival's first picture is."""
    lines: list[str] = []
    for scene in scenes:
        of_rival = {rival.key: [job for job in jobs if (job.scene, job.rival) == (scene.name, rival.key)] for rival in rivals}
        frames = [job.frames for job in next(iter(of_rival.values()))]
        width, height = scene.size_px
        lines += [f"## {scene.name}", "",
                  f"{scene.triangles:,} triangles, {width}×{height}, depth {scene.look.depth}. "
                  "Seconds of whole jobs; in brackets how many times as long as `hybrid`'s.", ""]
        lines += row(["", *(f"{n} frame{'s' if n > 1 else ''}" for n in frames), "a frame more, ms", "PSNR to `hybrid`, dB"])
        lines += row(["---"] * (len(frames) + 3))
        for rival in rivals:
            mine, base = of_rival[rival.key], of_rival.get("hybrid")
            cells = [whole_cell(job, base[i] if base and base is not mine else None) for i, job in enumerate(mine)]
            cells.append(steady_cell(steady_ms(mine), steady_ms(base) if base and base is not mine else None))
            cells.append(f"{psnr_db[scene.name, rival.key]:.1f}" if (scene.name, rival.key) in psnr_db else "–")
            lines += row([f"`{rival.name}`" if rival.package is None else rival.name, *cells])
        lines.append("")
        if scene.name in images:
            lines += [f"![{scene.name}: the pictures side by side]({images[scene.name]})", ""]
    return lines


def row(cells: Sequence[str]) -> list[str]:
    return ["| " + " | ".join(cells) + " |"]


def whole_cell(job: Job, base: Job | None) -> str:
    """Median, spread, and ratio; ≈ where it is estimated."""
    text = f"{'≈ ' if job.estimated else ''}{job.median_s():.2f}"
    if len(job.seconds) > 1:
        text += f" ({min(job.seconds):.2f}–{max(job.seconds):.2f})"
    return text + (f" **[{job.median_s() / base.median_s():.1f} ×]**" if base else "")


def steady_cell(ms: float | None, base_ms: float | None) -> str:
    if ms is None or ms <= 0:  # runs too short to tell
        return "–"
    return f"{ms:.1f}" + (f" **[{ms / base_ms:.1f} ×]**" if base_ms and base_ms > 0 else "")


def target_lines(scenes: Sequence[RaceScene], rivals: Sequence[Rival], jobs: Sequence[Job]) -> list[str]:
    """Which targets are met against those that draw the same picture."""
    lines = row(["hybrid against", *(f"{n} frame{'s' if n > 1 else ''}: ≥ {t} ×" for n, t in WHOLE_TARGETS.items()),
                 f"a frame more: ≥ {STEADY_TARGET} ×"]) + row(["---"] * (len(WHOLE_TARGETS) + 2))
    for rival in (r for r in rivals if r.key in ("povray", "cycles")):
        for scene in scenes:
            mine, base = ([j for j in jobs if (j.scene, j.rival) == (scene.name, key)] for key in (rival.key, "hybrid"))
            if not base:
                return []
            estimated = {job.frames for job in [*mine, *base] if job.estimated}
            cells = [("≈ " if n in estimated else "") + verdict(whole_ratio(mine, base, n), target) for n, target in WHOLE_TARGETS.items()]
            ours, theirs = steady_ms(base), steady_ms(mine)
            cells.append(verdict(theirs / ours if theirs and ours and ours > 0 else None, STEADY_TARGET))
            lines += row([f"{rival.name}, {scene.name}", *cells])
    return lines + [""] if len(lines) > 2 else []


def whole_ratio(mine: Sequence[Job], base: Sequence[Job], frames: int) -> float | None:
    pairs = [(a, b) for a, b in zip(mine, base) if a.frames == frames]
    return pairs[0][0].median_s() / pairs[0][1].median_s() if pairs else None


def verdict(ratio: float | None, target: float) -> str:
    return "–" if ratio is None else f"{ratio:.1f} × {'met' if ratio >= target else 'missed'}"
