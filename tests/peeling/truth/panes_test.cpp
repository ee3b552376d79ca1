// Tests chains on panes that cover the frame at constant depths and colours: for any set of exact links the result is
// that of a plain loop that composites from the far end in long double. Also tests lookups, corners and sides that
// random scenes do not reach, against formulas of sRGB and of reversed conventions.
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/truth/real_texture.h"
#include "peeling/truth/truth.h"
#include "rasterizer/base/input_error.h"
#include "tests/peeling/truth/chain_scene.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;
using strata::components;

struct Pane {
    float z = -2;  // in the world; the eye looks along -z
    strata::Rgba color{};
    AlphaMode mode = AlphaMode::blend;
    float cutoff = 0.5f;
};

// Far beyond the frame on every side, so no pixel is near a border.
Mesh square_at(float z, const strata::Rgba& color) {
    Mesh mesh;
    mesh.positions = {{-50, -50, z}, {50, -50, z}, {50, 50, z}, {-50, 50, z}};
    mesh.colors.assign(4, color);
    mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

DrawList list_of_panes(const std::vector<Pane>& panes) {
    DrawList list;
    for (const Pane& pane : panes) {
        const auto number = static_cast<std::uint32_t>(list.meshes.size());
        list.meshes.push_back(square_at(pane.z, pane.color));
        list.materials.push_back({.name = "pane",
                                  .alpha_mode = pane.mode,
                                  .alpha_cutoff = pane.cutoff,
                                  .double_sided = true,
                                  .unlit = true});
        list.instances.push_back({.mesh = number, .material = number});
    }
    return list;
}

using RealColor = std::array<long double, 3>;

// OVER from the far end; a mask below its cutoff is skipped, and every other opaque pane hides what is behind it.
RealColor composite(std::vector<Pane> panes, const strata::Rgba& background, std::optional<float> alpha) {
    std::sort(panes.begin(), panes.end(), [](const Pane& a, const Pane& b) { return a.z < b.z; });
    RealColor color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = components(background)[c];
    for (const Pane& pane : panes) {
        const auto parts = components(pane.color);
        if (pane.mode == AlphaMode::mask && parts[3] < pane.cutoff) continue;
        long double share = pane.mode == AlphaMode::blend || alpha ? parts[3] : 1;
        if (pane.mode == AlphaMode::opaque) share = 1;
        share *= alpha.value_or(1.0f);
        for (std::size_t c = 0; c < 3; ++c) color[c] = share * parts[c] + (1 - share) * color[c];
    }
    return color;
}

const std::vector<Pane> all_panes{
    {-2, {1, 0.25f, 0.5f, 0.5f}},      {-3, {0.25f, 1, 0.5f, 0.75f}, AlphaMode::mask, 0.8f},
    {-4, {0.5f, 0.25f, 1, 0.25f}},     {-5, {0.75f, 0.5f, 0.25f, 0.75f}, AlphaMode::mask, 0.5f},
    {-6, {0.125f, 0.25f, 0.5f, 0.5f}}, {-7, {0, 1, 0, 1}, AlphaMode::opaque}};

RenderOptions pane_options() {
    RenderOptions options;
    options.width = options.height = 8;
    options.threads = 1;
    options.background = {0.25f, 0.5f, 0.75f, 1};
    return options;
}

// The largest difference of any pixel from one colour.
double distance(const RealImage& image, const RealColor& expected) {
    double largest = 0;
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        largest = std::max(largest, std::fabs(image.rgb[i] - static_cast<double>(expected[i % 3])));
    return largest;
}

Chain chain_of(unsigned bits) {
    Chain chain = device_chain;
    for (std::size_t i = 0; i < links.size(); ++i) chain.*links[i].is_exact = (bits >> i & 1) != 0;
    return chain;
}

}  // namespace

TEST_CASE("every chain of links composites panes like a plain loop within the rounding of its formats", "[slow]") {
    std::vector<Pane> glass_alone;
    for (const Pane& pane : all_panes)
        if (pane.mode == AlphaMode::blend) glass_alone.push_back(pane);
    for (const auto& panes : {all_panes, glass_alone})
        for (const std::optional<float> alpha : {std::optional<float>{}, std::optional<float>{0.5f}})
            for (const char* profile : {"geforce3", "geforce8"}) {
                RenderOptions options = pane_options();
                options.alpha = alpha;
                const DrawList list = list_of_panes(panes);
                const RealColor expected = composite(panes, options.background, alpha);
                for (unsigned bits = 0; bits < 1u << links.size(); ++bits) {
                    const Chain chain = chain_of(bits);
                    const RealImage image = render_chain({list, chain_view, *find_profile(profile), options}, chain);
                    INFO(profile << ", links " << bits << (alpha ? ", all transparent" : ""));
                    // A layer rounds to half a code or a code of 1/255; binary32 colours to 2^-24.
                    const bool is_fine = chain.color && chain.blend && chain.store;
                    CHECK(distance(image, expected) < (is_fine ? 1e-6 : 7.0 / 255));
                }
            }
}

TEST_CASE("a mask whose alpha rises from left to right hides what is behind it only on the right in every chain") {
    // Alpha is 1/2 in the middle of the frame, where the cutoff is, and 0.0125 less or more in the columns next to it.
    DrawList list = list_of_panes({all_panes[0], all_panes[1], all_panes[5]});
    Mesh& mask = list.meshes[1];
    for (const std::size_t corner : {0u, 3u}) mask.colors[corner].a = 0.25f;
    for (const std::size_t corner : {1u, 2u}) mask.colors[corner].a = 0.75f;
    list.materials[1].alpha_cutoff = 0.5f;
    Pane seen = all_panes[1];
    seen.cutoff = 0;
    const RenderOptions options = pane_options();
    const RealColor left = composite({all_panes[0], all_panes[5]}, options.background, {});
    const RealColor right = composite({all_panes[0], seen, all_panes[5]}, options.background, {});
    for (unsigned bits = 0; bits < 1u << links.size(); ++bits) {
        const RealImage image = render_chain({list, chain_view, *find_profile("geforce8"), options}, chain_of(bits));
        double largest = 0;
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            const std::size_t column = i / 3 % 8;
            if (column == 3 || column == 4) continue;  // 8-bit alphas do not distinguish these from the cutoff
            const RealColor& expected = column < 4 ? left : right;
            largest = std::max(largest, std::fabs(image.rgb[i] - static_cast<double>(expected[i % 3])));
        }
        INFO("links " << bits);
        CHECK(largest < 4.0 / 255);
    }
}

TEST_CASE("planes at unsnapped corners equal those of snapped ones where the depth is constant") {
    DeviceProfile unsnapped = *find_profile("geforce8");
    unsnapped.raster.plane_origin = strata::rasterizer::PlaneOrigin::unsnapped;
    const DrawList list = list_of_panes(all_panes);
    const RenderOptions options = pane_options();
    Chain chain = exact_chain;
    chain.snap = false;
    CHECK(distance(render_chain({list, chain_view, unsnapped, options}, chain),
                   composite(all_panes, options.background, {})) < 1e-6);
}

TEST_CASE("the chain rejects every rule other than exact planes or snapped edges or a guard band") {
    const DrawList list = list_of_panes(all_panes);
    const RenderOptions options = pane_options();
    for (int rule = 0; rule < 3; ++rule) {
        DeviceProfile other = *find_profile("geforce8");
        if (rule == 0) other.raster.plane_rule = strata::rasterizer::PlaneRule::least_corner;
        if (rule == 1) other.raster.coverage = strata::rasterizer::CoverageRule::float_spans;
        if (rule == 2) other.raster.clip = strata::rasterizer::ClipVolume::view_volume;
        CHECK_THROWS_AS(render_chain({list, chain_view, other, options}, device_chain), strata::InputError);
        CHECK_NOTHROW(render_chain({list, chain_view, other, options}, exact_chain));
    }
}

TEST_CASE("the truth of a scene upside down or with Direct3D's clip space is the same picture") {
    const DrawList list = random_chain_list(61, {.transparent = 20, .opaque = 5, .has_texture = true});
    RenderOptions options = pane_options();
    options.width = 24;
    options.height = 20;
    const DeviceProfile& device = *find_profile("geforce8");
    const RealImage truth = render_chain({list, chain_view, device, options}, exact_chain);
    RenderOptions down = options;
    down.raster.y_direction = strata::rasterizer::YDirection::down;
    const RealImage turned = render_chain({list, chain_view, device, down}, exact_chain);
    View half_z = chain_view;  // z' = (z + w) / 2
    for (std::size_t c = 0; c < 4; ++c)
        half_z.projection[c][2] = (half_z.projection[c][2] + half_z.projection[c][3]) / 2;
    RenderOptions zero_to_one = options;
    zero_to_one.raster.clip_depth = strata::rasterizer::ClipDepth::zero_to_one;
    const RealImage direct3d = render_chain({list, half_z, device, zero_to_one}, exact_chain);
    double largest = 0;
    std::size_t differing = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int i = 0; i < 3 * truth.width; ++i) {
            const auto at = [&](const RealImage& image, int row) {
                return image.rgb[static_cast<std::size_t>(row * 3 * truth.width + i)];
            };
            differing += at(truth, y) != double{components(options.background)[static_cast<std::size_t>(i % 3)]};
            largest = std::max({largest, std::fabs(at(truth, y) - at(turned, truth.height - 1 - y)),
                                std::fabs(at(truth, y) - at(direct3d, y))});
        }
    CHECK(differing > 300);
    CHECK(largest < 1e-9);
}

TEST_CASE("the truth omits triangles that are culled or have no area or are not finite in any vertex format") {
    const std::vector<Pane> one_pane{{-2, {1, 0, 0, 0.5f}}};
    const strata::Rgba background = pane_options().background;
    for (const bool transform_is_exact : {false, true})
        for (const auto cull : {strata::rasterizer::CullFace::none, strata::rasterizer::CullFace::front,
                                strata::rasterizer::CullFace::back, strata::rasterizer::CullFace::front_and_back}) {
            using enum strata::rasterizer::CullFace;
            DrawList list = list_of_panes(one_pane);
            list.materials[0].double_sided = false;  // seen from its front
            const float nan = std::numeric_limits<float>::quiet_NaN();
            Mesh& mesh = list.meshes[0];
            const auto add = [&](const strata::Vec3& p) {
                mesh.positions.push_back(p);
                mesh.colors.push_back({0, 1, 0, 1});
                mesh.texcoords.push_back({0, 0});
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size() - 1));
            };
            for (const float x : {-1.0f, 1.0f, nan}) add({x, x, -1.5f});
            for (const float x : {-4.0f, 0.0f, 4.0f}) add({x, x, -1.5f});  // three corners on a line
            RenderOptions options = pane_options();
            options.raster.cull = cull;
            Chain chain = exact_chain;
            chain.transform = transform_is_exact;
            const bool is_seen = cull == none || cull == back;
            INFO("cull " << static_cast<int>(cull));
            CHECK(distance(render_chain({list, chain_view, *find_profile("geforce8"), options}, chain),
                           composite(is_seen ? one_pane : std::vector<Pane>{}, background, {})) < 1e-6);
        }
}

TEST_CASE("an exact lookup decodes sRGB in colours and not in alpha and counts a rectangle's texels by themselves") {
    Texture texture;
    texture.width = 2;
    texture.wrap_s = TextureWrap::repeat;
    texture.filter = TextureFilter::nearest;
    texture.texels = {188, 10, 255, 188, 0, 0, 0, 51};
    texture.decode_srgb = true;
    const auto decoded = [](double code) {
        const double c = code / 255;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    const auto texel = unquantized_sample(texture, 0.25, 0.5);
    CHECK(texel[0] == Approx(decoded(188)).epsilon(1e-6));
    CHECK(texel[1] == Approx(decoded(10)).epsilon(1e-6));
    CHECK(texel[2] == Approx(1).epsilon(1e-6));
    CHECK(texel[3] == 188 / 255.0);
    texture.decode_srgb = false;
    texture.target = TextureTarget::rectangle;
    texture.filter = TextureFilter::linear;
    CHECK(unquantized_sample(texture, 0.5, 0.5)[3] == 188 / 255.0);
    CHECK(unquantized_sample(texture, 1.0, 0.5)[3] == Approx((188 + 51) / 510.0));
    CHECK(unquantized_sample(texture, 9.0, 0.5)[3] == 51 / 255.0);  // clamped, though the wrap mode is repeat
}

TEST_CASE("a square of two triangles on a grid covers every centre once including those on its left and upper sides") {
    // Sides through pixel centres, vertical and horizontal, in either winding.
    const auto corner = [](int x, int y) { return RealCorner{.x = x + 0.5, .y = y + 0.5}; };
    for (const bool is_turned : {false, true}) {
        const std::array<RealCorner, 4> p{corner(1, 1), corner(5, 1), corner(5, 4), corner(1, 4)};
        const RealTriangle upper =
            is_turned ? RealTriangle{{p[2], p[1], p[0]}, 0, 0} : RealTriangle{{p[0], p[1], p[2]}, 0, 0};
        const RealTriangle lower =
            is_turned ? RealTriangle{{p[3], p[2], p[0]}, 1, 0} : RealTriangle{{p[0], p[2], p[3]}, 1, 0};
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 7; ++x) {
                const int expected = x >= 1 && x < 5 && y >= 1 && y < 4 ? 1 : 0;
                INFO(x << ", " << y);
                CHECK(int{upper.weights(x, y).is_inside} + int{lower.weights(x, y).is_inside} == expected);
            }
    }
    CHECK(RealTriangle{{corner(1, 1), corner(1, 3), corner(1, 5)}, 0, 0}.winding() == 0);
}
