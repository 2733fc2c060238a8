"""F3D, a viewer that draws by OpenGL: no shadows, no mirrors, and a process for each frame, as it knows no camera paths."""
from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

from .scenes import RaceScene


def commands(scene: RaceScene, frames: int, threads: int, output: Path) -> list[list[str]]:
    """`threads` is the OpenGL's affair."""
    return [["f3d", str(scene.obj), f"--output={output}/frame{i:04}.png", f"--resolution={scene.size_px[0]},{scene.size_px[1]}",
             f"--camera-position={text(view.eye)}", f"--camera-focal-point={text(view.eye, view.forward)}",
             f"--camera-view-up={text(view.up)}", f"--camera-view-angle={view.fov_y_deg:.9g}",
             f"--background-color={text([srgb(c) for c in scene.look.background])}", "--quiet"]
            for i, view in enumerate(scene.views[:frames], 1)]


def why_not() -> str | None:
    """Draws a triangle: Debian's F3D crashes where there is no display."""
    with tempfile.TemporaryDirectory() as folder:
        mesh, picture = Path(folder, "a.obj"), Path(folder, "a.png")
        mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        try:
            run = subprocess.run(["f3d", mesh, f"--output={picture}", "--resolution=16,16"], capture_output=True, timeout=60)
        except subprocess.TimeoutExpired:
            return "hangs here"
        if run.returncode or not picture.exists():
            return "does not run here without a display" + (f" (signal {-run.returncode})" if run.returncode < 0 else "")
    return None


def text(at: list[float], toward: list[float] | None = None) -> str:
    return ",".join(f"{a + b:.9g}" for a, b in zip(at, toward or [0, 0, 0]))


def srgb(linear: float) -> float:
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
