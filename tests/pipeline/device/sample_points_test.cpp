// Tests the sample patterns against those of Direct3D 11, written by hand as rows of sixteen characters, and against
// NV20's two modes.
#include "pipeline/device/sample_points.h"

#include <catch2/catch.hpp>
#include <set>
#include <string>
#include <utility>

#include "pipeline/device/check.h"

namespace {

using namespace strata::pipeline;

[[nodiscard]] std::set<std::pair<int, int>> points_of(SamplePositions positions, int samples) {
    std::set<std::pair<int, int>> points;
    for (const auto& point : sample_points(positions, samples)) points.insert({point.x, point.y});
    return points;
}

[[nodiscard]] std::string refusal_of(const DeviceProfile& profile, int samples) {
    const std::optional<Refusal> refusal = check_multisampling(profile, samples);
    return refusal ? refusal->message(profile) : "";
}
[[nodiscard]] std::string refusal_of(std::string_view profile, int samples) {
    return refusal_of(*find_profile(profile), samples);
}

}  // namespace

TEST_CASE("standard samples are at Direct3D's positions with one per row and column") {
    using Points = std::set<std::pair<int, int>>;
    CHECK(points_of(SamplePositions::standard, 2) == Points{{4, 4}, {12, 12}});
    CHECK(points_of(SamplePositions::standard, 4) == Points{{6, 2}, {14, 6}, {2, 10}, {10, 14}});
    CHECK(points_of(SamplePositions::standard, 8) ==
          Points{{15, 1}, {5, 3}, {9, 5}, {1, 7}, {13, 9}, {7, 11}, {3, 13}, {11, 15}});
    for (const int samples : {2, 4, 8}) {
        std::set<int> rows, columns;
        int x = 0, y = 0;
        for (const auto& point : sample_points(SamplePositions::standard, samples)) {
            columns.insert(point.x), rows.insert(point.y);
            x += point.x - 8, y += point.y - 8;
        }
        CHECK(rows.size() == static_cast<std::size_t>(samples));
        CHECK(columns.size() == static_cast<std::size_t>(samples));
        CHECK((x == 0 && y == 0));  // their mean is the centre
    }
    CHECK(sample_points(SamplePositions::standard, 4)[0] == strata::rasterizer::SamplePoint{6, 2});
    CHECK(sample_points(SamplePositions::standard, 2)[0] == strata::rasterizer::SamplePoint{12, 12});
    CHECK(sample_points(SamplePositions::standard, 8)[7] == strata::rasterizer::SamplePoint{15, 1});
    CHECK(sample_points(SamplePositions::standard, 3).empty());
    CHECK(sample_points(SamplePositions::standard, 16).empty());
}

TEST_CASE("NV20 has a pattern of corner and centre and a square but none of eight samples") {
    using Points = std::set<std::pair<int, int>>;
    CHECK(points_of(SamplePositions::nv20, 2) == Points{{0, 0}, {8, 8}});
    CHECK(points_of(SamplePositions::nv20, 4) == Points{{4, 4}, {12, 4}, {4, 12}, {12, 12}});
    CHECK(sample_points(SamplePositions::nv20, 2)[1] == strata::rasterizer::SamplePoint{8, 8});
    CHECK(sample_points(SamplePositions::nv20, 8).empty());
}

TEST_CASE("numbers of samples that a device lacks are rejected by name") {
    for (const DeviceProfile& profile : builtin_profiles()) {
        CHECK_FALSE(check_multisampling(profile, 1));
        for (const int samples : {2, 4, 8})
            if (!check_multisampling(profile, samples))
                CHECK(sample_points(profile.sample_positions, samples).size() == static_cast<std::size_t>(samples));
    }
    CHECK(refusal_of("geforce8", 8).empty());
    CHECK(refusal_of("geforce3", 2).empty());
    CHECK(refusal_of("llvmpipe", 4).empty());
    CHECK(refusal_of("geforce3", 8) ==
          "profile geforce3 has no 8 samples per pixel (ARB_multisample); use geforce8, geforce8_dx101, "
          "ideal or direct3d11");
    CHECK(refusal_of("llvmpipe", 2) ==
          "profile llvmpipe has no 2 samples per pixel (ARB_multisample); use geforce3, geforce8, "
          "geforce8_dx101, ideal or direct3d11");
    CHECK(refusal_of("softpipe", 4).starts_with("profile softpipe has no 4 samples per pixel"));
    DeviceProfile own = *find_profile("softpipe");
    own.max_samples = 8, own.min_samples = 2;
    CHECK(refusal_of(own, 4).starts_with("profile softpipe has no 4 samples per pixel"));
}
