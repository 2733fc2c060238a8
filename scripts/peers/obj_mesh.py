"""Reads OBJ and MTL as hybridrt writes them: triangles only, absolute indices, every corner with a normal."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from .error import PeersError


@dataclass
class Material:
    """MTL's values, linear; what they mean is said in docs/method.md, "Materials"."""
    kd: tuple[float, ...] = (0, 0, 0)
    ks: tuple[float, ...] = (0, 0, 0)
    ke: tuple[float, ...] = (0, 0, 0)
    tf: tuple[float, ...] = (1, 1, 1)
    ns: float = 0
    ni: float = 1
    d: float = 1
    illum: int = 2
    map_kd: Path | None = None

    def mirrors(self) -> bool:
        return self.illum in (3, 5, 8)

    def is_glass(self) -> bool:
        return self.illum in (4, 6, 7, 9)


@dataclass
class Part:
    """The triangles of one material: three corners each, as (position, texture coordinate or -1, normal) from 0."""
    material: str
    corners: list[tuple[int, int, int]] = field(default_factory=list)


@dataclass
class ObjMesh:
    """Positions and normals are kept as the text that they were written as."""
    positions: list[list[str]] = field(default_factory=list)
    uvs: list[list[str]] = field(default_factory=list)
    normals: list[list[str]] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)  # one for each material, in order of first use
    materials: dict[str, Material] = field(default_factory=dict)


def read_obj(path: Path) -> ObjMesh:
    """Raises PeersError where the file is not as hybridrt writes it."""
    mesh = ObjMesh()
    parts: dict[str, Part] = {}
    corners: list[tuple[int, int, int]] | None = None
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            word, *values = line.split()
            if word == "v":
                mesh.positions.append(values[:3])
            elif word == "vn":
                mesh.normals.append(values)
            elif word == "vt":
                mesh.uvs.append(values[:2])
            elif word == "f":
                if corners is None or len(values) != 3:
                    raise PeersError(f"{path}:{number}: not a triangle with a material; use what hybridrt wrote")
                corners += [_corner(value, path, number) for value in values]
            elif word == "usemtl":
                corners = parts.setdefault(values[0], Part(values[0])).corners
            elif word == "mtllib":
                mesh.materials = read_mtl(path.parent / values[0])
    mesh.parts = list(parts.values())
    return mesh


def _corner(text: str, path: Path, number: int) -> tuple[int, int, int]:
    fields = text.split("/")
    if len(fields) != 3 or not fields[2]:
        raise PeersError(f"{path}:{number}: a corner without a normal; use what hybridrt wrote")
    return int(fields[0]) - 1, int(fields[1]) - 1 if fields[1] else -1, int(fields[2]) - 1


def read_mtl(path: Path) -> dict[str, Material]:
    """Materials by name; textures' paths are made absolute."""
    materials: dict[str, Material] = {}
    material = Material()
    for line in path.read_text(encoding="utf-8").splitlines():
        word, *values = line.split()
        if word == "newmtl":
            material = materials[values[0]] = Material()
        elif word in ("Kd", "Ks", "Ke", "Tf"):
            setattr(material, word.lower(), tuple(map(float, values)))
        elif word in ("Ns", "Ni", "d"):
            setattr(material, word.lower(), float(values[0]))
        elif word == "illum":
            material.illum = int(values[0])
        elif word == "map_Kd":
            material.map_kd = (path.parent / values[-1]).resolve()
    return materials
