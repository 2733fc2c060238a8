"""Shared by the scripts that write docs/results."""
import platform


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


def text_before_tables(path):
    """The text written by people, which is kept: everything up to the mark."""
    mark = "<!-- tables -->"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return (text.split(mark)[0] if mark in text else "") + mark + "\n"
