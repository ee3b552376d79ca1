// tests/support/composite_model.h - expected result of each exact algorithm at one pixel, computed fragment by fragment
// from peeling/reference/algorithms.md 0 and 2 to 6 with the arithmetic of pipeline/reference/fragment-stages.md 8 to 9
// and pipeline/reference/formats.md 2 to 3. It shares no code with the implementation. Target values are modelled
// independently: integers over 255, or binary32 (rounded to an 11-bit significand for half).
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

#include "pipeline/formats/format.h"
#include "tests/support/fragment_scene.h"

namespace strata::testing {

using pipeline::Format;
using pipeline::Rgba;

// A colour target. Values are as a shader reads them: k / 255 rounded to binary32, or the float itself.
struct TargetModel {
    Format format = Format::rgba8;

    // The k with 2 k - 1 <= 510 x < 2 k + 1, within 0 .. 255; products by 510 are exact in binary64.
    [[nodiscard]] static int code_255(float x) {
        if (!(x > 0.0f)) return 0;
        int k = x < 1.0f ? static_cast<int>(255.0f * x) : 255;
        while (k > 0 && 510.0 * double{x} < 2 * k - 1) --k;
        while (k < 255 && 510.0 * double{x} >= 2 * k + 1) ++k;
        return k;
    }
    [[nodiscard]] static float as_float(int k) { return static_cast<float>(k) / 255.0f; }
    // Nearest code of t / 255^2, which is t / 255 rounded; there are no ties because 255 is odd.
    [[nodiscard]] static float from_products(int t) { return as_float((2 * t + 255) / 510); }
    // Nearest multiple of the half format's spacing, ties to even. Values in these tests stay below 65504.
    [[nodiscard]] static float to_half_precision(float x) {
        const int exponent = x == 0.0f ? -14 : std::max(std::ilogb(x), -14);
        return std::ldexp(std::nearbyint(std::ldexp(x, 10 - exponent)), exponent - 10);
    }

    [[nodiscard]] float stored(float x) const {
        if (format == Format::rgba8) return as_float(code_255(x));
        return format == Format::rgba16f ? to_half_precision(x) : x;
    }
    // The target's code of a value that is already representable in it; colours are not negative.
    [[nodiscard]] std::uint32_t code(float value) const {
        if (format == Format::rgba8) return static_cast<std::uint32_t>(code_255(value));
        const auto bits = std::bit_cast<std::uint32_t>(value);
        if (format == Format::rgba32f) return bits;
        return value < 0x1p-14f ? static_cast<std::uint32_t>(value * 0x1p24f) : (bits >> 13) - (112u << 10);
    }

    // (SRC_ALPHA, ONE_MINUS_SRC_ALPHA): source s of alpha a onto d.
    [[nodiscard]] float over(float s, float a, float d) const {
        const int A = code_255(a);
        if (format == Format::rgba8) return from_products(code_255(s) * A + code_255(d) * (255 - A));
        const float source = s * a, destination = d * (1.0f - a);
        return stored(source + destination);
    }
    // UNDER, (DST_ALPHA, ONE): adds premultiplied s behind d; T is the transmittance of the layers in front.
    [[nodiscard]] float under(float d, float T, float s) const {
        if (format == Format::rgba8)
            return from_products(std::min(code_255(s) * code_255(T) + code_255(d) * 255, 65025));
        const float source = s * T;
        return stored(source + d);
    }
    // (ZERO, ONE_MINUS_SRC_ALPHA): transmittance T after a layer of alpha a.
    [[nodiscard]] float faded(float T, float a) const {
        if (format == Format::rgba8) return from_products(code_255(T) * (255 - code_255(a)));
        return stored(T * (1.0f - a));
    }
};

// The targets of a peel. front: the accumulation target, also of front-to-back peels. back: the back target of dual
// peeling, initialised with the background. picture: the final image.
struct PeelTargets {
    TargetModel front{}, back{}, picture{};
    PeelTargets(const TargetModel& all) : front{all}, back{all}, picture{all} {}
    PeelTargets(Format of_front, Format of_back, Format of_picture)
        : front{of_front}, back{of_back}, picture{of_picture} {}
};

// Visible fragments by depth, near to far; within a depth in submission order.
using DepthGroups = std::map<float, std::vector<Rgba>>;

[[nodiscard]] inline DepthGroups groups_of(const std::vector<GivenFragment>& visible_fragments) {
    DepthGroups groups;
    for (const GivenFragment& f : visible_fragments) groups[f.depth].push_back(f.color);
    return groups;
}

// peeling/reference/algorithms.md 2. Of equal depths only the first submitted fragment is kept; layers are stored with
// non-premultiplied colour.
[[nodiscard]] inline Rgba depth_units_model(const PeelTargets& targets, const DepthGroups& groups,
                                            const Rgba& background) {
    Rgba result = background;
    for (auto layer = groups.rbegin(); layer != groups.rend(); ++layer) {
        const Rgba& source = layer->second.front();
        for (std::size_t c = 0; c < 3; ++c)
            result[c] = targets.front.over(targets.front.stored(source[c]), targets.front.stored(source[3]), result[c]);
    }
    for (std::size_t c = 0; c < 3; ++c) result[c] = targets.picture.stored(result[c]);
    return result;
}

// peeling/reference/algorithms.md 4. Of equal depths only the first submitted fragment is kept; a layer is stored
// premultiplied and blended UNDER.
[[nodiscard]] inline Rgba front_to_back_model(const PeelTargets& targets, const DepthGroups& groups,
                                              const Rgba& background) {
    Rgba front{0, 0, 0, 1};
    for (const auto& [depth, sources] : groups) {
        const Rgba& source = sources.front();
        const float alpha = targets.front.stored(source[3]);
        for (std::size_t c = 0; c < 3; ++c)
            front[c] = targets.front.under(front[c], front[3], targets.front.stored(source[c] * source[3]));
        front[3] = targets.front.faded(front[3], alpha);
    }
    Rgba result{0, 0, 0, 1};
    for (std::size_t c = 0; c < 3; ++c) {
        const float through = front[3] * background[c];
        result[c] = targets.picture.stored(front[c] + through);
    }
    return result;
}

// peeling/reference/algorithms.md 5. All fragments of a peeled depth write; component-wise MAX merges them into one
// layer.
[[nodiscard]] inline Rgba dual_model(const PeelTargets& targets, DepthGroups groups, const Rgba& background,
                                     int peels = 1 << 20) {
    Rgba front{0, 0, 0, 0}, back = background;  // front alpha: 1 - transmittance
    for (; peels > 0 && !groups.empty(); --peels) {
        const float T = 1.0f - front[3];
        Rgba next = front;
        for (const Rgba& s : groups.begin()->second) {
            for (std::size_t c = 0; c < 3; ++c) {
                const float premultiplied = s[3] * s[c];
                const float added = T * premultiplied;
                next[c] = std::max(next[c], targets.front.stored(front[c] + added));
            }
            const float left = T * (1.0f - s[3]);
            next[3] = std::max(next[3], targets.front.stored(1.0f - left));
        }
        groups.erase(groups.begin());
        front = next;
        if (groups.empty()) break;
        Rgba dump{0, 0, 0, 0};
        for (const Rgba& s : std::prev(groups.end())->second)
            for (std::size_t c = 0; c < 4; ++c) dump[c] = std::max(dump[c], targets.back.stored(s[c]));
        groups.erase(std::prev(groups.end()));
        for (std::size_t c = 0; c < 3; ++c)
            if (dump[3] != 0.0f) back[c] = targets.back.over(dump[c], dump[3], back[c]);
    }
    Rgba result{0, 0, 0, 1};
    for (std::size_t c = 0; c < 3; ++c) {
        const float through = (1.0f - front[3]) * back[c];
        result[c] = targets.picture.stored(front[c] + through);
    }
    return result;
}

// peeling/reference/algorithms.md 6. Every fragment is blended. Of equal depths the first submitted is in front in the
// front half, the last submitted in the back half.
[[nodiscard]] inline Rgba dual_independent_model(const PeelTargets& targets, DepthGroups groups,
                                                 const Rgba& background) {
    Rgba front{0, 0, 0, 1}, back = background;
    while (!groups.empty()) {
        for (const Rgba& s : groups.begin()->second) {
            for (std::size_t c = 0; c < 3; ++c) front[c] = targets.front.under(front[c], front[3], s[c] * s[3]);
            front[3] = targets.front.faded(front[3], s[3]);
        }
        groups.erase(groups.begin());
        if (groups.empty()) break;
        for (const Rgba& s : std::prev(groups.end())->second)
            for (std::size_t c = 0; c < 3; ++c) back[c] = targets.back.over(s[c], s[3], back[c]);
        groups.erase(std::prev(groups.end()));
    }
    Rgba result{0, 0, 0, 1};
    for (std::size_t c = 0; c < 3; ++c) {
        const float through = front[3] * back[c];
        result[c] = targets.picture.stored(front[c] + through);
    }
    return result;
}

// peeling/reference/algorithms.md 17, the oracle: all fragments in binary64; of equal depths the first submitted is in
// front.
[[nodiscard]] inline std::array<double, 3> exact_composite(const DepthGroups& groups, const Rgba& background) {
    std::array<double, 3> result{background[0], background[1], background[2]};
    for (auto depth = groups.rbegin(); depth != groups.rend(); ++depth)
        for (auto s = depth->second.rbegin(); s != depth->second.rend(); ++s)
            for (std::size_t c = 0; c < 3; ++c)
                result[c] = double{(*s)[3]} * (*s)[c] + (1.0 - double{(*s)[3]}) * result[c];
    return result;
}

}  // namespace strata::testing
