"""The caption that every chart carries: on what machine, from what commit, compared with what."""
from __future__ import annotations

from .sweep import Sweep, Truth


def facts_text(sweep: Sweep, with_truth: bool) -> str:
    facts = sweep.facts
    commit = f"({facts['commit']})" if facts["commit"] else ""
    said = [f"{facts['processor'] or 'unknown processor'}, {counted(facts['threads'], 'thread')}",
            sweep.gl_renderer or "all passes on the CPU",
            " ".join(part for part in ("hybridrt", facts["version"], commit) if part),
            f"{'frame' if facts['frames'].isdigit() else 'frames'} {facts['frames'] or 'unknown'}, "
            f"{counted(facts['rounds'], 'round')}: medians, bars from the first to the third quartile"]
    if facts["scene"]:
        said.insert(0, facts["scene"])
    if with_truth:
        said.append(truth_text(sweep.truth))
    return "; ".join(said) + "."


def truth_text(truth: Truth) -> str:
    """What the pictures are compared with, and whether that has aliasing."""
    note = f" ({truth.note})" if truth.note else ""
    if truth.kind == "none":
        return "compared with nothing" + note
    if truth.kind == "folder":
        return "truth: pictures of a folder" + note
    aliasing = ("1 sample a pixel, so it has aliasing itself" if truth.samples == 1 else
                f"{truth.samples} samples a pixel, so aliasing counts as an error")
    return f"truth: method {truth.method}, {aliasing}{note}"


def counted(number: str, noun: str) -> str:
    return f"{number or '?'} {noun}" + ("" if number == "1" else "s")
