"""What the race knows about a renderer."""
from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from . import cycles, f3d, ours, povray
from .scenes import RaceScene


@dataclass(frozen=True)
class Rival:
    key: str  # as --only has it
    name: str
    program: Path | str
    package: str | None  # Debian's; None: ours
    prepare: Callable[[RaceScene], None]  # writes what the runs read, before the clock starts; raises PeersError
    commands: Callable[[RaceScene, int, int, Path], list[list[str]]]  # scene, frames, threads, output folder
    version: list[str]
    frame_seconds: Callable[[str], list[float]] | None = None  # from the log, where each frame also pays for parsing
    can_run: Callable[[], str | None] = lambda: None  # why not

    def is_installed(self) -> bool:
        return shutil.which(str(self.program)) is not None

    def version_line(self) -> str:
        run = subprocess.run(self.version, capture_output=True, text=True)
        lines = (run.stdout + "\n" + run.stderr).splitlines()
        wanted = self.version[0].rsplit("/", 1)[-1].replace("povray", "pov-ray")  # POV-Ray first complains about its set-up
        return next((line.strip() for line in lines if line.lower().strip().startswith(wanted)), self.name)


def all_rivals(hybridrt: Path) -> list[Rival]:
    mine = [Rival(method, method, hybridrt, None, lambda scene: None, partial(ours.commands, hybridrt, method),
                  [str(hybridrt), "--version"]) for method in ("hybrid", "raytrace")]
    return mine + [
        Rival("povray", "POV-Ray", "povray", "povray", povray.prepare, povray.commands, ["povray", "--version"], povray.frame_seconds),
        Rival("cycles", "Cycles", "blender", "blender", cycles.prepare, cycles.commands, ["blender", "--version"]),
        Rival("f3d", "F3D", "f3d", "f3d", lambda scene: None, f3d.commands, ["f3d", "--version"], can_run=f3d.why_not),
    ]
