"""hybridrt's own runs: one process for all frames, all passes on the CPU, as the others' are."""
from __future__ import annotations

from pathlib import Path

from .scenes import RaceScene


def commands(hybridrt: Path, method: str, scene: RaceScene, frames: int, threads: int, output: Path) -> list[list[str]]:
    return [[str(hybridrt), "render", str(scene.folder / "scene.json"), "--method", method, "--gl", "off",
             "--frames", str(frames), "--size", f"{scene.size_px[0]}x{scene.size_px[1]}", "--threads", str(threads),
             "--reflection-depth", str(scene.look.depth), "-q", "-o", str(output / "frame.####.png")]]
