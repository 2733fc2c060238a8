"""PNG files in plain Python."""

import struct
import zlib


class Png:
    """8-bit PNG files without interlacing: three channels (or four) as rows of bytes."""

    def __init__(self, width, height, rows, channels=3):
        self.width, self.height, self.rows, self.channels = width, height, rows, channels

    @staticmethod
    def read(path):
        with open(path, "rb") as file:
            data = file.read()
        assert data[:8] == b"\x89PNG\r\n\x1a\n", path
        place, packed = 8, b""
        while place < len(data):
            length, kind = struct.unpack(">I4s", data[place:place + 8])
            body = data[place + 8:place + 8 + length]
            assert struct.unpack(">I", data[place + 8 + length:place + 12 + length])[0] == zlib.crc32(kind + body)
            if kind == b"IHDR":
                width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", body)
                assert depth == 8 and color in (2, 6) and interlace == 0, path
                channels = 3 if color == 2 else 4
            if kind == b"IDAT":
                packed += body
            place += 12 + length
            if kind == b"IEND":
                break
        assert kind == b"IEND" and place == len(data), f"{path} is cut short"
        return Png(width, height, Png._unfiltered(zlib.decompress(packed), width, height, channels), channels)

    @staticmethod
    def _unfiltered(raw, width, height, channels):
        stride = channels * width
        rows, above = [], bytearray(stride)
        assert len(raw) == (stride + 1) * height
        for y in range(height):
            kind = raw[y * (stride + 1)]
            row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            for i in range(stride):
                left = row[i - channels] if i >= channels else 0
                corner = above[i - channels] if i >= channels else 0
                row[i] = (row[i] + (0, left, above[i], (left + above[i]) // 2,
                                    _paeth(left, above[i], corner))[kind]) & 255
            rows.append(row)
            above = row
        return rows

    def write(self, path):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        raw = b"".join(b"\0" + bytes(row) for row in self.rows)
        header = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) +
                       chunk(b"IEND", b""))

    def pixel(self, x, y):
        return tuple(self.rows[y][self.channels * x:self.channels * (x + 1)])


def _paeth(left, above, corner):
    guess = left + above - corner
    return min((abs(guess - left), 0, left), (abs(guess - above), 1, above), (abs(guess - corner), 2, corner))[2]
