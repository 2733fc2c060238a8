"""What is told in one line."""


class PeersError(Exception):
    """The world is wrong: a program or file is missing, or a run failed."""
