// rasterizer/values/depth/code_lanes.h - converts the depths of several fragments to codes; the kind of code is chosen
// before the loop.
#pragma once
#include <cstdint>
#include <type_traits>

#include "rasterizer/rules/depth_code.h"

namespace strata::rasterizer {

template <CodeKind kind, class Value>
void to_codes_of(const Value* __restrict z, int count, const DepthConversion<Value> to,
                 std::uint32_t* __restrict out) noexcept {
    for (int i = 0; i < count; ++i) out[i] = depth_code<kind>(OneLane<Value>{}, z[i], to);
}

template <class Value>
void to_codes(const Value* z, int count, const DepthConversion<Value>& to, std::uint32_t* out) noexcept {
    if constexpr (std::is_same_v<Value, float>)
        if (to.wraps) {
            for (int i = 0; i < count; ++i) out[i] = to_wrapped_code(z[i], to);
            return;
        }
    switch (to.kind) {
        case CodeKind::fixed: return to_codes_of<CodeKind::fixed>(z, count, to, out);
        case CodeKind::fixed_product: return to_codes_of<CodeKind::fixed_product>(z, count, to, out);
        case CodeKind::fixed_truncated_product:
            return to_codes_of<CodeKind::fixed_truncated_product>(z, count, to, out);
        case CodeKind::binary32: return to_codes_of<CodeKind::binary32>(z, count, to, out);
        case CodeKind::d16f: return to_codes_of<CodeKind::d16f>(z, count, to, out);
        case CodeKind::d24f: return to_codes_of<CodeKind::d24f>(z, count, to, out);
    }
}

}  // namespace strata::rasterizer
