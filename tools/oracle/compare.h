// tools/oracle/compare.h - how a candidate differs from a reference: the kind of each difference, and what would
// explain them all.
//
// Rule     Targets are paired by part and name, or by meaning where a picture has one of that meaning alone. A pixel
//          differs if a paired code does, and gets the first kind that fits, in the order of `Kind`. Nothing is
//          forgiven unless a tolerance says so; `equal` knows no tolerance.
// Tests    tests/tools/oracle/compare_test.cpp, compare_layers_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "tools/oracle/coverage.h"
#include "tools/oracle/explanations.h"
#include "tools/oracle/picture.h"

namespace strata::oracle {

enum class Kind : std::uint8_t {
    none,
    coverage,       // drawn in one picture alone
    background,     // drawn in neither
    layer_missing,  // the candidate's layers are the reference's without some
    layer_doubled,  // a layer stands twice
    layer_swapped,  // the reference's layers in another order
    layer_merged,   // two layers have become one
    layer_other,    // other layers, of another number
    depth,
    color
};
inline constexpr std::size_t kind_count = 10;
[[nodiscard]] std::string_view name(Kind kind) noexcept;

// How many pixels may differ: a number, or a share of all pixels, whichever allows more.
struct Budget {
    std::uint64_t pixels = 0;
    double share = 0;  // from 0 to 1
    [[nodiscard]] std::uint64_t allowed(std::uint64_t all) const noexcept {
        return std::max(pixels, static_cast<std::uint64_t>(share * static_cast<double>(all)));
    }
    friend bool operator==(const Budget&, const Budget&) = default;
};

// What may be forgiven; 0: nothing.
struct Tolerances {
    std::uint32_t color_codes = 0, depth_codes = 0;       // of the reference's type, at every pixel
    std::map<std::string, std::uint32_t> target_codes{};  // of targets by their names, in place of the two
    // Pixels that may differ all the same, by what they differ in: coverage, the background, layers of any kind, and
    // depths and colours that are further apart; and of those that are left over, whatever they differ in.
    Budget coverage{}, background{}, layers{}, depth{}, color{}, pixels{};
    ColorChannels channels = ColorChannels::all;  // of colours
    friend bool operator==(const Tolerances&, const Tolerances&) = default;

    [[nodiscard]] std::uint32_t codes_of(const Target& target) const {
        const auto own = target_codes.find(target.name);
        if (own != target_codes.end()) return own->second;
        return target.meaning == Meaning::depth ? depth_codes : color_codes;
    }
};

// What was taken of a budget that allows something.
struct SpentBudget {
    std::string_view name;  // "coverage"
    std::uint64_t pixels = 0, allowed = 0;
};

struct TargetReport {
    std::string part, name{};
    Code reference = Code::unorm8, candidate = Code::unorm8;
    int channels = 0;                         // compared
    std::uint64_t differing = 0, beyond = 0;  // pixels; beyond: further apart than the target's codes allow
    std::uint32_t greatest = 0;               // distance
    std::map<std::uint32_t, std::uint64_t>
        distances{};  // pixels by the distance of their worst channel; equal ones left out
    // Of colours that differ: root mean square over all channels in 1/255, and 20 log10(255 / rmse) in decibels.
    std::optional<double> rmse{}, psnr{};
};

struct KindReport {
    Kind kind = Kind::none;
    std::uint64_t pixels = 0, beyond = 0;  // beyond: not forgiven
    int first_x = -1, first_y = -1;        // of those that are not forgiven, or else of all
    std::string detail{};
};

struct Comparison {
    int width = 0, height = 0;
    std::uint64_t differing = 0;
    std::vector<TargetReport> targets{};
    std::vector<KindReport> kinds{};          // those that occur
    std::vector<Explanation> explanations{};  // the best first
    std::vector<std::string> not_compared{};  // targets and channels of one picture alone
    std::vector<std::string> notes{};         // what was done to make targets comparable (pairs.h)
    std::vector<SpentBudget> spent{};
    std::vector<Kind> kind_of{};               // each pixel
    std::vector<std::uint32_t> distance_of{};  // each pixel's greatest distance
    std::array<bool, kind_count> is_tested{};  // whether the targets can show the kind: layers, depths, a background
    std::vector<bool> is_beyond{};             // each pixel: differs, and no tolerance of codes forgives it
    bool equal = false, accepted = false;      // without and with tolerances
};

// InputError for pictures of unequal size and for those that share no target.
// `background` is the reference's where the caller knows it (coverage.h); else it is read from the pictures.
[[nodiscard]] Comparison compare(const Picture& reference, const Picture& candidate, const Tolerances& tolerances = {},
                                 const Background& background = {});

}  // namespace strata::oracle
