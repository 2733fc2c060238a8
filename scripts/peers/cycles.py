"""The scene for Blender's Cycles, and its run: one process for all frames, which keeps scene and BVH between them."""
from __future__ import annotations

import json
import subprocess
from pathlib import Path

from .obj_mesh import Material, read_mtl
from .error import PeersError
from .scenes import RaceScene

BUILDER = Path(__file__).with_name("blender_scene.py")


def prepare(scene: RaceScene) -> None:
    """Writes DIR/cycles/scene.blend, Blender's own format, so that a run does not pay for reading text. Raises PeersError."""
    folder = scene.folder / "cycles"
    folder.mkdir(exist_ok=True)
    facts = folder / "scene.json"
    facts.write_text(json.dumps(facts_of(scene, folder / "scene.blend")))
    run = subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", BUILDER, "--", facts],
                         capture_output=True, text=True)
    if run.returncode:
        raise PeersError(f"{scene.name}: Blender did not build the scene: {(run.stderr or run.stdout).strip().splitlines()[-1]}")


def commands(scene: RaceScene, frames: int, threads: int, output: Path) -> list[list[str]]:
    return [["blender", "-b", "--factory-startup", "-t", str(threads), str(scene.folder / "cycles" / "scene.blend"),
             "-o", f"{output}/frame####", "-s", "1", "-e", str(frames), "-a"]]


def facts_of(scene: RaceScene, blend: Path) -> dict:
    """What blender_scene.py reads."""
    look = scene.look
    return {
        "obj": str(scene.obj.resolve()), "blend": str(blend.resolve()), "size_px": scene.size_px, "depth": look.depth,
        "materials": {name: material_facts(m) for name, m in read_mtl(scene.obj.with_suffix(".mtl")).items()},
        "views": [view._asdict() for view in scene.views],
        "toward_light": look.toward_light, "light": look.light, "shadow": look.shadow,
        "ambient": look.ambient, "background": look.background,
    }


def material_facts(material: Material) -> dict:
    return {
        "kd": material.kd, "ks": material.ks, "ke": material.ke, "tf": material.tf, "ni": material.ni, "d": material.d,
        "mirror": material.mirrors(), "schlick": material.illum == 5, "glass": material.is_glass(),
        "map_kd": str(material.map_kd) if material.map_kd else None,
    }
