# SPDX-License-Identifier: GPL-3.0-or-later
"""For rounding.cpp: reads lines "numerator denominator" (hexadecimal), writes the bits of the nearest double and float."""
import struct
import sys

from definition import bits, nearest_double, nearest_float

for line in sys.stdin:
    numerator, denominator = (int(word, 16) for word in line.split())
    single = struct.pack(">f", nearest_float(numerator, denominator)).hex()
    print(bits(nearest_double(numerator, denominator)), single)
