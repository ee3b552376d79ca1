// peeling/programs/average_text-inl.h - the resolve of weighted_average, as one text for scalars and vectors. average.h
// includes it for single lanes, average-inl.h for vectors, each in its own namespace, because kernels must be compiled
// for their instruction set.
//
// Rule     t = (1 - a / n)^n by repeated squaring from the lowest bit of n: if n is odd the power is multiplied by the
//          base, then n is halved and the base squared. Squaring after the last bit changes nothing, so all lanes of a
//          vector can run the same number of steps. C = (sum / a) (1 - t) + background t. Every operation is rounded to
//          binary32, in this order. `Lanes` provides the operations that have no operator; `Value` is a binary32 value
//          or a vector of them.
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
