"""The one kind of error that the command catches."""


class ReportError(Exception):
    """The input or the machine is not as it should be: says what, where, and what to do, in one line."""
