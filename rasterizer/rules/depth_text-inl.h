// rasterizer/rules/depth_text-inl.h - the only definition of the conversion from depth to code. depth_code.h includes
// it for single values and weights-inl.h for vectors, each inside its own namespace, because kernels must be compiled
// for their instruction set.
//
// Rule     The value is clamped to the depth range; NaN and -0 become its lower end. Fixed point: times `scale`, plus
//          `half`, truncated. fixed_product: the product rounded to binary32, and that to the nearest even code.
//          fixed_truncated_product: the product rounded to binary32 and truncated. D32F: the bits of the binary32. D16F
//          and D24F: times `scale`, truncated to the format. `Lanes` provides the operations; `greater_or_second(a, b)`
//          is a if a > b, else b, like x86's MAX, and `less_or_second` is like MIN.
// Numbers  All formats except D32F are scaled in binary64, where products of 24 by 24 bits are exact; codes are below
//          2^31.
template <CodeKind kind, class Lanes, class Value, class Limit>
[[gnu::always_inline]] constexpr auto depth_code(Lanes lanes, Value z, const DepthConversion<Limit>& to) {
    const auto above = lanes.greater_or_second(z, lanes.all(to.least));
    const auto clamped = lanes.less_or_second(above, lanes.all(to.greatest));
    if constexpr (kind == CodeKind::binary32) {
        return lanes.bits(clamped);
    } else {
        const auto scaled = lanes.times(clamped, to.scale);
        if constexpr (kind == CodeKind::d16f)
            return lanes.truncate_to_d16f(scaled);
        else if constexpr (kind == CodeKind::d24f)
            return lanes.truncate_to_d24f(scaled);
        else if constexpr (kind == CodeKind::fixed_product)
            return lanes.nearest_even_of_product(scaled);
        else if constexpr (kind == CodeKind::fixed_truncated_product)
            return lanes.truncated_product(scaled);
        else
            return lanes.truncated_sum(scaled, to.half);
    }
}
