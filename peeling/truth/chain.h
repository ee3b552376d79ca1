// peeling/truth/chain.h - the steps (links) from a scene to a stored pixel, each computed as on the emulated device or
// without rounding.
// Rule     The links, each as on the device and exact:
//          transform   positions by the view's vertex path; exact: matrices and products in binary64
//          snap        viewport in binary32, positions rounded to the device's grid; exact: unsnapped, in binary64
//          plane       depth by the device's path; exact: the plane through the three corners
//          conversion  depth as the buffer's code; exact: not converted
//          color       colours, coordinates, textures by the device's rules; exact: perspective in binary64
//          blend       one layer per depth, blended over the target from the far end in the target's arithmetic;
//                      exact: every fragment, in binary64
//          store       opaque surfaces, layers and image in the colour format; exact: not rounded (blended: binary32)
//          A chain without an exact link gives the result of depth_units; with all links exact it is the truth.
// Source   peeling/reference/audit.md 14.
// Tests    tests/peeling/truth/chain_test.cpp, truth_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace strata::peeling {

// True where a link is exact.
struct Chain {
    bool transform = true, snap = true, plane = true, conversion = true, color = true, blend = true, store = true;
    friend bool operator==(const Chain&, const Chain&) = default;
};

// The links in the order in which a fragment meets them.
struct Link {
    std::string_view name;
    bool Chain::*is_exact;
};
inline constexpr std::array<Link, 7> links{{{"transform", &Chain::transform},
                                            {"snap", &Chain::snap},
                                            {"plane", &Chain::plane},
                                            {"conversion", &Chain::conversion},
                                            {"color", &Chain::color},
                                            {"blend", &Chain::blend},
                                            {"store", &Chain::store}}};

inline constexpr Chain exact_chain{};
inline constexpr Chain device_chain{false, false, false, false, false, false, false};

// The chain whose first `count` links are exact; the others are as on the device.
[[nodiscard]] constexpr Chain exact_up_to(std::size_t count) noexcept {
    Chain chain = device_chain;
    for (std::size_t i = 0; i < count; ++i) chain.*links[i].is_exact = true;
    return chain;
}
// The chain in which only `link` is exact; the others are as on the device.
[[nodiscard]] constexpr Chain exact_alone(std::size_t link) noexcept {
    Chain chain = device_chain;
    chain.*links[link].is_exact = true;
    return chain;
}

}  // namespace strata::peeling
