"""The rivals' first pictures in a row: whole, and below it a part at full size, where noise and edges can be seen."""
from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path


def draw(names: Sequence[str], pictures: Sequence[Path], output: Path) -> bool:
    """By a Python that has Matplotlib, which need not be this one; false if none has."""
    for python in (sys.executable, "/usr/bin/python3"):
        command = [python, Path(__file__).resolve(), output, *(f"{name}={path}" for name, path in zip(names, pictures))]
        if subprocess.run(list(map(str, command)), capture_output=True).returncode == 0:
            return True
    print(f"{output} is not drawn: no Python here has Matplotlib", file=sys.stderr)
    return False


def write_side_by_side(names: Sequence[str], pictures: Sequence[Path], output: Path, cell_px: int = 360) -> None:
    """Needs Matplotlib. Pictures of one size."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    images = [plt.imread(path)[..., :3] for path in pictures]
    height, width = images[0].shape[:2]
    part_h, part_w = min(height, cell_px * height // width), min(width, cell_px)
    top, left = (height - part_h) * 6 // 10, (width - part_w) // 2
    figure = plt.figure(figsize=(cell_px * len(images) / 100, (2 * part_h + 20) / 100), dpi=100)
    whole_h, label_h = part_h / (2 * part_h + 20), 20 / (2 * part_h + 20)
    for i, (name, image) in enumerate(zip(names, images)):
        x, w = i / len(images), 1 / len(images)
        for y, shown, smooth in ((whole_h, image, "antialiased"), (0, image[top:top + part_h, left:left + part_w], "nearest")):
            axes = figure.add_axes([x, y, w, whole_h])
            axes.imshow(shown, interpolation=smooth, aspect="auto")
            axes.axis("off")
        figure.text(x + w / 2, 1 - label_h / 2, name, ha="center", va="center", fontsize=9)
    figure.savefig(output, dpi=100)
    plt.close(figure)


if __name__ == "__main__":
    pairs = [pair.split("=", 1) for pair in sys.argv[2:]]
    write_side_by_side([name for name, _ in pairs], [Path(path) for _, path in pairs], Path(sys.argv[1]))
