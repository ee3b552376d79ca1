// peeling/programs/under_text-inl.h - two composites, as one text for scalars and vectors: UNDER as dual peeling's
// fragment program computes it on the front colour, and the last quad of a peel, which puts the front over the colour
// behind it. under.h includes the text for single lanes, block_passes_simd.cpp for vectors, each in its own namespace,
// because kernels must be compiled for their instruction set.
//
// Rule     The alpha of dual's front is its coverage, so its transmittance `through` is 1 - alpha. Colour: front +
//          through (alpha colour), with the near fragment's alpha and colour. Alpha: 1 - through (1 - alpha). The last
//          quad: front + through behind. Every operation is rounded, in this order. `Lanes` broadcasts a constant to
//          all lanes; `Value` is a binary32 value or a vector of them.
// Source   peeling/reference/algorithms.md 0.4 and 5 (Bavoil and Myers 2008, "Dual Depth Peeling").
template <class Lanes, class Value>
[[gnu::always_inline]] constexpr Value let_through(Lanes lanes, Value front_alpha) {
    return lanes.all(1.0f) - front_alpha;
}
template <class Value>
[[gnu::always_inline]] constexpr Value under(Value front, Value through, Value alpha, Value color) {
    return front + through * (alpha * color);
}
template <class Lanes, class Value>
[[gnu::always_inline]] constexpr Value covered(Lanes lanes, Value through, Value alpha) {
    return lanes.all(1.0f) - through * (lanes.all(1.0f) - alpha);
}
template <class Value>
[[gnu::always_inline]] constexpr Value composited(Value front, Value through, Value behind) {
    return front + through * behind;
}
