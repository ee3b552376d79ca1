// pipeline/vertices/primitive_range.h - a part of a draw list: triangles with consecutive submission indices.
#pragma once
#include <cstdint>

namespace strata::pipeline {

struct PrimitiveRange {
    std::uint32_t first = 0, last = 0;  // `last` is exclusive; first == last: empty
    friend bool operator==(const PrimitiveRange&, const PrimitiveRange&) = default;
};

}  // namespace strata::pipeline
