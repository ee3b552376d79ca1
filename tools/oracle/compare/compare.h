// tools/oracle/compare/compare.h - compares a candidate image with a reference: the kind of each difference, and
// mistakes that would explain all of them.
//
// Rule     Targets are paired by part and name, or by meaning if an image has only one of that meaning. A pixel differs
//          if a paired code does, and gets the first kind that fits, in the order of `Kind`. Differences are only
//          accepted within a tolerance; `equal` uses no tolerance.
// Tests    tests/tools/oracle/compare/compare_test.cpp, compare_layers_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "tools/oracle/compare/coverage.h"
#include "tools/oracle/compare/explanations.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

enum class Kind : std::uint8_t {
    none,
    not_finite,     // NaN or infinite in one image, and not the same in the other
    unseen,         // straight colours where alpha is 0 in both images
    coverage,       // drawn in one image only
    background,     // drawn in neither image
    layer_missing,  // the candidate lacks some of the reference's layers
    layer_doubled,  // a layer occurs twice
    layer_swapped,  // the reference's layers are in another order
    layer_merged,   // two layers are merged into one
    layer_other,    // other layers, or another number of layers
    depth,
    color
};
inline constexpr std::size_t kind_count = 12;
[[nodiscard]] std::string_view name(Kind kind) noexcept;

// The number of pixels that may differ: a count, or a share of all pixels, whichever is larger.
struct PixelBudget {
    std::uint64_t pixels = 0;
    double share = 0;  // from 0 to 1
    [[nodiscard]] std::uint64_t allowed(std::uint64_t all) const noexcept {
        return std::max(pixels, static_cast<std::uint64_t>(share * static_cast<double>(all)));
    }
    friend bool operator==(const PixelBudget&, const PixelBudget&) = default;
};

// The tolerances; 0: none.
struct Tolerances {
    std::uint32_t color_codes = 0, depth_codes = 0;       // in codes of the reference's type, at every pixel
    std::map<std::string, std::uint32_t> target_codes{};  // of targets by name, instead of the two above
    // Pixels that may differ beyond the tolerance in codes, by kind: coverage, the background, layers of any kind,
    // depth, colour, colours that are not seen; and a budget for the remaining pixels of these kinds. NaN and infinity
    // have a budget of their own.
    PixelBudget coverage{}, background{}, layers{}, depth{}, color{}, unseen{}, pixels{}, not_finite{};
    ColorChannels channels = ColorChannels::all;  // of colour targets
    friend bool operator==(const Tolerances&, const Tolerances&) = default;

    [[nodiscard]] std::uint32_t codes_of(const TargetImage& target) const {
        const auto own = target_codes.find(target.name);
        if (own != target_codes.end()) return own->second;
        return target.meaning == Meaning::depth ? depth_codes : color_codes;
    }
};

// The part of a nonzero budget that was used.
struct SpentBudget {
    std::string_view name;  // "coverage"
    std::uint64_t pixels = 0, allowed = 0;
};

// Pixels that differ and are NaN, or infinite, in the reference and in the candidate.
struct NotFinite {
    std::array<std::uint64_t, 2> pixels{};
    int first_x = -1, first_y = -1;
};

struct TargetReport {
    std::string part, name{};
    Code reference = Code::unorm8, candidate = Code::unorm8;
    int channels = 0;                         // number of channels compared
    std::uint64_t differing = 0, beyond = 0;  // pixels; beyond: by more than the target's tolerance in codes
    std::uint32_t greatest = 0;               // largest distance between finite values
    std::map<std::uint32_t, std::uint64_t>
        distances{};  // number of pixels per distance of their worst channel, without 0 and those that are not finite
    NotFinite nan{}, infinite{};
    // For colours that differ: root mean square over all channels in 1/255, and 20 log10(255 / rmse) in decibels.
    std::optional<double> rmse{}, psnr{};
};

struct KindReport {
    Kind kind = Kind::none;
    std::uint64_t pixels = 0, beyond = 0;  // beyond: not accepted by a tolerance
    int first_x = -1, first_y = -1;        // of the pixels that are not accepted, or of all if all are accepted
    std::string detail{};
};

struct Comparison {
    int width = 0, height = 0;
    std::uint64_t differing = 0;
    std::vector<TargetReport> targets{};
    std::vector<KindReport> kinds{};          // those that occur
    std::vector<Explanation> explanations{};  // the best first
    std::vector<std::string> not_compared{};  // targets and channels of only one of the images
    std::vector<std::string> notes{};         // conversions that made targets comparable (pairs.h)
    std::vector<SpentBudget> spent{};
    std::vector<Kind> kind_of{};               // per pixel
    std::vector<std::uint32_t> distance_of{};  // per pixel, the largest distance
    std::array<bool, kind_count> is_tested{};  // whether the targets can show the kind: layers, depths, a background
    std::vector<bool> is_beyond{};             // per pixel: differs by more than the tolerances in codes accept
    bool equal = false, accepted = false;      // equal: without tolerances; accepted: with tolerances
    // The largest distance of all targets.
    [[nodiscard]] std::uint32_t greatest() const noexcept {
        std::uint32_t most = 0;
        for (const TargetReport& target : targets) most = std::max(most, target.greatest);
        return most;
    }
};

// InputError for images of unequal size and for those that have no target in common. `background` is the reference's if
// the caller knows it (coverage.h); else it is estimated from the images.
[[nodiscard]] Comparison compare(const Picture& reference, const Picture& candidate, const Tolerances& tolerances = {},
                                 const Background& background = {});

}  // namespace strata::oracle
