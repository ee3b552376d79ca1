// Rows put down what batches hold. The model is the scalar twins' batches and a plain loop that appends each fragment to a list of
// its pixel.
#include "peeling/closed/arrival_rows.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/simd.h"
#include "rasterizer/walk/rows.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata;
using namespace strata::peeling;
using namespace strata::rasterizer;

struct Fragment {
    std::uint32_t key;
    std::array<float, 4> color;
    friend bool operator==(const Fragment&, const Fragment&) = default;
};

struct Pixel {
    std::vector<Fragment> visible;
    std::uint32_t fragments = 0, hidden = 0, at_surface = 0;
    friend bool operator==(const Pixel&, const Pixel&) = default;
};

enum class Surface { cleared, uneven };

struct Case {
    Geometry geometry;
    DepthRequest depth;
    Rect region;
    bool by_shader_z;
    Surface surface;

    [[nodiscard]] pipeline::RowSource source() const { return {geometry, geometry.all_triangles, depth}; }
    // shader_z or code of the opaque surface at a pixel.
    [[nodiscard]] std::uint32_t opaque(std::size_t pixel) const {
        const float z = surface == Surface::cleared ? 1.0f : 0.3f + 0.01f * static_cast<float>(pixel * 7 % 64);
        return by_shader_z ? std::bit_cast<std::uint32_t>(z) : to_depth_code(z, depth.format, DepthRounding::nearest);
    }
};

// All depths are positive: the order of their bits is theirs.
std::vector<Pixel> by_batches(const Case& given) {
    std::vector<Pixel> pixels(given.region.area());
    auto sink = [&](const FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            Pixel& pixel = pixels[batch.pixel[i]];
            const std::uint32_t depth =
                given.by_shader_z ? std::bit_cast<std::uint32_t>(batch.shader_z[i]) : batch.code[i];
            const std::uint32_t surface = given.opaque(batch.pixel[i]);
            ++pixel.fragments;
            pixel.hidden += depth >= surface ? 1 : 0;
            pixel.at_surface += depth == surface && !given.by_shader_z ? 1 : 0;
            if (depth < surface)
                pixel.visible.push_back({given.by_shader_z ? depth + 0x80000000u : depth,
                                         {batch.color[0][i], batch.color[1][i], batch.color[2][i], batch.color[3][i]}});
        }
    };
    TileRasterizer rasterizer{given.region};
    rasterizer.draw(given.geometry, given.geometry.all_triangles, given.depth,
                    {.shader_z = true, .code = true, .color = true}, BatchSink{sink});
    return pixels;
}

// What rows need, as they count it, and the room that this makes.
struct Room {
    std::vector<std::uint32_t> coverage, row_places;
    std::uint32_t ranks = 0, places = 0;

    explicit Room(const Case& given)
        : coverage(given.region.area() + row_padding), row_places(static_cast<std::size_t>(given.region.height())) {
        count_rows(given.source(), given.region, coverage.data(), row_places.data());
        coverage.resize(given.region.area());
        ranks = std::ranges::max(coverage);
        for (const std::uint32_t n : row_places) places += n;
    }
};

// Places, colours and words as rows leave them, read back pixel by pixel; empty if there was no room.
std::vector<Pixel> by_rows(const Case& given, std::uint32_t ranks, std::uint32_t places) {
    const std::size_t area = given.region.area(), stride = area + 16;
    std::vector<std::uint64_t> word(stride * std::max(ranks, 1u));
    std::array<std::vector<float>, 4> color;
    for (auto& channel : color) channel.resize(places + 2 * row_padding);
    std::vector<std::uint32_t> count(stride), hidden(stride), at_surface(stride), opaque;
    for (std::size_t i = 0; i < stride; ++i) opaque.push_back(given.opaque(i));
    constexpr auto first = static_cast<std::uint32_t>(row_padding);
    Arrivals to{.stride = stride,
                .ranks = ranks,
                .places = first,
                .most_places = first + places,
                .word = word.data(),
                .count = count.data(),
                .hidden = hidden.data(),
                .at_surface = at_surface.data(),
                .opaque = opaque.data(),
                .same_opaque = given.surface == Surface::cleared,
                .by_shader_z = given.by_shader_z};
    for (std::size_t c = 0; c < 4; ++c) to.color[c] = color[c].data();
    std::uint64_t fragments = 0;
    if (!append_rows(to, given.source(), given.geometry.all_triangles, given.region, fragments)) return {};
    std::vector<Pixel> pixels(area);
    for (std::size_t p = 0; p < area; ++p) {
        pixels[p].hidden = hidden[p];
        pixels[p].at_surface = at_surface[p];
        pixels[p].fragments = count[p] + hidden[p];
        fragments -= pixels[p].fragments;
        std::uint32_t last = 0;
        for (std::size_t rank = 0; rank < count[p]; ++rank) {
            const std::uint64_t held = word[rank * stride + p];
            const auto place = static_cast<std::uint32_t>(held);
            pixels[p].visible.push_back({static_cast<std::uint32_t>(held >> 32),
                                         {color[0][place], color[1][place], color[2][place], color[3][place]}});
            if (place <= last || place < first || place >= to.places)
                pixels[p].fragments = ~0u;  // not in the order of submission
            last = place;
        }
    }
    if (fragments != 0) pixels.clear();  // it told another number
    return pixels;
}

const RasterRules unsnapped{.tie_rule = TieRule::bottom_left, .plane_origin = PlaneOrigin::unsnapped};

}  // namespace

TEST_CASE(
    "rows put down the fragments of batches, in their order and with their colours, in the room that they ask for") {
    const std::vector<Device> devices{{{}, {DepthPath::float32, DepthFormat::d32f}},
                                      {{.subpixel_bits = 4}, {DepthPath::float32, DepthFormat::d16}},
                                      {unsnapped, {DepthPath::float32, DepthFormat::d24}}};
    constexpr std::array<std::array<int, 2>, 4> sizes{{{3, 150}, {8, 80}, {30, 24}, {300, 16}}};  // pixels, triangles
    std::size_t wrong = 0, compared = 0;
    for (const Device& device : devices)
        for (const auto& [size, count] : sizes)
            for (const Rect& region : {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}, Rect{69, 0, 70, 40}})
                for (const bool by_shader_z : {false, true}) {
                    const Surface surface = count % 16 == 0 ? Surface::cleared : Surface::uneven;
                    const Case given{random_triangles(811 + static_cast<std::uint64_t>(size), count, size, device),
                                     device.depth, region, by_shader_z, surface};
                    const SimdScope twins{Simd::scalar};
                    const std::vector<Pixel> expected = by_batches(given);
                    for (const Simd simd : available_simd()) {
                        const SimdScope kernels{simd};
                        if (simd < Simd::avx2) continue;
                        const Room room{given};
                        for (std::size_t p = 0; p < expected.size(); ++p)
                            wrong += room.coverage[p] == expected[p].fragments ? 0 : 1;
                        wrong += by_rows(given, room.ranks, room.places) == expected ? 0 : 1;
                        if (room.ranks > 0 && surface == Surface::cleared)
                            wrong += by_rows(given, room.ranks - 1, room.places).empty() ? 0 : 1;
                        if (room.places > row_padding) wrong += by_rows(given, room.ranks, 0).empty() ? 0 : 1;
                        ++compared;
                    }
                }
    CHECK((compared > 0 || chosen_simd() < Simd::avx2));
    CHECK(wrong == 0);
}

TEST_CASE("a triangle of one colour takes one place, however many fragments it has") {
    if (chosen_simd() < Simd::avx2) return;
    Geometry geometry = random_triangles(5, 40, 30, {{}, {DepthPath::float32, DepthFormat::d32f}});
    for (ClipVertex& v : geometry.vertices) v.front = v.back = {0.5f, 0.25f, 0.125f, 0.75f};
    const Case given{geometry, {DepthPath::float32, DepthFormat::d32f}, {0, 0, 70, 40}, false, Surface::cleared};
    const Room room{given};
    CHECK_FALSE(by_rows(given, room.ranks, static_cast<std::uint32_t>(geometry.triangles.size())).empty());
    CHECK(by_rows(given, room.ranks, static_cast<std::uint32_t>(geometry.triangles.size() / 2)).empty());
}
