"""What the scripts that write docs/results share."""


def text_before_tables(path):
    """What people wrote stays: everything up to the mark."""
    mark = "<!-- tables -->"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return (text.split(mark)[0] if mark in text else "") + mark + "\n"
