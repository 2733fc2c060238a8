"""Pictures for the page: small, and as data."""
from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

from PIL import Image

LARGEST_PX = 640
JPEG_QUALITY = 90


@dataclass(frozen=True)
class Picture:
    width_px: int
    height_px: int
    data_uri: str


def read_picture(folder: Path, name: object) -> Optional[Picture]:
    """The picture at `name`, relative to `folder`, at most 640 pixels wide; as PNG or JPEG, whichever is smaller. None if
    there is none, it cannot be read, or it lies outside of `folder`."""
    if not isinstance(name, str) or not name:
        return None
    try:
        path = (folder / name).resolve()
        path.relative_to(folder.resolve())
        with Image.open(path) as opened:
            image = opened.convert("RGB")
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return None
    if image.width > LARGEST_PX:
        image = image.resize((LARGEST_PX, max(1, round(image.height * LARGEST_PX / image.width))), Image.LANCZOS)
    png = _encoded(image, format="PNG", optimize=True)
    jpeg = _encoded(image, format="JPEG", quality=JPEG_QUALITY, subsampling=0, optimize=True)
    kind, data = min(("png", png), ("jpeg", jpeg), key=lambda pair: len(pair[1]))
    return Picture(image.width, image.height, f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}")


def _encoded(image: Image.Image, **options: object) -> bytes:
    file = io.BytesIO()
    image.save(file, **options)
    return file.getvalue()
