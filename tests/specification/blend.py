#!/usr/bin/env python3
"""A blend into an RGBA16F target on profile `geforce8` (fragment-stages.md 9, formats.md 3).

Input lines:  EQ SRC DST EQ SRC DST CR CG CB CA SR SG SB SA DR DG DB DA
              (colour's term, alpha's term, constant and source as bits of binary32, the target's stored halves)
Output lines: r g b a, halves in four hexadecimal digits.
A binary32 is kept as a Python float of that value. Sum, difference and product of two binary32 in binary64, rounded once more to
binary32, are the correctly rounded ones. Which NaN a NaN is cannot be seen: every one becomes 0x7fffffff (9.1, 9.3).
"""
import struct
import sys
from math import copysign, inf

FLOAT, WORD, HALF = struct.Struct("<f"), struct.Struct("<I"), struct.Struct("<e")
HALF_WORD = struct.Struct("<H")
LEAST_NORMAL = 2.0 ** -126
STORED_NAN = 0x7E00 | 0x7FFFFF >> 13   # 0x7fffffff stored as a half: formats.md 3.2


def binary32(x):
    """A binary64 rounded to binary32, nearest even, infinity beyond the largest: numbers.md 1.1."""
    try:
        return FLOAT.unpack(FLOAT.pack(x))[0]
    except OverflowError:
        return copysign(inf, x)


def flush(x):
    """Exponent field 0 becomes zero of its sign: `denormals` = flush, devices.md 2, fragment-stages.md 9.1."""
    return copysign(0.0, x) if abs(x) < LEAST_NORMAL else x


def float_of(text):
    """An operand in binary32 bits, flushed: fragment-stages.md 9.1."""
    return flush(FLOAT.unpack(WORD.pack(int(text, 16)))[0])


def half_of(text):
    """A stored half widened exactly, never flushed: formats.md 3.1, fragment-stages.md 9.1."""
    return HALF.unpack(HALF_WORD.pack(int(text, 16)))[0]


def to_half(x):
    """The half that is stored: formats.md 3.2, nearest_even (devices.md 2: half_rounding of geforce8)."""
    if x != x:
        return STORED_NAN
    if abs(x) >= 65520.0:
        return 0x7C00 if x > 0 else 0xFC00
    return HALF_WORD.unpack(HALF.pack(x))[0]


def extreme(smallest, a, b):
    """MIN (smallest) or MAX of flushed operands, min_max_nan = other_operand: fragment-stages.md 9.3."""
    if a == b:   # only zeros differ in bits: MIN takes the or of the signs, MAX the and
        if a != 0.0:
            return a
        signs = copysign(1.0, a), copysign(1.0, b)
        return copysign(0.0, min(signs) if smallest else max(signs))
    takes_a = (a < b if smallest else a > b) or b != b
    return a if takes_a else b


def one_minus(x):
    """1 - x = flush(1.0f - x): fragment-stages.md 9.1."""
    return flush(binary32(1.0 - x))


def factor(name, channel, source, target, constant):
    """A factor's value for a channel (3: alpha): table of fragment-stages.md 8.1 with 0.0 and 1.0 (9.1)."""
    if name == "zero":
        return 0.0
    if name == "one":
        return 1.0
    if name == "src_alpha_saturate":
        return 1.0 if channel == 3 else extreme(True, source[3], one_minus(target[3]))
    inverted = name.startswith("one_minus_")
    operand, part = (name[10:] if inverted else name).split("_")
    values = {"src": source, "dst": target, "constant": constant}[operand]
    value = values[3 if part == "alpha" else channel]
    return one_minus(value) if inverted else value


def product(x, name, value):
    """Times `one` a value is what it was; else flush(x * value): fragment-stages.md 9.1."""
    return x if name == "one" else flush(binary32(x * value))


def blended(term, channel, source, target, constant):
    """One channel's binary32 result: fragment-stages.md 9.1, MIN and MAX (factors ignored, 8) by 9.3."""
    equation, f, g = term
    s, d = source[channel], target[channel]
    if equation in ("min", "max"):
        return extreme(equation == "min", s, d)
    p = product(s, f, factor(f, channel, source, target, constant))
    q = product(d, g, factor(g, channel, source, target, constant))
    if equation == "add":
        return flush(binary32(p + q))
    if equation == "subtract":
        return flush(binary32(p - q))
    if equation == "reverse_subtract":
        return flush(binary32(q - p))
    raise ValueError("equation " + equation)


def answer(line):
    """One line of input to one of output; every channel reads what stood in the target before (fragment-stages.md 8.1)."""
    t = line.split()
    terms = (t[0:3],) * 3 + (t[3:6],)
    constant, source = [float_of(x) for x in t[6:10]], [float_of(x) for x in t[10:14]]
    target = [half_of(x) for x in t[14:18]]
    return " ".join("%04x" % to_half(blended(terms[c], c, source, target, constant)) for c in range(4))


def main():
    """Standard input to standard output, line by line."""
    sys.stdout.writelines(answer(line) + "\n" for line in sys.stdin if line.strip())


if __name__ == "__main__":
    main()
