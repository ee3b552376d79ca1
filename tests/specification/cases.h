// tests/specification/cases.h - cases of three rules with the results of the implementation, one line of text each, for
// an independent implementation of the specification. A line is `inputs -> outputs`: integers and 8-bit codes in
// decimal, the bits of binary32 in eight and of halves in four hexadecimal digits.
#pragma once
#include <cstdint>
#include <iosfwd>

namespace strata::specification {

// x0 y0 z0 x1 y1 z1 x2 y2 z2 px py -> code: corners in units of 1/16 pixel (y down), their depths as bits of binary32
// in D24's units, a covered pixel; the code that `geforce3` stores there with the full depth range.
void write_window_z(std::ostream& out, std::uint64_t cases, std::uint64_t seed);

// FORMAT PASSES OPAQUE BACKGROUND N z r g b a ... -> r g b a: rgba8 or rgba16f; at most so many geometry passes (0:
// unlimited); the depth of the opaque surface or -; r g b a of that surface, or else of the background; N transparent
// fragments in order of submission, depth and straight colour. The outputs are the codes of dual's finished picture on
// `geforce8`.
void write_dual(std::ostream& out, std::uint64_t cases, std::uint64_t seed);

// EQ SRC DST EQ SRC DST CR CG CB CA SR SG SB SA DR DG DB DA -> r g b a: equation and factors of colour, of alpha; the
// constant colour; the source; stored halves in four hexadecimal digits. The outputs are the codes that an RGBA16F
// target of `geforce8` stores.
void write_blend(std::ostream& out, std::uint64_t cases, std::uint64_t seed);

}  // namespace strata::specification
