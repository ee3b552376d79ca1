// rasterizer/coverage/fragment_batch.h - a batch of fragments on the way through the stages, as arrays. The fragments
// of a batch have one material, are in submission order, and no two are of the same pixel: a stage can read, change and
// write back the stored values of all of them in one loop, in any order.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "rasterizer/rules/depth_code.h"
#include "rasterizer/rules/rules.h"

namespace strata::rasterizer {

// Fragments of a batch. Kernels write whole vectors, so a batch is passed on before it is completely full
// (usable_capacity in small_triangles.h).
inline constexpr int batch_capacity = 256;

template <class T>
using Lanes = std::array<T, batch_capacity>;

inline constexpr std::size_t texture_units = 4;
// A set of texture coordinates: bit 4 u + c is component c (s t r q) of unit u.
using UnitMask = std::uint16_t;
[[nodiscard]] constexpr bool names(UnitMask mask, std::size_t unit, std::size_t component) noexcept {
    return (mask >> (4 * unit + component) & 1) != 0;
}

struct alignas(64) FragmentBatch {
    Lanes<std::uint32_t> pixel;         // index into the region, row-major
    Lanes<std::uint16_t> x, y;          // window position of the pixel, y down
    Lanes<std::uint32_t> primitive;     // submission index of the source triangle
    Lanes<float> shader_z;              // the depth that a fragment program reads: binary32, not clamped, not quantized
    Lanes<std::uint32_t> code;          // the depth as this pass's buffer would store it
    Lanes<std::uint32_t> exact_code;    // the same by DepthPath::exact, if requested
    std::array<Lanes<float>, 4> color;  // r g b a, interpolated
    std::array<Lanes<float>, 2> texcoord;  // s t
    Lanes<std::uint8_t> front_facing;
    int count = 0;
    std::uint32_t material = 0;
    // The depth that a program compares with stored ones: by DepthRequest::reference, or by the stored path.
    Lanes<std::uint32_t> reference_code;                          // quantized like a depth write
    Lanes<double> reference_z;                                    // before quantization, not clamped, in the buffer's
                                                                  // own units
    std::array<std::array<Lanes<float>, 4>, texture_units> unit;  // s t r q of each texture unit, not divided by q
    Lanes<float> fog;                                             // the fog coordinate
    std::array<Lanes<float>, 4> secondary;                        // r g b a of the secondary colour, interpolated
};

// The arrays of a batch that a pass uses; the others have unspecified contents. pixel, x, y and primitive are always
// filled.
struct FragmentNeeds {
    bool shader_z = true, code = true, exact_code = false, color = true, texcoord = false, facing = false;
    bool reference = false;  // reference_code and reference_z; requires code
    UnitMask units = 0;
    bool fog = false, secondary = false;
    // Values of VertexExtras: they are interpolated beside colour and texture coordinates, and are not recorded.
    [[nodiscard]] constexpr bool has_extras() const noexcept { return units != 0 || fog || secondary; }
    friend bool operator==(const FragmentNeeds&, const FragmentNeeds&) = default;
    [[nodiscard]] friend constexpr FragmentNeeds operator|(FragmentNeeds a, FragmentNeeds b) noexcept {
        return {a.shader_z || b.shader_z,
                a.code || b.code,
                a.exact_code || b.exact_code,
                a.color || b.color,
                a.texcoord || b.texcoord,
                a.facing || b.facing,
                a.reference || b.reference,
                static_cast<UnitMask>(a.units | b.units),
                a.fog || b.fog,
                a.secondary || b.secondary};
    }
};

// How depth is computed: the path and the storage format of `code`, and the path of the depth that is compared with it
// (empty: the same path).
struct DepthRequest {
    DepthPath path = DepthPath::float32;
    DepthFormat format = DepthFormat::d32f;
    std::optional<DepthPath> reference{};
    friend bool operator==(const DepthRequest&, const DepthRequest&) = default;
};

}  // namespace strata::rasterizer
