// peeling/sort.h - the order in which triangles are submitted: by the depth of their centroids, more or less well.
//
// Rule     Key: the sum of the three clip z, an increasing function of the centroid's eye depth for every projection
//          whose third row is (0, 0, a, b); NaN counts as 0; negated where the greater z is nearer. exact: by key, near
//          first, ties as listed. bucket: [least, greatest] key cut into N equal buckets, near first, within a bucket
//          as listed. reverse: far first, ties as listed. shuffle: exact, then a fraction of the triangles, drawn by
//          the seed, moves: each to the next one's place.
// Source   Carr, Mech and Miller 2008, section 9 (bucket sort of centroids); keys-and-counts.md 5.
// Tests    tests/peeling/sort_test.cpp
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

// The head of this file says what each rule does; `none` leaves the list as it is.
enum class SortRule : std::uint8_t { none, exact, bucket, reverse, shuffle };

struct Sort {
    SortRule rule = SortRule::none;
    // Each parameter counts for its own rule alone.
    int buckets = 256;       // bucket: at least 1
    double fraction = 0;     // shuffle: 0 to 1, of the triangles
    std::uint64_t seed = 0;  // shuffle
    friend bool operator==(const Sort&, const Sort&) = default;
};

// Which clip z is nearer: the less, or under reversed depth the greater.
enum class NearerZ : std::uint8_t { less, greater };

// Numbers of the soup's triangles in the order of their submission.
[[nodiscard]] std::vector<std::uint32_t> submission_order(const rasterizer::TriangleSoup& soup, const Sort& sort,
                                                          NearerZ nearer = NearerZ::less);

// A sort within parts, which are submitted one after the other: parts never mix.
struct PartSort {
    std::vector<std::uint32_t> part_of_run;  // the part of each run of the soup, counted from 0
    std::vector<bool> sorts;                 // by part; false: its triangles stay as listed
};
[[nodiscard]] pipeline::SubmissionOrder submission_order(const rasterizer::TriangleSoup& soup, const Sort& sort,
                                                         const PartSort& parts, NearerZ nearer = NearerZ::less);

}  // namespace strata::peeling
