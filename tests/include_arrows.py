"""Checks the arrows of the architecture: who may include and link whom, which library stays behind which
fence, and how long a file may grow.

    include_arrows.py ROOT     checks the tree, after checking itself on planted faults
"""

import collections
import os
import re
import sys
import tempfile

LONGEST_FILE = 350

# One folder under core/ = one line. Lists everything a folder may include, not only its neighbours.
ARROWS = {
    "core/base": [],
    "core/image": ["core/base"],
    "core/image_io": ["core/image", "core/base"],
    "core/image_formats": ["core/image_io", "core/image", "core/base"],
    "core/scene": ["core/image", "core/base"],
    "core/mesh": ["core/scene", "core/base"],
    "core/procedural": ["core/mesh", "core/scene", "core/base"],
    "core/load": ["core/procedural", "core/mesh", "core/scene", "core/image", "core/base"],
    "core/passes": ["core/scene", "core/base"],
    "core/trace": ["core/mesh", "core/scene", "core/image", "core/base"],
    "core/simplify": ["core/raster", "core/trace", "core/mesh", "core/scene", "core/base"],
    "core/raster": ["core/trace", "core/mesh", "core/scene", "core/image", "core/base"],
    "core/passes_cpu": ["core/passes", "core/raster", "core/trace", "core/scene", "core/base"],
    "core/gl": ["core/base"],
    "core/passes_gl": ["core/passes", "core/gl", "core/scene", "core/base"],
    "core/render": ["core/passes_gl", "core/passes_cpu", "core/passes", "core/raster", "core/trace", "core/gl", "core/mesh", "core/scene",
                    "core/image", "core/base"],
    "core/golden": ["core/image", "core/base"],
}
# The GL form of a pass is in one of these, its CPU form in the other.
FORMS_OF_PASSES = ("core/passes_gl/", "core/passes_cpu/")
SHARED_BY_PASSES = ("scene_gpu", "view_uniforms")
ABOVE_CORE = {"cli": ["core"], "tests": ["core", "cli", "shaders"]}

# Shared by C++ and GLSL; anyone may include these, but no other shader.
SHARED_WITH_GLSL = ["shaders/shared.h", "shaders/shadow_warp.glsl", "shaders/surface.glsl", "shaders/texture.glsl",
                    "shaders/texture_holes.glsl"]

# Third-party headers by prefix, and the only folders or files that may include them.
FENCES = {
    "OpenImageIO/": ["core/image_formats/", "tests/image_io/", "tests/bench/encode_bench.cpp"],
    "png.h": ["core/image_io/", "tests/image_io/"],
    "openexr": ["core/image_io/"],
    "Imath/": ["core/image_io/"],
    "libdeflate.h": ["core/image_io/"],
    "isa-l": ["core/image_io/"],
    "EGL/": ["core/gl/"],
    "GL/": ["core/gl/"],
    "OpenMesh/": ["core/simplify/", "core/load/"],
    "CLI/": ["cli/"],
    "embree": ["core/trace/", "cli/version.cpp", "tests/bench/"],
    "hwy/": ["core/image_io/", "core/trace/", "core/raster/", "core/passes_cpu/", "tests/"],
}
# The same fences for the linker: CMake target, and the CMakeLists.txt that may name it.
LINK_FENCES = {
    "OPENIMAGEIO": ["core/image_formats/", "tests/"],
    "PNG::PNG": ["core/image_io/", "tests/"],
    "OpenEXR::": ["core/image_io/"],
    "PkgConfig::ISAL": ["core/image_io/"],
    "PkgConfig::DEFLATE": ["core/image_io/"],
    "OpenMesh": ["core/simplify/", "core/load/"],
    "CLI11": ["cli/"],
    "embree": ["core/trace/", "cli/", "tests/", ""],
    "hwy::hwy": ["core/image_io/", "core/trace/", "core/raster/", "core/passes_cpu/", "tests/"],
}

SOURCE = (".cpp", ".h", ".glsl", ".vert", ".frag", ".comp")
COUNTED = SOURCE + (".py", ".sh", ".cmake", "CMakeLists.txt")
FOLDERS = ("core", "cli", "shaders", "tests", "scripts", "cmake")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

Fault = collections.namedtuple("Fault", "path line text")


def files_under(root):
    for top in FOLDERS:
        for folder, subfolders, names in os.walk(os.path.join(root, top)):
            subfolders[:] = [name for name in subfolders if not name.startswith(("__", "."))]
            for name in sorted(names):
                yield os.path.relpath(os.path.join(folder, name), root)


def read_lines(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read().splitlines()


def library_of(path):
    """core/scene/x.h -> core/scene, cli/x.h -> cli"""
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] == "core" else parts[0]


def own_include_fault(path, target):
    """Why `path` may not include our own header `target`, or None."""
    here, there = library_of(path), library_of(target)
    if target in SHARED_WITH_GLSL:
        return None
    if here == there:
        stem = os.path.splitext(target)[0]
        for passes in FORMS_OF_PASSES:
            shared = [passes + name for name in SHARED_BY_PASSES]
            if path.startswith(passes) and stem not in shared + [os.path.splitext(path)[0]]:
                return f"one pass does not see another: {target}; the renderer wires them"
        return None
    if here in ABOVE_CORE:
        allowed = ABOVE_CORE[here]
        return None if there.split("/")[0] in allowed else f"{here} does not see {there}: {target}"
    if here not in ARROWS:
        return f"{here} is not in the table of tests/include_arrows.py"
    return None if there in ARROWS[here] else f"arrows point down only, {here} does not see {there}: {target}"


def include_faults(root, path, lines):
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quote, target = match.groups()
        top = target.split("/")[0]
        if top in ("core", "cli", "shaders", "tests") and "/" in target:
            why = own_include_fault(path, os.path.normpath(target))
        elif quote == '"' and not path.startswith("tests/") and ".." in target.split("/"):
            why = f"write our headers from the top folder on, not {target}"
        elif quote == '"' and os.path.exists(os.path.join(root, os.path.dirname(path), target)):
            why = own_include_fault(path, os.path.normpath(os.path.join(os.path.dirname(path), target)))
        else:
            why = None
            for fence, inside in FENCES.items():
                if target.startswith(fence) and not path.startswith(tuple(inside)):
                    why = f"{target} is only for {', '.join(inside)}"
        if why:
            yield Fault(path, number, why)


def link_faults(path, lines):
    """hybridrt_library(NAME DEPENDS a b PRIVATE c) and target_link_libraries(... hybridrt_x ...) against ARROWS."""
    here = library_of(path)
    text = "\n".join(line.split("#")[0] for line in lines)
    for call in re.finditer(r"(hybridrt_library|target_link_libraries)\s*\(([^)]*)\)", text):
        number = text.count("\n", 0, call.start()) + 1
        for word in call.group(2).split()[1:]:
            library = "core/" + word.removeprefix("hybridrt_")
            if here in ARROWS and library in ARROWS and library != here and library not in ARROWS[here]:
                yield Fault(path, number, f"arrows point down only, {here} does not link {library}")
            for fence, inside in LINK_FENCES.items():
                if fence in word and os.path.dirname(path) + "/" not in inside:
                    yield Fault(path, number, f"{word} is only for {', '.join(filter(None, inside))}")


def faults(root):
    found = []
    for path in files_under(root):
        if not path.endswith(COUNTED):
            continue
        lines = read_lines(root, path)
        if len(lines) > LONGEST_FILE:
            found.append(Fault(path, LONGEST_FILE + 1, f"{len(lines)} lines, {LONGEST_FILE} at most: find the seam"))
        if path.endswith(SOURCE):
            found += include_faults(root, path, lines)
        elif path.endswith("CMakeLists.txt") and path != "core/CMakeLists.txt":
            found += link_faults(path, lines)
    return found


PLANTED = [  # path, text, line of the fault or 0 for none
    ("core/base/a.h", "#pragma once\n#include <vector>\n", 0),
    ("core/base/up.h", '\n#include "core/scene/scene.h"\n', 2),
    ("core/base/neighbour.h", '#include "../scene/scene.h"\n', 1),
    ("core/scene/scene.h", '#include "core/base/a.h"\n#include "core/image/i.h"\n', 0),
    ("core/image/i.h", '#include "core/base/a.h"\n#  include "core/scene/scene.h"\n', 2),
    ("core/image_formats/read.cpp", '#include <OpenImageIO/imageio.h>\n#include "core/image/i.h"\n', 0),
    ("core/image_io/read.cpp", "#include <png.h>\n#include <OpenImageIO/imageio.h>\n", 2),
    ("core/image/read.cpp", "#include <OpenImageIO/imageio.h>\n", 1),
    ("core/scene/textures.cpp", '#include "core/image_io/read.h"\n', 1),
    ("core/trace/kd.cpp", '#include <hwy/highway.h>\n#include <embree3/rtcore.h>\n#include "shaders/shared.h"\n', 0),
    ("core/trace/gl.cpp", '#include "core/base/a.h"\n#include "core/gl/objects.h"\n', 2),
    ("core/trace/raw.cpp", '#include "shaders/scene.glsl"\n', 1),
    ("core/gl/scene.cpp", '#include "core/scene/scene.h"\n', 1),
    ("core/gl/egl.cpp", "#include <EGL/egl.h>\n#include <GL/glcorearb.h>\n", 0),
    ("core/render/egl.cpp", "#include <EGL/egl.h>\n", 1),
    ("core/render/simd.cpp", "#include <hwy/highway.h>\n", 1),
    ("core/render/options.cpp", "#include <CLI/CLI.hpp>\n", 1),
    ("core/render/cli.cpp", '#include "cli/version.h"\n', 1),
    ("core/render/golden.cpp", '#include "core/golden/golden.h"\n', 1),
    ("core/passes_gl/shade.cpp", '#include "core/passes_gl/shade.h"\n#include "core/passes_gl/scene_gpu.h"\n', 0),
    ("core/passes_gl/blur.cpp", '#include "core/passes_gl/shade.h"\n', 1),
    ("core/passes_gl/slot.cpp", '#include "core/render/frame_slot.h"\n', 1),
    ("core/unknown/x.cpp", '#include "core/base/a.h"\n', 1),
    ("cli/version.cpp", '#include <embree3/rtcore.h>\n#include <CLI/CLI.hpp>\n#include "core/gl/context.h"\n', 0),
    ("cli/render.cpp", "#include <embree3/rtcore.h>\n", 1),
    ("cli/mesh.cpp", "#include <OpenMesh/Core/Mesh/TriMesh.hh>\n", 1),
    ("cli/tests.cpp", '#include "tests/unit/x.h"\n', 1),
    ("tests/unit/simd.cpp", "#include <hwy/highway.h>\n", 0),
    ("cli/long.cpp", "\n" * 351, 351),
    ("cli/just_short_enough.cpp", "\n" * 350, 0),
    ("core/gl/CMakeLists.txt", "hybridrt_library(gl DEPENDS base PRIVATE ${CMAKE_DL_LIBS})\n", 0),
    ("core/trace/CMakeLists.txt", "# gl\nhybridrt_library(trace DEPENDS scene\n  gl PRIVATE embree hwy::hwy)\n", 2),
    ("core/scene/CMakeLists.txt", "\ntarget_link_libraries(hybridrt_scene PRIVATE hybridrt_render)\n", 2),
    ("core/image/CMakeLists.txt", "hybridrt_library(image DEPENDS base PRIVATE PkgConfig::OPENIMAGEIO)\n", 1),
    ("cli/CMakeLists.txt", "target_link_libraries(hybridrt PRIVATE hybridrt_gl CLI11::CLI11 embree)\n", 0),
]


def check_itself():
    """Every planted fault is found once, at its line, and nothing else is found."""
    with tempfile.TemporaryDirectory() as root:
        for path, text, _ in PLANTED:
            os.makedirs(os.path.join(root, os.path.dirname(path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        expected = sorted((path, line) for path, _, line in PLANTED if line)
        found = sorted((fault.path, fault.line) for fault in faults(root))
    for path, line in expected:
        if (path, line) not in found:
            sys.exit(f"include_arrows.py does not find the fault planted at {path}:{line}")
    if found != expected:
        sys.exit(f"include_arrows.py finds faults that are none: {[f for f in found if f not in expected] or found}")


def main():
    root = sys.argv[1]
    check_itself()
    found = faults(root)
    for fault in found:
        print(f"{fault.path}:{fault.line}: {fault.text}")
    if not os.path.isfile(os.path.join(root, "core/base/error.h")):
        sys.exit(f"{root} is not the source tree")
    if found:
        sys.exit(1)


if __name__ == "__main__":
    main()
