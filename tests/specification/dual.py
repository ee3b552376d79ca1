#!/usr/bin/env python3
"""Dual depth peeling of one pixel on profile `geforce8`: algorithms.md 5.1, exact exit, literally pass by pass.

Input lines:  FORMAT PASSES OPAQUE BACKGROUND N z r g b a ...   (rgba8 or rgba16f; greatest number of geometry passes, 0: no limit;
              opaque depth or -; background r g b a; N fragments in order of submission). All floats as bits of binary32.
Output lines: r g b a, the codes of the finished picture, decimal for rgba8 and four hexadecimal digits for rgba16f.
A binary32 is kept as a Python float of that value; every operation is rounded to binary32 (algorithms.md 0.2).
"""
import struct
import sys
from math import copysign, floor, inf

FLOAT, WORD = struct.Struct("<f"), struct.Struct("<I")
HALF, HALF_WORD = struct.Struct("<e"), struct.Struct("<H")
LEAST_NORMAL = 2.0 ** -126
STORED_NAN = 0x7E00 | 0x7FFFFF >> 13   # 0x7fffffff as a half: formats.md 3.2
EMPTY = (-1.0, -1.0)                   # RT0's neutral source and clear: algorithms.md 0.3, 5.1


def f32(x):
    """A binary64 rounded to binary32, nearest even: numbers.md 1.1."""
    try:
        return FLOAT.unpack(FLOAT.pack(x))[0]
    except OverflowError:
        return copysign(inf, x)


def flush(x):
    """`denormals` = flush: fragment-stages.md 9.1."""
    return copysign(0.0, x) if abs(x) < LEAST_NORMAL else x


def maximum(s, d):
    """MAX of a float target: fragment-stages.md 9.3, min_max_nan = other_operand."""
    a, b = flush(s), flush(d)
    if a == b:
        return a if copysign(1.0, a) > 0 or a != 0.0 else b
    return a if a > b or b != b else b


class Unorm8:
    """A channel of rgba8: formats.md 2, fragment-stages.md 8."""
    word = "%d"

    @staticmethod
    def load(code):
        """formats.md 2.2."""
        return f32(code / 255.0)

    @staticmethod
    def store(x):
        """formats.md 2.1."""
        if not x > 0.0:
            return 0
        return 255 if x >= 1.0 else floor(x * 255.0 + 0.5)

    @classmethod
    def max(cls, source, code):
        """MAX of the codes: fragment-stages.md 8.1, 8.2; a source is converted first (algorithms.md 5.3)."""
        return max(cls.store(source), code)

    @classmethod
    def over(cls, source, alpha, code, factor=None):
        """(SRC_ALPHA, or the factor given, ONE_MINUS_SRC_ALPHA) of one channel, nearest: fragment-stages.md 8.2."""
        a = cls.store(alpha)
        t = cls.store(source) * (a if factor is None else cls.store(factor)) + code * (255 - a)
        return (t + 128 + (t + 128 >> 8)) >> 8


class Half:
    """A channel of rgba16f: formats.md 3, fragment-stages.md 9."""
    word = "%04x"

    @staticmethod
    def load(code):
        """formats.md 3.1."""
        return HALF.unpack(HALF_WORD.pack(code))[0]

    @staticmethod
    def store(x):
        """formats.md 3.2, nearest_even. (A NaN's sign and payload are not kept: no input has one.)"""
        if x != x:
            return STORED_NAN
        if abs(x) >= 65520.0:
            return 0x7C00 if x > 0 else 0xFC00
        return HALF_WORD.unpack(HALF.pack(x))[0]

    @classmethod
    def max(cls, source, code):
        """fragment-stages.md 9.3 and 9.2. Rounding to half keeps order, so before or after (algorithms.md 5.3) is one."""
        return cls.store(maximum(source, cls.load(code)))

    @classmethod
    def over(cls, source, alpha, code, factor=None):
        """fragment-stages.md 9.1: two rounded products, a rounded sum, each flushed; then 9.2."""
        a = flush(alpha)
        f = a if factor is None else flush(factor)
        p, q = flush(f32(flush(source) * f)), flush(f32(cls.load(code) * flush(f32(1.0 - a))))
        return cls.store(flush(f32(p + q)))


FORMATS = {"rgba8": Unorm8, "rgba16f": Half}


def first_range(fragments, opaque):
    """Geometry pass 1: RT0 after the first draw of algorithms.md 5.1."""
    low, high = EMPTY
    for z, _, _ in fragments:
        r, g = (-z, z) if z < opaque else EMPTY
        low, high = maximum(r, low), maximum(g, high)
    return low, high


def under(old, colour, alpha):
    """`under` of algorithms.md 5.1: binary32, in the order that is written."""
    through = f32(1.0 - old[3])
    rgb = [f32(old[i] + f32(through * f32(alpha * colour[i]))) for i in range(3)]
    return rgb + [f32(1.0 - f32(through * f32(1.0 - alpha)))]


def shade(fragment, opaque, near, far, old):
    """What a fragment writes to RT0, RT1, RT2: skip, between, near or far of algorithms.md 5.1."""
    z, colour, alpha = fragment
    nothing = (0.0,) * 4
    if not (z < opaque and near <= z <= far):
        return EMPTY, old, nothing
    if near < z < far:
        return (-z, z), old, nothing
    if z == near:
        return EMPTY, under(old, colour, alpha), nothing
    return EMPTY, old, (*colour, alpha)


def peel(kind, fragments, opaque, rt0, rt1):
    """One geometry pass of the loop, MAX on cleared targets: new RT0 (values), RT1 and RT2 (codes)."""
    near, far = -rt0[0], rt0[1]
    old = [kind.load(code) for code in rt1]
    low, high = EMPTY
    new1, new2 = [0] * 4, [0] * 4
    for fragment in fragments:
        out0, out1, out2 = shade(fragment, opaque, near, far, old)
        low, high = maximum(out0[0], low), maximum(out0[1], high)
        new1 = [kind.max(s, d) for s, d in zip(out1, new1)]
        new2 = [kind.max(s, d) for s, d in zip(out2, new2)]
    return (low, high), new1, new2


def blend_back(kind, back, rt2):
    """The quad of algorithms.md 5.1: keep RT2.a != 0, OVER on red, green and blue; on alpha, where the background's is not 1,
    with ONE, ONE_MINUS_SRC_ALPHA (algorithms.md 0.4)."""
    r, g, b, a = (kind.load(code) for code in rt2)
    if not a != 0.0:
        return back
    alpha = back[3] if back[3] == kind.store(1.0) else kind.over(a, a, back[3], factor=1.0)
    return [kind.over(s, a, d) for s, d in zip((r, g, b), back)] + [alpha]


def last_quad(kind, rt1, back):
    """algorithms.md 0.4: product, then sum, then the store; alpha 1 - T (1 - behind.a)."""
    acc = [kind.load(code) for code in rt1]
    through = f32(1.0 - acc[3])
    alpha = f32(1.0 - f32(through * f32(1.0 - kind.load(back[3]))))
    return [kind.store(f32(acc[i] + f32(through * kind.load(back[i])))) for i in range(3)] + [kind.store(alpha)]


def dual(kind, limit, opaque, background, fragments):
    """algorithms.md 5.1 with the limit of keys-and-counts.md 3.2: an iteration needs one pass, the first draw counts."""
    back = [kind.store(x) for x in background]
    rt0, rt1, passes = first_range(fragments, opaque), [0] * 4, 1
    while not (limit and passes + 1 > limit):
        rt0, rt1, rt2 = peel(kind, fragments, opaque, rt0, rt1)
        passes += 1
        back = blend_back(kind, back, rt2)
        if rt0 == EMPTY:   # no query: the exact exit (algorithms.md 5.2)
            break
    return last_quad(kind, rt1, back)


def opaque_key(text):
    """The opaque surface's key: its depth as d32f, or that of 1.0: algorithms.md 0.1, keys-and-counts.md 1.1, depth.md 2.2."""
    if text == "-":
        return 1.0
    z = FLOAT.unpack(WORD.pack(int(text, 16)))[0]
    return min(z, 1.0) if z > 0.0 else 0.0


def answer(line):
    """One line of input to one of output."""
    t = line.split()
    kind = FORMATS[t[0]]
    values = [FLOAT.unpack(WORD.pack(int(x, 16)))[0] for x in t[8:8 + 5 * int(t[7])]]
    fragments = [(values[i], values[i + 1:i + 4], values[i + 4]) for i in range(0, len(values), 5)]
    background = [FLOAT.unpack(WORD.pack(int(x, 16)))[0] for x in t[3:7]]
    if t[2] != "-":
        background[3] = 1.0   # an opaque surface: algorithms.md 0.8
    return " ".join(kind.word % code for code in dual(kind, int(t[1]), opaque_key(t[2]), background, fragments))


def main():
    """Standard input to standard output, line by line."""
    sys.stdout.writelines(answer(line) + "\n" for line in sys.stdin if line.strip())


if __name__ == "__main__":
    main()
