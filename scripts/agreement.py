#!/usr/bin/env python3
"""Measures how far the methods' pictures are from the reference's and writes it as a Markdown table.

    scripts/agreement.py [-o docs/results/agreement.md] [--scenes DIR] [--triangles 100000] [--size 512x384]

Scenes: the procedural ones and every mesh below DIR. The 8-bit pictures that the binary writes are compared. Where
a method and the reference see different triangles at a pixel's centre (outlines, by rounding) pictures may differ:
those pixels are counted, and left out of the last two columns.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "cli"))
from png_file import Png  # noqa: E402

METHODS = [
    ("hybrid, exact", ["--method", "hybrid", "--shadows", "exact"]),
    ("hybrid, rays", ["--method", "hybrid", "--shadows", "rays"]),
    ("raytrace", ["--method", "raytrace"]),
]
MESHES = (".obj", ".ply", ".off", ".stl")

OFF = 2  # largest difference of a channel that counts as equal, in 255ths
LEAST_PSNR = 50  # dB
MOST_OFF_PERCENT = 0.1
MOST_OTHER_TRIANGLES_PERCENT = 0.1


class Agreement:
    """Two pictures, pixel by pixel; `other` says per pixel whether the methods see different triangles."""

    def __init__(self, picture, reference, ids, reference_ids):
        self.pixels = picture.width * picture.height
        self.other, self.off, self.off_elsewhere, squares, squares_elsewhere = 0, 0, 0, 0, 0  # pixels; sums
        self.worst = 0  # elsewhere
        for row, wanted, id_row, wanted_ids in zip(picture.rows, reference.rows, ids.rows, reference_ids.rows):
            if row == wanted and id_row == wanted_ids:
                continue
            for i in range(0, len(row), 3):
                other = id_row[i:i + 3] != wanted_ids[i:i + 3]
                self.other += other
                if row[i:i + 3] == wanted[i:i + 3]:
                    continue
                differences = [abs(a - b) for a, b in zip(row[i:i + 3], wanted[i:i + 3])]
                square, off = sum(d * d for d in differences), max(differences) > OFF
                squares += square
                self.off += off
                if not other:
                    squares_elsewhere += square
                    self.off_elsewhere += off
                    self.worst = max(self.worst, *differences)
        self.psnr = _psnr(squares, self.pixels)
        self.psnr_elsewhere = _psnr(squares_elsewhere, self.pixels - self.other)

    def percent(self, count):
        return 100 * count / self.pixels

    def same_colour_percent(self):
        """The percentage of the pixels that see another triangle and are not off."""
        return 100 * (1 - (self.off - self.off_elsewhere) / self.other)

    def missed(self):
        """The missed targets, in words."""
        said = []
        if self.percent(self.other) > MOST_OTHER_TRIANGLES_PERCENT:
            said.append("triangles")
        if self.psnr_elsewhere < LEAST_PSNR:
            said.append("PSNR")
        if self.percent(self.off_elsewhere) > MOST_OFF_PERCENT:
            said.append("pixels off")
        return said


def _psnr(squares, pixels):
    return 10 * math.log10(255 * 255 * 3 * pixels / squares) if squares else math.inf


def render(binary, scene, options, size, folder):
    """The picture, the picture of ids, and run.json; raises an exception with the binary's message if it refuses."""
    command = [binary, "render", scene, "--size", size, "--aov", "id", "-q", "-o", f"{folder}/p.png", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    facts = json.loads(pathlib.Path(folder, "run.json").read_text())
    return Png.read(f"{folder}/p.png"), Png.read(f"{folder}/p.id.png"), facts


def measure(binary, scene, size, options=(), methods=METHODS, keep=None):
    """{method: Agreement} of a scene. `keep`: a folder for the pictures, with a subfolder per method."""
    with tempfile.TemporaryDirectory() as temporary:
        def run(name, method):
            folder = pathlib.Path(keep or temporary, name.replace(", ", "_"))
            folder.mkdir(parents=True, exist_ok=True)
            return render(binary, scene, [*method, *options], size, folder)

        reference, reference_ids, _ = run("reference", ["--method", "reference"])
        results, facts = {}, None
        for name, method in methods:
            picture, ids, facts_of_run = run(name, method)
            results[name] = Agreement(picture, reference, ids, reference_ids)
            facts = facts or facts_of_run
    return results, facts


def row(scene, method, agreement):
    def decibels(value):
        return "equal" if math.isinf(value) else f"{value:.1f}"

    def percent(count):
        return f"{agreement.percent(count):.3f}" if count else "0"

    missed = ", ".join(agreement.missed())
    if "triangles" in missed:
        missed += f" ({agreement.same_colour_percent():.0f} % of them in the same colour)"
    return (f"| {scene} | {method} | {decibels(agreement.psnr)} | {percent(agreement.off)} | {percent(agreement.other)} "
            f"| {decibels(agreement.psnr_elsewhere)} | {percent(agreement.off_elsewhere)} | {missed or 'met'} |")


def scenes_below(folder):
    return sorted((path.stem, str(path)) for path in pathlib.Path(folder).rglob("*") if path.suffix.lower() in MESHES)


def report(rows, refused, facts, arguments):
    table = "\n".join(["| scene | method | PSNR, dB | off, % | other triangle, % | PSNR elsewhere | off elsewhere, % | targets |",
                       "|---|---|---|---|---|---|---|---|", *rows])
    below = " --scenes DIR" if arguments.scenes else ""
    said = f"\nRefused as unusable: {', '.join(sorted(set(refused)))}.\n" if refused else ""
    return f"""# How far the methods are from the reference

`scripts/agreement.py --triangles {arguments.triangles} --size {arguments.size}{below}`

Targets, against `--method reference` (double precision, every ray) in 8 bits per channel: at most
{MOST_OTHER_TRIANGLES_PERCENT} % of the pixels see another triangle at their centre; everywhere else PSNR >= {LEAST_PSNR} dB, and at most
{MOST_OFF_PERCENT} % of the pixels off by more than {OFF}/255 in any channel. "Elsewhere" leaves out the pixels that see another
triangle; "equal" means equal to the last bit. The reflection depth is the default, 4. Where triangles miss their target but have
the same colour, the file holds faces twice: which of two equal ones is seen depends on rounding, or on the order in
which Embree meets them.

{facts['gl']['renderer']}; hybridrt {facts['version']} ({facts['commit']}).

{table}
{said}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", help="Markdown file (default: standard output)")
    parser.add_argument("--binary", default="build/release/bin/hybridrt")
    parser.add_argument("--scenes", help="a folder whose meshes are measured too")
    parser.add_argument("--triangles", type=int, default=100_000, help="triangles of the procedural scenes")
    parser.add_argument("--size", default="512x384")
    parser.add_argument("--keep", help="a folder for the pictures, to look at them")
    arguments = parser.parse_args()

    scenes = [(f"{name}{more}", f"scene:{name},triangles={arguments.triangles}{more}") for name, more in
              [("chess", ""), ("spheres", ""), ("thin", "")] +
              [(name, f",reflective={percent}") for name in ("spheres", "chess") for percent in (0, 25, 50, 100)]]
    scenes += scenes_below(arguments.scenes) if arguments.scenes else []
    rows, refused, facts = [], [], None
    for name, scene in scenes:
        print(name, file=sys.stderr, flush=True)
        keep = pathlib.Path(arguments.keep, name) if arguments.keep else None
        try:
            results, facts_of_run = measure(arguments.binary, scene, arguments.size, keep=keep)
        except RuntimeError as error:
            print(error, file=sys.stderr)
            refused.append(name)
            continue
        facts = facts or facts_of_run
        rows += [row(name, method, agreement) for method, agreement in results.items()]
        print("\n".join(rows[-len(results):]), file=sys.stderr, flush=True)
    text = report(rows, refused, facts, arguments)
    if arguments.output:
        pathlib.Path(arguments.output).write_text(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
