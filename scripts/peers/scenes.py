"""The scenes of the race: each becomes a folder with scene.obj, scene.mtl, scene.json and camera.json, the same for all."""
from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .cameras import View, Turn, camera_path, views_of
from .error import PeersError


@dataclass(frozen=True)
class Look:
    """What decides a picture besides the mesh. Colours are linear."""
    turn: Turn
    toward_light: tuple[float, float, float]  # unit or not
    light: float
    shadow: bool
    ambient: tuple[float, float, float]
    background: tuple[float, float, float]
    depth: int  # generations of rays after the first


LOOKS = {
    # The paper's measuring scene, its share of mirrors and its one generation of reflections.
    "spheres": Look(Turn((0, 0.66, 0), 14, 5.65, 30, 45), (-0.2024, 0.7930, 0.5747), 0.85, True, (0.15, 0.15, 0.15),
                    (0.21, 0.25, 0.32), depth=1),
    # Polished wood, gold and glass; hybridrt's own camera, light and depth.
    "chess": Look(Turn((0.1, -0.1, 0.35), 9.7241966, 3.5, -17.97, 38), (-0.7255, 0.6529, 0.2176), 1.0, True,
                  (0.2, 0.205, 0.215), (0.045, 0.06, 0.078), depth=4),
    # A closed room, which no light from outside enters: the light casts no shadows, as by hybridrt's default.
    "sibenik": Look(Turn((12.6, -5.572, -2.0645), 53.4, 0, 275.6 - 360, 45, outward=True), (0.8944, 0.3909, 0.2174), 0.85, False,
                    (0.15, 0.15, 0.15), (0.21, 0.25, 0.32), depth=4),
}


@dataclass(frozen=True)
class RaceScene:
    name: str
    folder: Path
    look: Look
    views: list[View]  # of frames 1, 2 and so on
    triangles: int
    size_px: tuple[int, int]

    @property
    def obj(self) -> Path:
        return self.folder / "scene.obj"


def prepare(name: str, hybridrt: Path, folder: Path, triangles: int, size_px: tuple[int, int], sibenik_obj: Path) -> RaceScene:
    """Writes the scene's files into `folder`. `triangles` goes for scenes that are made. Raises PeersError."""
    look = LOOKS[name]
    folder.mkdir(parents=True, exist_ok=True)
    obj = folder / "scene.obj"
    if name == "sibenik":
        # The least error writes the scene nearly as it is, with the normals that hybridrt builds, as the file has none.
        command = [hybridrt, "simplify", sibenik_obj, "--max-error", "0.00001px", "-q", "-o", obj]
    else:
        made = {"spheres": "spheres,reflective=10", "chess": "chess"}[name]
        command = [hybridrt, "scene", made, "--triangles", str(triangles), "-o", obj]
    run = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if run.returncode:
        raise PeersError(f"{name}: {run.stderr.strip().splitlines()[-1]}")
    path = camera_path(look.turn)
    (folder / "camera.json").write_text(json.dumps(path))
    (folder / "scene.json").write_text(json.dumps({
        "meshes": ["scene.obj"],
        "camera_path": "camera.json",
        "lights": [{"type": "directional", "toward": look.toward_light, "color": look.light, "shadow": look.shadow}],
        "ambient": look.ambient,
        "background": look.background,
    }))
    with open(obj, encoding="utf-8") as file:
        count = sum(line.startswith("f ") for line in file)
    return RaceScene(name, folder, look, views_of(path), count, size_px)


def once(path: Path, write: Callable[[Path], None]) -> Path:
    """`path`, which `write` has written completely, in this run or an earlier one."""
    if not path.exists():
        part = path.with_name(f"part.{path.name}")
        write(part)
        part.rename(path)
    return path
