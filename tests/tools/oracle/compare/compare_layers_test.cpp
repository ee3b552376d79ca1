// Tests the comparison of layers on stacks with one deliberate mistake per pixel.
#include <catch2/catch.hpp>

#include "tests/tools/oracle/picture/pictures.h"
#include "tools/oracle/compare/compare.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

using Column = std::vector<Texel>;  // the layers of one pixel, near to far

// A file with layers of one pixel each.
Picture layered(const Column& column, std::size_t parts, const std::vector<std::uint32_t>& depths = {}) {
    std::vector<TargetImage> targets;
    for (std::size_t i = 0; i < parts; ++i) {
        const Texel texel = i < column.size() ? column[i] : Texel{0, 0, 0, 0};
        const std::string part = "layer.00" + std::to_string(i);
        targets.push_back(make_target(part, Code::unorm8, 1, 1, 4, [&](int, int) { return texel; }));
        if (!depths.empty())
            targets.push_back(make_target(part, Code::unorm24, 1, 1, 1, [&](int, int) -> Texel {
                return {i < depths.size() ? depths[i] : 0xffffffu, 0, 0, 0};
            }));
    }
    return make_picture(std::move(targets));
}

Kind kind_of(const Column& reference, const Column& candidate) {
    return compare(layered(reference, 5), layered(candidate, 5)).kind_of[0];
}

const Texel layer_a{10, 200, 30, 100}, layer_b{90, 20, 60, 50}, layer_c{7, 8, 9, 10}, layer_x{1, 2, 3, 4};

}  // namespace

TEST_CASE("layers of a pixel are classified as equal missing doubled swapped or merged in any parts") {
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a, layer_b, layer_c}) == Kind::none);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_b, layer_c}) == Kind::layer_missing);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a, layer_c}) == Kind::layer_missing);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a}) == Kind::layer_missing);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {}) == Kind::layer_missing);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a, layer_b, layer_b, layer_c}) == Kind::layer_doubled);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a, layer_a, layer_c}) == Kind::layer_doubled);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_b, layer_a, layer_c}) == Kind::layer_swapped);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_c, layer_b, layer_a}) == Kind::layer_swapped);
    // component-wise MAX of a and b
    CHECK(kind_of({layer_a, layer_b, layer_c}, {{90, 200, 60, 100}, layer_c}) == Kind::layer_merged);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a, layer_b, layer_x}) == Kind::color);
    CHECK(kind_of({layer_a, layer_b, layer_c}, {layer_a, layer_x}) == Kind::layer_other);
    CHECK(kind_of({layer_a}, {layer_a, layer_x, layer_b}) == Kind::layer_other);
}

TEST_CASE(
    "two layers of one depth that became one are merged whatever its colour and one that is left unchanged is not") {
    const std::vector<std::uint32_t> depths{5, 5, 9}, fewer{5, 9};
    CHECK(compare(layered({layer_a, layer_b, layer_c}, 3, depths), layered({layer_x, layer_c}, 3, fewer)).kind_of[0] ==
          Kind::layer_merged);
    CHECK(compare(layered({layer_a, layer_b, layer_c}, 3, depths), layered({layer_a, layer_c}, 3, fewer)).kind_of[0] ==
          Kind::layer_missing);
    CHECK(compare(layered({layer_a, layer_b, layer_c}, 3, depths), layered({layer_b, layer_c}, 3, fewer)).kind_of[0] ==
          Kind::layer_missing);
}

TEST_CASE("the same number of layers with another depth differ in depth") {
    CHECK(compare(layered({layer_a, layer_b}, 3, {5, 6}), layered({layer_a, layer_b}, 3, {5, 7})).kind_of[0] ==
          Kind::depth);
}

TEST_CASE("a file with fewer parts than the reference is compared as far as it goes and reports missing layers") {
    const Comparison found = compare(layered({layer_a, layer_b, layer_c}, 3), layered({layer_a, layer_b}, 2));
    CHECK(found.kind_of[0] == Kind::layer_missing);
    CHECK_FALSE(found.equal);
    CHECK(found.not_compared == std::vector<std::string>{"color of layer.002: in the reference alone"});
}
