#!/usr/bin/env python3
"""The depth code that profile `geforce3` stores at D24: path `window_z`, rule `chip` (depth.md 4.4).

Input lines:  x0 y0 z0 x1 y1 z1 x2 y2 z2 px py   (corners in 1/16 pixel, y down; z as bits of binary32 in buffer units)
Output lines: the code, decimal.  All arithmetic is in integers, except the reciprocal, which the page computes in binary64.
"""
import math
import sys

SUBPIXEL_BITS = 4         # devices.md 2: raster.subpixel_bits of geforce3
RECIPROCAL_BITS = 29      # devices.md 2: raster.reciprocal_bits, m
DEFICIT = 2               # devices.md 2: raster.reciprocal_deficit, d
SUM_BITS = 29             # devices.md 2: raster.sum_bits, g
MAX_CODE = (1 << 24) - 1  # depth.md 1.1: largest code of d24
Z_UNIT = -149             # every finite binary32 is an integer times 2^-149


def z_integer(text):
    """The binary32 with these bits as an integer in units of 2^-149 (exact)."""
    bits = int(text, 16)
    field, fraction = bits >> 23 & 0xFF, bits & 0x7FFFFF
    if field == 0xFF:
        raise ValueError("a corner's z is not finite: coverage.md 2.6 drops such triangles")
    magnitude = (fraction | 0x800000) << field - 1 if field else fraction
    return -magnitude if bits >> 31 else magnitude


def edge(px, py, qx, qy, x, y):
    """E of the directed side P, Q at a point: coverage.md 5.1."""
    return (qx - px) * (y - py) - (qy - py) * (x - px)


def edge_values(x0, y0, x1, y1, x2, y2, column, row):
    """(e0, e1, e2) at the centre of a pixel (coverage.md 1.2), the interior positive: coverage.md 5.2."""
    half = 1 << SUBPIXEL_BITS - 1
    cx, cy = (column << SUBPIXEL_BITS) + half, (row << SUBPIXEL_BITS) + half
    area = edge(x0, y0, x1, y1, x2, y2)
    e1, e2 = edge(x2, y2, x0, y0, cx, cy), edge(x0, y0, x1, y1, cx, cy)
    if area < 0:
        area, e1, e2 = -area, -e1, -e2
    if area == 0:
        raise ValueError("no area: coverage.md 6.3 gives no fragments")
    return (area - e1 - e2, e1, e2)


def reciprocal(edges):
    """(R, s): r = R 2^-s of the sum of truncated edge values: depth.md 4.4. Python's floats are binary64."""
    total = (float(edges[0]) + float(edges[1])) + float(edges[2])
    low = 1.0 / total
    if math.frexp(total)[0] != 0.5:
        low *= 1.0 - DEFICIT * 2.0 ** -32
    mantissa, exponent = math.frexp(low)   # low = mantissa 2^exponent, 1/2 <= mantissa < 1: m bits are left of the point
    return int(math.ldexp(mantissa, RECIPROCAL_BITS)), RECIPROCAL_BITS - exponent


def reference_corner(e):
    """The reference corner by the bit widths of the edge values, ties v1, v0, v2: depth.md 4.4."""
    k0, k1, k2 = e[0].bit_length(), e[1].bit_length(), e[2].bit_length()
    if k1 >= k0 and k1 >= k2:
        return 1
    return 0 if k0 >= k2 else 2


def cut(value, bits):
    """A natural number truncated to its leading significant bits: numbers.md 3.5."""
    drop = value.bit_length() - bits
    return value >> drop << drop if drop > 0 else value


def cut_to_place(value, unit, place):
    """value 2^unit truncated toward zero to a multiple of 2^place (numbers.md 3.6), as an integer times 2^unit."""
    drop = place - unit
    if drop <= 0:
        return value
    return value >> drop << drop if value >= 0 else -(-value >> drop << drop)


def aligned_sum(z_reference, products, unit):
    """floor of the reference and both products, the products cut at the largest term's last place: depth.md 4.4, numbers.md 3.6.

    All three are integers in units of 2^unit. The page cuts the products alone; where z is not negative, cutting z too (as
    numbers.md 3.6 has it) could not change the floor.
    """
    bits = max(abs(term).bit_length() for term in (z_reference, *products))
    if bits == 0:
        return 0
    place = unit + bits - 1 - (SUM_BITS - 1)
    total = z_reference + sum(cut_to_place(p, unit, place) for p in products)
    return total >> -unit


def window_z(e, z):
    """The code: depth.md 4.4. z in units of 2^-149; the depth range is 0 .. 1 (depth.md 5.1)."""
    e = [cut(value, 24) for value in e]
    r, shift = reciprocal(e)
    v = reference_corner(e)
    products = [cut(e[j] * r, 24) * (z[j] - z[v]) for j in (0, 1, 2) if j != v]   # units of 2^(-149 - shift)
    depth = aligned_sum(z[v] << shift, products, Z_UNIT - shift)
    return min(max(depth, 0), MAX_CODE)


def answer(line):
    """One line of input to one of output."""
    t = line.split()
    x0, y0, x1, y1, x2, y2, px, py = (int(t[i]) for i in (0, 1, 3, 4, 6, 7, 9, 10))
    e = edge_values(x0, y0, x1, y1, x2, y2, px, py)
    return str(window_z(e, (z_integer(t[2]), z_integer(t[5]), z_integer(t[8]))))


def main():
    """Standard input to standard output, line by line."""
    sys.stdout.writelines(answer(line) + "\n" for line in sys.stdin if line.strip())


if __name__ == "__main__":
    main()
