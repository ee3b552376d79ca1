// peeling/sort.h - the submission order of triangles: sorted by centroid depth, exactly or approximately.
//
// Rule     Key: the sum of the three clip z, an increasing function of the centroid's eye depth for every projection
//          whose third row is (0, 0, a, b); NaN counts as 0; negated where the greater z is nearer. exact: by key, near
//          first, ties as listed. bucket: the range [least, greatest] key is divided into N equal buckets, near first,
//          within a bucket as listed. reverse: far first, ties as listed. shuffle: exact, then a fraction of the
//          triangles, selected at random from the seed, is permuted in one cycle: each moves to the position of the
//          next.
// Source   Carr, Mech and Miller 2008, section 9 (bucket sort of centroids); peeling/reference/keys-and-counts.md 5.
// Tests    tests/peeling/frame/sort_test.cpp
#pragma once
#include <cstdint>
#include <vector>

namespace strata::rasterizer {
struct TriangleSoup;
}
namespace strata::pipeline {
struct SubmissionOrder;
}

namespace strata::peeling {

// The rules are described in the head of this file; `none` leaves the list unchanged.
enum class SortRule : std::uint8_t { none, exact, bucket, reverse, shuffle };

struct Sort {
    SortRule rule = SortRule::none;
    // Each parameter is used only by its own rule.
    int buckets = 256;       // bucket: at least 1
    double fraction = 0;     // shuffle: 0 to 1, of the triangles
    std::uint64_t seed = 0;  // shuffle
    friend bool operator==(const Sort&, const Sort&) = default;
};

// The nearer of two clip z: the smaller, or under reversed depth the greater.
enum class NearerZ : std::uint8_t { less, greater };

// Indices of the soup's triangles in submission order.
[[nodiscard]] std::vector<std::uint32_t> submission_order(const rasterizer::TriangleSoup& soup, const Sort& sort,
                                                          NearerZ nearer = NearerZ::less);

// A sort within parts, which are submitted one after another and never mixed.
struct PartSort {
    std::vector<std::uint32_t> part_of_run;  // the part of each run of the soup, from 0
    std::vector<bool> sorts;                 // by part; false: its triangles stay as listed
};
[[nodiscard]] pipeline::SubmissionOrder submission_order(const rasterizer::TriangleSoup& soup, const Sort& sort,
                                                         const PartSort& parts, NearerZ nearer = NearerZ::less);

}  // namespace strata::peeling
