"""A chart's SVG as part of a page."""
from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree

from .chart import Chart

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"


def inline_svg(chart: Chart, svg: bytes) -> str:
    """Without prolog, size and the facts (the page has them as text); ids are the chart's own; points are links to their
    setting's pictures, with a tooltip."""
    ElementTree.register_namespace("", SVG)
    ElementTree.register_namespace("xlink", XLINK)
    root = ElementTree.fromstring(svg)
    _remove(root, lambda element: element.tag.endswith(("metadata", "style")) or element.get("id") == "facts")
    _crop(root, chart.facts_height_pt)
    root.set("style", "stroke-linejoin:round;stroke-linecap:butt")  # what Matplotlib's style element says, for this one only
    root.set("role", "group" if chart.points else "img")
    root.set("aria-label", chart.title)
    _own_ids(root, chart.name)
    for point in chart.points:
        _link(root, f"{chart.name}-{point.gid}", f"#setting-{point.number}", point.tooltip)
    return ElementTree.tostring(root, encoding="unicode")


def _remove(root: ElementTree.Element, unwanted) -> None:
    for parent in list(root.iter()):
        for child in list(parent):
            if unwanted(child):
                parent.remove(child)


def _crop(root: ElementTree.Element, bottom_pt: float) -> None:
    left, top, width, height = (float(number) for number in root.attrib.pop("viewBox").split())
    root.set("viewBox", f"{left:g} {top:g} {width:g} {height - bottom_pt:g}")
    for name in ("width", "height", "version"):
        root.attrib.pop(name, None)


def _own_ids(root: ElementTree.Element, prefix: str) -> None:
    reference = f"{{{XLINK}}}href"
    for element in root.iter():
        if "id" in element.attrib:
            element.set("id", f"{prefix}-{element.get('id')}")
        if element.get(reference, "").startswith("#"):
            element.set(reference, f"#{prefix}-{element.get(reference)[1:]}")
        for name, value in element.attrib.items():
            if "url(#" in value:
                element.set(name, re.sub(r"url\(#", f"url(#{prefix}-", value))


def _link(root: ElementTree.Element, identity: str, target: str, tooltip: str) -> None:
    for parent in root.iter():
        for place, child in enumerate(parent):
            if child.get("id") == identity:
                link = ElementTree.Element(f"{{{SVG}}}a", {"href": target})
                ElementTree.SubElement(link, f"{{{SVG}}}title").text = tooltip
                parent[place] = link
                link.append(child)
                return
