#!/usr/bin/env python3
"""Writes weave.png, the height map of a plain weave: two threads each way in a tile, one over the other in turn."""
import struct
import zlib
from math import cos, pi
from pathlib import Path

SIDE = 64  # pixels; a thread is half as wide


def height(x, y):
    """From 0 to 1. Threads along x and along y, whose waves are half a period apart from thread to thread."""
    u, v = 2 * pi * x / SIDE, 2 * pi * y / SIDE
    warp = abs(cos(v)) * (0.6 + 0.4 * cos(u) * (1 if cos(v) > 0 else -1))
    weft = abs(cos(u)) * (0.6 - 0.4 * cos(v) * (1 if cos(u) > 0 else -1))
    return max(warp, weft)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


rows = b"".join(b"\0" + bytes(round(255 * height(x + 0.5, y + 0.5)) for x in range(SIDE)) for y in range(SIDE))
Path(__file__).with_name("weave.png").write_bytes(
    b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 0, 0, 0, 0))
    + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
