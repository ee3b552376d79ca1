// peeling/programs/average_text-inl.h - the one text of weighted_average's resolve. average.h includes it for a lane at
// a time, and average-inl.h for vectors, each inside a namespace of its own: kernels must be compiled for their
// instruction set.
//
// Rule     t = (1 - a / n)^n by repeated squaring from the lowest bit of n: an odd n takes the base into the power,
//          then n is halved and the base squared. Squaring on behind the last bit changes nothing, so lanes of a vector
//          wait for each other. C = (sum / a) (1 - t) + background t. Every operation is rounded to binary32, in this
//          order. `Lanes` holds the operations without a sign of their own; `Value` is a binary32, or a vector of them.
template <class Lanes, class Value>
[[gnu::always_inline]] inline Value transmittance(Lanes lanes, Value a, Value n) {
    Value base = lanes.all(1.0f) - a / n, power = lanes.all(1.0f);
    for (auto left = lanes.whole(n); lanes.any(left); left = lanes.halved(left)) {
        power = lanes.if_odd(left, power * base, power);
        base = base * base;
    }
    return power;
}
template <class Lanes, class Value>
[[gnu::always_inline]] inline Value average_over(Lanes lanes, Value sum, Value a, Value t, Value background) {
    return (sum / a) * (lanes.all(1.0f) - t) + background * t;
}
