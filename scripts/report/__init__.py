"""Draws the charts and the page of a sweep. `python3 scripts/report DIR`; see command.py."""
