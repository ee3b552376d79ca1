// tools/oracle/compare.h - how a candidate differs from a reference: the kind of each difference, and what would explain them all.
//
// Rule     Targets are paired by part and name, or by meaning where a picture has one of that meaning alone. A pixel differs if a paired
//          code does, and gets the first kind that fits, in the order of `Kind`. Nothing is forgiven unless a tolerance says so;
//          `equal` knows no tolerance.
// Tests    tests/tools/oracle/compare_test.cpp, compare_layers_test.cpp
#pragma once
#include <array>
#include <map>
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

// What may be forgiven; 0: nothing.
struct Tolerances {
    std::uint32_t color_codes = 0, depth_codes = 0;  // of the reference's type, at every pixel
    std::uint64_t coverage_pixels = 0;               // how many pixels may differ in coverage
    friend bool operator==(const Tolerances&, const Tolerances&) = default;
};

struct TargetReport {
    std::string part, name{};
    Code reference = Code::unorm8, candidate = Code::unorm8;
    int channels = 0;  // compared
    std::uint64_t differing = 0;
    std::uint32_t greatest = 0;  // distance
    std::map<std::uint32_t, std::uint64_t>
        distances{};  // pixels by the distance of their worst channel; equal ones left out
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
    std::vector<KindReport> kinds{};           // those that occur
    std::vector<Explanation> explanations{};   // the best first
    std::vector<std::string> not_compared{};   // targets and channels of one picture alone
    std::vector<Kind> kind_of{};               // each pixel
    std::vector<std::uint32_t> distance_of{};  // each pixel's greatest distance
    std::array<bool, kind_count> is_tested{};  // whether the targets can show the kind: layers, depths, a background
    bool equal = false, accepted = false;      // without and with tolerances
};

// InputError for pictures of unequal size and for those that share no target.
// `background` is the reference's where the caller knows it (coverage.h); else it is read from the pictures.
[[nodiscard]] Comparison compare(const Picture& reference, const Picture& candidate, const Tolerances& tolerances = {},
                                 const Background& background = {});

}  // namespace strata::oracle
