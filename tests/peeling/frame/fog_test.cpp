// Tests fog in peels against a model in binary64: squares at constant distances, each mixed with the fog by its own
// distance and then composited back to front.
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

constexpr int side = 32;
constexpr Rgba fog_color{0.25f, 0.5f, 0.75f, 1};

struct Square {
    double distance;
    Rgba color;
};

// The last square is opaque and in the middle alone; the others cover the window, in any order.
const std::vector<Square> squares{
    {3, {1, 0.5f, 0, 0.5f}}, {1, {0, 1, 0.25f, 0.25f}}, {2, {0.5f, 0, 1, 0.75f}}, {4, {1, 1, 0, 1}}};
constexpr double middle = 0.5;

// The eye looks along -z and sees x and y from -1 to 1, distances from 0 to 8.
const View along_z{.view = identity, .projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.25, 0, 0, 0, -1, 1}};

DrawList foggy_list() {
    DrawList list;
    for (const Square& square : squares) {
        const bool is_opaque = square.color[3] == 1;
        const auto s = static_cast<float>(is_opaque ? middle : 1.0), z = static_cast<float>(2 - square.distance);
        const auto number = static_cast<std::uint32_t>(list.meshes.size());
        Mesh mesh;
        mesh.positions = {{-s, -s, z}, {s, -s, z}, {s, s, z}, {-s, s, z}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        list.meshes.push_back(mesh);
        list.materials.push_back({.name = "square",
                                  .front = square.color,
                                  .back = square.color,
                                  .alpha_mode = is_opaque ? AlphaMode::opaque : AlphaMode::blend,
                                  .double_sided = true,
                                  .unlit = true});
        // The model moves it by 2 along -z.
        list.instances.push_back(
            {.mesh = number, .material = number, .model = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2, 1}});
    }
    return list;
}

double factor(const Fog& fog, double c) {
    switch (fog.mode) {
        case FogMode::linear: return std::clamp((fog.end - c) / (double{fog.end} - fog.start), 0.0, 1.0);
        case FogMode::exp: return std::exp(-fog.density * c);
        case FogMode::exp2: break;
    }
    return std::exp(-std::pow(fog.density * c, 2.0));
}

// Back to front over black.
std::array<double, 3> composited(const Fog& fog, bool in_middle) {
    std::vector<Square> order;
    for (const Square& square : squares)
        if (square.color[3] < 1 || in_middle) order.push_back(square);
    std::ranges::sort(order, std::ranges::greater{}, &Square::distance);
    std::array<double, 3> sum{};
    for (const Square& square : order) {
        const double f = factor(fog, square.distance), alpha = square.color[3];
        for (int c = 0; c < 3; ++c) {
            const auto k = static_cast<std::size_t>(c);
            sum[k] = alpha * (f * square.color[c] + (1 - f) * fog_color[c]) + (1 - alpha) * sum[k];
        }
    }
    return sum;
}

RenderOptions foggy(const std::optional<Fog>& fog) {
    RenderOptions options;
    options.width = options.height = side;
    options.threads = 1;
    options.tile_size = 8;
    options.fog = fog;
    return options;
}

const std::vector<Fog> fogs{{.mode = FogMode::linear, .start = 0.5f, .end = 6, .density = 1, .color = fog_color},
                            {.mode = FogMode::exp, .start = 0, .end = 1, .density = 0.25f, .color = fog_color},
                            {.mode = FogMode::exp2, .start = 0, .end = 1, .density = 0.25f, .color = fog_color}};

}  // namespace

TEST_CASE("a peel composites fogged colours, each by its own distance") {
    struct Case {
        const char *profile, *algorithm;
        double tolerance;
    };
    constexpr Case cases[]{{"ideal", "front_to_back", 1e-6},       {"ideal", "dual", 1e-6},
                           {"ideal", "linked_list", 1e-6},         {"geforce8", "dual", 3.0 / 255},
                           {"geforce3", "depth_units", 5.0 / 255}, {"direct3d11", "dual", 3.0 / 255}};
    for (const auto& [profile, algorithm, tolerance] : cases)
        for (const Fog& fog : fogs) {
            const RenderResult result = render(foggy_list(), along_z, {profile, algorithm}, foggy(fog));
            INFO(profile << ' ' << algorithm << " mode " << static_cast<int>(fog.mode));
            REQUIRE(result.outcome == strata::peeling::Outcome::done);
            CHECK(result.audit.order_errors == 0u);
            double worst = 0;
            for (const int at : {2, side / 2})
                for (int c = 0; c < 3; ++c)
                    worst = std::max(worst, std::abs(value_in(result.frame.color, at, at, c) -
                                                     composited(fog, at == side / 2)[static_cast<std::size_t>(c)]));
            CHECK(worst <= tolerance);
        }
}

TEST_CASE("a fogged frame has the same bits in every execution, with every effect, on one thread or two") {
    constexpr std::pair<const char*, const char*> cases[]{
        {"geforce3", "unsorted"},        {"geforce8", "dual"},     {"geforce8", "weighted_average"},
        {"ideal", "unsorted"},           {"ideal", "dual"},        {"ideal", "weighted_blended"},
        {"ideal", "weighted_average"},   {"llvmpipe", "unsorted"}, {"llvmpipe", "dual"},
        {"llvmpipe", "weighted_blended"}};
    for (const auto& [profile, algorithm] : cases) {
        INFO(profile << ' ' << algorithm);
        CHECK(is_alike_in_every_way(foggy_list(), along_z, {profile, algorithm}, foggy(fogs[1])));
    }
}

TEST_CASE("fog is recorded in the colours, so that passes look at as many fragments as without it") {
    for (const char* algorithm : {"front_to_back", "dual", "depth_units"}) {
        const auto visited = [&](const std::optional<Fog>& fog) {
            return render(foggy_list(), along_z, {"geforce8", algorithm}, foggy(fog)).frame.work;
        };
        const auto plain = visited(std::nullopt), fogged = visited(fogs[0]);
        INFO(algorithm);
        CHECK(plain.fragments > 0);
        CHECK(fogged.visited == plain.visited);
        CHECK(fogged.fragments == plain.fragments);
    }
}

TEST_CASE("fog of density 0 changes no bit, and a dense one hides every surface but not the background") {
    for (const char* profile : {"geforce3", "geforce8", "ideal"}) {
        const auto drawn = [&](const std::optional<Fog>& fog) {
            return render(foggy_list(), along_z, {profile, "unsorted"}, foggy(fog)).frame.color;
        };
        const Image plain = drawn(std::nullopt);
        const Image clear = drawn(Fog{.mode = FogMode::exp, .start = 0, .end = 1, .density = 0, .color = fog_color});
        const Image dense =
            drawn(Fog{.mode = FogMode::exp2, .start = 0, .end = 1, .density = 60, .color = {0, 0, 0, 1}});
        INFO(profile);
        CHECK(clear.codes == plain.codes);
        double greatest = 0;
        for (int c = 0; c < 3; ++c) greatest = std::max(greatest, value_in(dense, side / 2, side / 2, c));
        CHECK(greatest == 0);
        CHECK(value_in(plain, side / 2, side / 2, 0) > 0.1);
    }
}

TEST_CASE("fog without a valid distance, density or colour is refused before anything is drawn") {
    const auto message = [](const Fog& fog) {
        try {
            static_cast<void>(render(foggy_list(), along_z, {"geforce8", "dual"}, foggy(fog)));
        } catch (const strata::InputError& e) {
            return std::string{e.what()};
        }
        return std::string{};
    };
    CHECK(message({.mode = FogMode::linear, .start = 1, .end = 1, .density = 1, .color = {}}) ==
          "render options: fog.end: expected another distance than start, found 1.000000");
    CHECK(message({.mode = FogMode::linear, .start = -INFINITY, .end = 1, .density = 1, .color = {}}) ==
          "render options: fog.start: expected a finite distance, found -inf");
    CHECK(message({.mode = FogMode::exp, .start = 0, .end = 1, .density = -1, .color = {}}) ==
          "render options: fog.density: expected a finite number of at least 0, found -1.000000");
    CHECK(message({.mode = FogMode::exp, .start = 0, .end = 1, .density = 1, .color = {2, 0, 0, 1}}) ==
          "render options: fog.color: expected a number from 0 to 1, found 2.000000");
}
