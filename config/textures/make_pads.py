#!/usr/bin/env python3
"""Writes pads.png, a map of a material: a black pad of a third of the tile's width at each corner, with a soft edge."""
import struct
import zlib
from math import hypot
from pathlib import Path

SIDE = 64  # pixels
RADIUS, EDGE = 20, 4  # of a pad, and of its border [pixels]


def white(x, y):
    """From 0 to 1."""
    r = hypot(min(x, SIDE - x), min(y, SIDE - y))
    return min(1, max(0, (r - RADIUS) / EDGE + 0.5))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


rows = b"".join(b"\0" + bytes(round(255 * white(x + 0.5, y + 0.5)) for x in range(SIDE)) for y in range(SIDE))
Path(__file__).with_name("pads.png").write_bytes(
    b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 0, 0, 0, 0))
    + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
