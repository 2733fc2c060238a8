"""Files that are whole or not there."""
from __future__ import annotations

import os
import tempfile
from pathlib import Path

from .report_error import ReportError


def write_atomically(path: Path, content: bytes) -> None:
    """Writes beside `path` under a temporary name, then renames. Raises ReportError."""
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
        raise ReportError(f"{path} cannot be written: {error.strerror}; free the place or choose another folder") from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
