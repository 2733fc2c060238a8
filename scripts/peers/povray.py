"""The scene for POV-Ray 3.7, and its run: one process for all frames by its animation loop, which parses each frame anew."""
from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TextIO

from .cameras import View, unit
from .obj_mesh import Material, ObjMesh, Part, read_obj
from .scenes import RaceScene


def prepare(scene: RaceScene) -> None:
    """Writes DIR/povray/scene.pov and mesh.inc."""
    folder = scene.folder / "povray"
    folder.mkdir(exist_ok=True)
    mesh = read_obj(scene.obj)
    with open(folder / "mesh.inc", "w", encoding="utf-8") as file:
        write_meshes(mesh, scene, file)
    (folder / "scene.pov").write_text(scene_text(scene))


def commands(scene: RaceScene, frames: int, threads: int, output: Path) -> list[list[str]]:
    """No anti-aliasing, no window; 8 bits a channel through the sRGB curve."""
    folder = scene.folder / "povray"
    return [["povray", f"+I{folder / 'scene.pov'}", f"+L{folder}", f"+O{output}/frame.png", f"+W{scene.size_px[0]}",
             f"+H{scene.size_px[1]}", "+FN8", "-A", "-D", "-V", "+Q9", f"+WT{threads}", "+KI1", f"+KF{frames}", "+KFI1",
             f"+KFF{frames}", "File_Gamma=sRGB"]]


def frame_seconds(log: str) -> list[float]:
    """What tracing each frame took, by POV-Ray's own account: neither parsing nor writing."""
    return [float(s) for s in re.findall(r"^\s*Trace Time:.*\(([\d.]+) seconds\)", log, re.MULTILINE)]


def scene_text(scene: RaceScene) -> str:
    look = scene.look
    toward = unit(look.toward_light)
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1.0 max_trace_level {look.depth + 1} adc_bailout 1/1024 ambient_light rgb 1 }}
background {{ rgb {vector(look.background)} }}
#declare Frame = max(frame_number, 1) - 1;  // 0 of a run of one frame
#declare Eye = array[{len(scene.views)}] {{ {", ".join(vector(v.eye) for v in scene.views)} }}
#declare Direction = array[{len(scene.views)}] {{ {", ".join(vector(direction_of(v)) for v in scene.views)} }}
#declare Up = array[{len(scene.views)}] {{ {", ".join(vector(v.up) for v in scene.views)} }}
#declare Right = array[{len(scene.views)}] {{ {", ".join(vector(v.right) for v in scene.views)} }}
camera {{
  perspective location Eye[Frame] direction Direction[Frame] up Up[Frame] right Right[Frame] * {scene.size_px[0] / scene.size_px[1]:.9g}
}}
light_source {{
  {vector([1e5 * x for x in toward])} rgb {look.light} parallel point_at 0{"" if look.shadow else " shadowless"}
}}
#include "mesh.inc"
"""


def direction_of(view: View) -> list[float]:
    """POV-Ray's `direction`: its length is the distance of a picture plane whose height is that of `up`, 1."""
    distance = 0.5 / math.tan(math.radians(view.fov_y_deg) / 2)
    return [distance * x for x in view.forward]


def write_meshes(mesh: ObjMesh, scene: RaceScene, file: TextIO) -> None:
    """One mesh2 for each material, since the index of refraction belongs to an object."""
    for part in mesh.parts:
        material = mesh.materials[part.material]
        file.write("mesh2 {\n")
        write_mesh_data(mesh, part, material.map_kd is not None, file)
        file.write(material_text(material, scene.look.ambient) + "}\n")


def write_mesh_data(mesh: ObjMesh, part: Part, textured: bool, file: TextIO) -> None:
    """A vertex of a mesh2 is a triple of position, normal and uv."""
    index_of: dict[tuple[int, int, int], int] = {}
    indices = [index_of.setdefault(corner, len(index_of)) for corner in part.corners]
    write_list(file, "vertex_vectors", (text_vector(mesh.positions[c[0]]) for c in index_of), len(index_of))
    write_list(file, "normal_vectors", (text_vector(mesh.normals[c[2]]) for c in index_of), len(index_of))
    if textured:
        write_list(file, "uv_vectors", (text_vector(mesh.uvs[c[1]]) if c[1] >= 0 else "<0,0>" for c in index_of), len(index_of))
    triangles = (f"<{indices[i]},{indices[i + 1]},{indices[i + 2]}>" for i in range(0, len(indices), 3))
    write_list(file, "face_indices", triangles, len(indices) // 3)


def write_list(file: TextIO, name: str, items: Iterable[str], count: int) -> None:
    file.write(f"{name} {{ {count},\n")
    file.write(",\n".join(items))
    file.write("\n}\n")


def material_text(material: Material, ambient: Sequence[float]) -> str:
    """POV-Ray's finish has one number where MTL has colours: highlights, and Kd beside a texture, take the mean."""
    through = tuple(1 - material.d for _ in range(3)) if not material.is_glass() else (1, 1, 1)
    transmit = mean(through) * mean(material.tf)
    if material.map_kd:
        pigment = f'uv_mapping image_map {{ png "{material.map_kd}" gamma srgb interpolate 2 }}'
        diffuse, lit = mean(material.kd), [a * mean(material.kd) for a in ambient]
    elif material.is_glass():
        pigment, diffuse, lit = f"rgb {vector(material.tf)} filter 1", 0.0, [0, 0, 0]
    else:
        pigment, diffuse, lit = f"rgb {vector(material.kd)} transmit {transmit:.6g}", 1.0, ambient
    finish = f"ambient rgb {vector(lit)} diffuse {diffuse:.6g} emission 0"
    if material.ns > 0 and max(material.ks) > 0:
        finish += f" specular {mean(material.ks):.6g} roughness {1 / material.ns:.6g}"
    if material.is_glass() and material.ni != 1:
        finish += " reflection { 0, 1 fresnel on } conserve_energy"
    elif material.illum == 5:
        finish += f" reflection {{ rgb {vector(material.ks)}, rgb 1 falloff 5 }}"
    elif material.mirrors() or material.is_glass():
        finish += f" reflection {{ rgb {vector(material.ks)} }}"
    interior = f"interior {{ ior {material.ni:.6g} }}\n" if material.is_glass() else ""
    return f"texture {{ pigment {{ {pigment} }} finish {{ {finish} }} }}\n{interior}"


def mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def vector(values: Sequence[float]) -> str:
    return "<" + ",".join(f"{v:.9g}" for v in values) + ">"


def text_vector(values: Sequence[str]) -> str:
    return "<" + ",".join(values) + ">"
