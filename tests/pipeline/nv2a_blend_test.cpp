// Pictures of real silicon: the suite Blend_tests of nxdk_pgraph_tests, captured on an NV2A (a GeForce3-class core) and
// published under CC0 (abaire/nxdk_pgraph_tests_golden_results). The scene is that of nv2a-fragment.md section 1; a
// digest below is that of the captured picture's rows 96 to 479 (above stand labels), as an rgba8 image. SADD and
// SREVSUB are no OpenGL equations.
#include <catch2/catch.hpp>
#include <map>

#include "blend_model.h"
#include "pipeline/image.h"
#include "rasterizer/raster_state.h"

using namespace strata::pipeline;

namespace {

constexpr int window_width = 640, window_height = 480, first_row = 96;

struct Picture {
    std::string_view name, digest;
};

// <source factor>_<equation>_<destination factor>; #spot: all destination factors in one picture.
constexpr Picture captured[] = {
    {"#spot_0_REVSUB", "c0db5c20b3a0b38cd7005e0616aa08f7"},
    {"#spot_1-dstA_ADD", "e524b66623296e6ccee014349b3543ad"},
    {"#spot_1-dstRGB_SUB", "bab5e022981dd01a5f01cbb9ac0838b1"},
    {"#spot_1-srcRGB_REVSUB", "6767ade3f331f518364ddbe67138441d"},
    {"#spot_1_MIN", "f1619c3a198c50ca6da268811cfd43db"},
    {"#spot_cRGB_SUB", "6ff7d7754c4c683ca4b04dd8a1e4ca6d"},
    {"#spot_dstA_REVSUB", "7a1c3bcb191d2a89759a96cee36972aa"},
    {"#spot_srcA_ADD", "4b4cbf0a7cf3a246a19dc244e5e1c5d2"},
    {"#spot_srcA_MAX", "f472ad12d7c56323ec0d34a9c2e988bf"},
    {"#spot_srcAsat_ADD", "18387d70796c77dcff0d48ddb1fe564d"},
    {"0_ADD_srcA", "a7ae2fdeb52ba0307d2901f4c25675ad"},
    {"1-cRGB_SUB_srcRGB", "fe843f911270e61e57ab8f3663dd98c4"},
    {"1-dstA_ADD_1", "06d805f6a2bd00c5134d3da4a8e49988"},
    {"1-dstA_MAX_cRGB", "293350d3a77d54d5e989ceca80f30fb5"},
    {"1-dstRGB_ADD_srcRGB", "7ae7a2656d3e9e8a2144471ebf48a3f5"},
    {"1-srcA_REVSUB_srcRGB", "c2bcbc44b7f84087299e0703c6af8329"},
    {"1-srcA_SUB_dstA", "89d5ec5d146bd0ccdd53e7f1c0a35bbf"},
    {"1_ADD_1", "aa881d7577a508c8fe747f542170ddcf"},
    {"1_ADD_1-srcA", "4408f1463dffcb2c03a62e030c1585e6"},
    {"1_MAX_1", "293350d3a77d54d5e989ceca80f30fb5"},
    {"1_MIN_1", "9819d1b9ab6534d73d94ad167b9dc6e3"},
    {"1_REVSUB_1", "56aad7191ffe52bdb71cba9ef76065f2"},
    {"1_SUB_1", "cec15a4ab671cbf2e0f2a3b6842e2319"},
    {"cA_ADD_1-cA", "1c63d3cb67b8ba1b19bf2274a6a05279"},
    {"cRGB_ADD_1-cRGB", "1c63d3cb67b8ba1b19bf2274a6a05279"},
    {"cRGB_REVSUB_1-dstRGB", "8e29e47cc409ef118b2e5ac699ecc380"},
    {"dstA_ADD_0", "94cbd7f290603a099e1e4f3ccfc452e2"},
    {"dstA_ADD_1", "c65738c1f04804f2f57b20e32cbfdd68"},
    {"dstA_MIN_1-cA", "9819d1b9ab6534d73d94ad167b9dc6e3"},
    {"dstRGB_SUB_srcAsat", "8cac8ad4b0e2ae2bd94c9c62b081389f"},
    {"srcA_ADD_1-srcA", "1f8cb7ee987067aeecfe572d5117748f"},
    {"srcA_MIN_0", "9819d1b9ab6534d73d94ad167b9dc6e3"},
    {"srcA_SUB_cA", "03a67f02ba4684fc7d93906ad7f978ab"},
    {"srcAsat_ADD_1", "d33b718ff818b854647b827c4f676ffb"},
    {"srcAsat_REVSUB_dstA", "ce597fcaa46214c8f5cb91a03f3aaa15"},
    {"srcRGB_ADD_dstRGB", "f2cc9b931d353c94fedfca79c4744134"},
    {"srcRGB_MAX_0", "293350d3a77d54d5e989ceca80f30fb5"},
};

const std::vector<std::pair<std::string_view, BlendFactor>> factors{{"0", BlendFactor::zero},
                                                                    {"1", BlendFactor::one},
                                                                    {"srcRGB", BlendFactor::src_color},
                                                                    {"1-srcRGB", BlendFactor::one_minus_src_color},
                                                                    {"srcA", BlendFactor::src_alpha},
                                                                    {"1-srcA", BlendFactor::one_minus_src_alpha},
                                                                    {"dstA", BlendFactor::dst_alpha},
                                                                    {"1-dstA", BlendFactor::one_minus_dst_alpha},
                                                                    {"dstRGB", BlendFactor::dst_color},
                                                                    {"1-dstRGB", BlendFactor::one_minus_dst_color},
                                                                    {"srcAsat", BlendFactor::src_alpha_saturate},
                                                                    {"cRGB", BlendFactor::constant_color},
                                                                    {"1-cRGB", BlendFactor::one_minus_constant_color},
                                                                    {"cA", BlendFactor::constant_alpha},
                                                                    {"1-cA", BlendFactor::one_minus_constant_alpha}};

const std::map<std::string_view, BlendEquation> equations{{"ADD", BlendEquation::add},
                                                          {"SUB", BlendEquation::subtract},
                                                          {"REVSUB", BlendEquation::reverse_subtract},
                                                          {"MIN", BlendEquation::min},
                                                          {"MAX", BlendEquation::max}};

BlendFactor factor_of(std::string_view name) {
    for (const auto& [known, factor] : factors)
        if (known == name) return factor;
    FAIL("no factor " << name);
    return {};
}

using Argb = std::uint32_t;

// Channel c (r g b a) of a word AARRGGBB.
std::uint32_t channel(Argb word, std::size_t c) { return word >> (c == 3 ? 24 : 16 - 8 * c) & 0xff; }

// Blends color(x, y) into the rectangle, row by row through the stage.
template <class Color>
void draw(Image& target, const strata::rasterizer::Rect& where, const Blend& state, Color&& color) {
    static Colors source;
    static Codes codes;
    const strata::rasterizer::Rect seen = intersection(where, {0, 0, target.width, target.height});
    for (int y = seen.y0; y < seen.y1; ++y)
        for (int x0 = seen.x0; x0 < seen.x1; x0 += 256) {
            const int count = std::min(256, seen.x1 - x0);
            for (int i = 0; i < count; ++i)
                for (std::size_t c = 0; c < 4; ++c) {
                    source[c][static_cast<std::size_t>(i)] = static_cast<float>(channel(color(x0 + i, y), c)) / 255.0f;
                    codes[c][static_cast<std::size_t>(i)] = target.codes[target.index(x0 + i, y, static_cast<int>(c))];
                }
            blend(state, ChannelType::unorm8, *find_profile("geforce3"), 4, source, codes, count);
            for (int i = 0; i < count; ++i)
                for (std::size_t c = 0; c < 4; ++c)
                    target.codes[target.index(x0 + i, y, static_cast<int>(c))] = codes[c][static_cast<std::size_t>(i)];
        }
}

struct Square {
    int x, y, side;
};

void draw(Image& target, const Square& s, Argb color, Blend state, std::uint8_t write_mask) {
    state.write_mask = write_mask;
    draw(target, {s.x, s.y, s.x + s.side, s.y + s.side}, state, [&](int, int) { return color; });
}

// Cells of a checkerboard; the first is `even`.
Image checker(int width, int height, int cell, Argb even, Argb odd) {
    Image image{Format::rgba8, width, height};
    draw(image, {0, 0, width, height}, blend_mode::replace,
         [&](int x, int y) { return (x / cell + y / cell) % 2 == 0 ? even : odd; });
    return image;
}

constexpr std::uint8_t colors = 7, alpha = 8, everything = 15;

// Nested squares: colours replaced, then alpha blended, which sees the colours just written.
void alpha_stack(Image& target, const Square& at, int inset, const Blend& state) {
    Square s = at;
    for (const Argb color : {0x7F00CC00u, 0xFFCC0000u, 0x800000FFu, 0x00FFFFFFu}) {
        draw(target, s, color, blend_mode::replace, colors);
        draw(target, s, color, state, alpha);
        s = {s.x + inset, s.y + inset, s.side - 2 * inset};
    }
}

// Squares downwards: colours blended, then alpha replaced.
void color_stack(Image& target, Square s, const Blend& state) {
    for (const Argb color : {0xDD00DD00u, 0xDDDD0000u, 0xDD0000DDu, 0xDDFFFFFFu}) {
        draw(target, s, color, state, colors);
        draw(target, s, color, blend_mode::replace, alpha);
        s.y += s.side;
    }
}

void full_stack(Image& target, Square s, const Blend& state) {
    for (const Argb color : {0xDDFFFFFFu, 0xDD0000DDu, 0xDDDD0000u, 0xDD00DD00u}) {
        draw(target, s, color, state, everything);
        s.y += s.side;
    }
}

Blend tested(BlendEquation equation, BlendFactor source, BlendFactor destination) {
    const BlendTerm term{equation, source, destination};
    constexpr float constant = 0x55 / 255.0f;
    return {true, term, term, {constant, constant, constant, constant}, everything};
}

// A texture of 256 x 256 texels, nearest, over the whole window.
Image background(int cell) {
    Image window{Format::rgba8, window_width, window_height};
    draw(window, {0, 0, window_width, window_height}, blend_mode::replace, [&](int x, int y) {
        const int column = (2 * x + 1) * 256 / (2 * window_width), row = (2 * y + 1) * 256 / (2 * window_height);
        return (column / cell + row / cell) % 2 == 0 ? 0xFF202020u : 0xFF000000u;
    });
    return window;
}

void place(Image& window, const Image& target, int x0, int y0) {
    draw(window, {x0, y0, x0 + target.width, y0 + target.height}, blend_mode::over, [&](int x, int y) {
        Argb word = 0;
        for (std::size_t c = 0; c < 4; ++c)
            word |= target.codes[target.index(x - x0, y - y0, static_cast<int>(c))] << (c == 3 ? 24 : 16 - 8 * c);
        return word;
    });
}

constexpr Argb pale = 0x33333333, black = 0xFF000000;

Image spot_picture(BlendEquation equation, BlendFactor source) {
    Image target = checker(512, 512, 8, pale, black);
    for (int i = 0; i < 15; ++i) {
        const Blend state = tested(equation, source, factors[static_cast<std::size_t>(i)].second);
        const int x = 103 * (i % 5), y = 136 * (i / 5);
        color_stack(target, {x, y, 24}, state);
        full_stack(target, {x + 24, y, 24}, state);
        alpha_stack(target, {x + 48, y, 51}, 4, state);
    }
    Image window = background(16);
    place(window, target, 64, 64);
    return window;
}

Image detailed_picture(const Blend& state) {
    Image large = checker(256, 256, 16, pale, black), left = checker(64, 256, 16, pale, black), right = left;
    alpha_stack(large, {0, 0, 256}, 24, state);
    color_stack(left, {0, 0, 64}, state);
    full_stack(right, {0, 0, 64}, state);
    Image window = background(24);
    place(window, large, 192, 112);
    place(window, left, 16, 112);
    place(window, right, 560, 112);
    return window;
}

Image picture(std::string_view name) {
    const bool is_spot = name.starts_with("#spot_");
    if (is_spot) name.remove_prefix(6);
    const std::size_t first = name.find('_'), second = name.find('_', first + 1);
    const BlendFactor source = factor_of(name.substr(0, first));
    const BlendEquation equation = equations.at(name.substr(first + 1, second - first - 1));
    return is_spot ? spot_picture(equation, source)
                   : detailed_picture(tested(equation, source, factor_of(name.substr(second + 1))));
}

Image without_labels(const Image& window) {
    Image rest{Format::rgba8, window_width, window_height - first_row};
    std::copy(window.codes.begin() + static_cast<std::ptrdiff_t>(window.index(0, first_row)), window.codes.end(),
              rest.codes.begin());
    return rest;
}

}  // namespace

TEST_CASE("blending on geforce3 gives the pictures that an NV2A gave, bit for bit") {
    std::string different;
    for (const Picture& p : captured)
        if (digest(without_labels(picture(p.name))) != p.digest) different += std::string{p.name} + " ";
    CHECK(different.empty());
    CHECK(std::size(captured) == 37);
}
