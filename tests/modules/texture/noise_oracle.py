#!/usr/bin/env python3
"""Values of the noise texture, from its description in modules/texture/README.md, in exact fractions:
   noise_oracle.py SEED U V ...  (U, V in wavelengths)"""
import sys
from fractions import Fraction
from math import floor

MASK = (1 << 64) - 1


def splitmix64(x):
    x = (x + 0x9E3779B97F4A7C15) & MASK
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & MASK
    return x ^ (x >> 31)


def gradient(seed, i, j):
    bits = splitmix64(splitmix64(splitmix64(seed) ^ (i & MASK)) ^ (j & MASK))
    side, along = (1 if bits & 1 else -1), Fraction(bits >> 11, 1 << 52) - 1
    return (side, along) if bits & 2 else (along, side)


def noise(seed, u, v):
    total = Fraction(0)
    for i in (floor(u), floor(u) + 1):
        for j in (floor(v), floor(v) + 1):
            x, y = u - i, v - j
            weight = Fraction(1)
            for t in (1 - abs(x), 1 - abs(y)):
                weight *= 6 * t**5 - 15 * t**4 + 10 * t**3
            gx, gy = gradient(seed, i, j)
            total += weight * (gx * x + gy * y)
    return total


seed, numbers = int(sys.argv[1]), [Fraction(text) for text in sys.argv[2:]]
for u, v in zip(numbers[::2], numbers[1::2]):
    print(f"{float(noise(seed, u, v)):.12f}")
