// Tests which device runs which algorithm, against the table of pipeline/reference/devices.md 10, and the message of
// every rejection.
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "tests/peeling/expectations.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Outcome;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

FragmentScene one_fragment() {
    FragmentScene scene{4, 4};
    scene.pixels[5] = {{{0.25f, {1, 0, 0, 0.5f}}}, GivenFragment{0.5f, {0, 1, 0, 1}}};
    return scene;
}

// The message of a rejected run; empty if it ran.
std::string refusal_message(const Machine& machine, const RenderOptions& options) {
    const RenderResult result = render(one_fragment(), machine, options);
    CHECK((result.outcome == Outcome::refused) == result.refusal.has_value());
    if (!result.refusal) return "";
    CHECK(result.frame.color.codes.empty());  // no partial result
    return result.refusal->message(*find_profile(machine.profile));
}

std::string refusal_message(const Machine& machine) { return refusal_message(machine, options_for(one_fragment())); }

const std::string no_float =
    "profile geforce3 has no float render targets that blend (ARB_color_buffer_float); "
    "use geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11";
const std::string no_programs =
    "profile geforce3 has no fragment programs that discard after a compare (ARB_fragment_program); "
    "use geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11";

}  // namespace

TEST_CASE("packed colours are refused without blended float targets and without an alpha where layers are stored") {
    RenderOptions options = options_for(one_fragment());
    for (const auto& [format, name] :
         {std::pair{Format::srgb8_alpha8, "srgb8_alpha8"}, std::pair{Format::rgb10_a2, "rgb10_a2"}}) {
        options.color_format = format;
        CHECK(refusal_message({"geforce3", "depth_units"}, options) ==
              std::string{"profile geforce3 has no blended colour format "} + name +
                  "; use geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11");
        CHECK(refusal_message({"geforce8_dx101", "dual"}, options).empty());
    }
    options.color_format = Format::r11g11b10f;
    CHECK(refusal_message({"geforce3", "unsorted"}, options) == no_float);
    CHECK(refusal_message({"geforce8_dx101", "dual"}, options) ==
          "algorithm dual has no layers in r11g11b10f, which has no alpha; use --result-format r11g11b10f, or painter, "
          "which blends into the picture");
    CHECK(refusal_message({"geforce8_dx101", "painter"}, options).empty());
    options.color_format.reset();
    options.result_format = Format::r11g11b10f;
    for (const auto& algorithm : strata::peeling::algorithms())
        if (refusal_message({"geforce8_dx101", algorithm.name}).empty())
            CHECK(refusal_message({"geforce8_dx101", algorithm.name}, options).empty());
}

TEST_CASE("the table of algorithms and profiles is that of devices.md 10") {
    for (const DeviceProfile& profile : builtin_profiles())
        for (const auto& algorithm : strata::peeling::algorithms()) {
            const bool expected = expected_of(algorithm.name).runs_on(profile.name);
            INFO(algorithm.name << " on " << profile.name);
            CHECK(refusal_message({profile.name, algorithm.name}).empty() == expected);
        }
}

TEST_CASE("a rejected algorithm names the first missing feature with its extension and the devices that have it") {
    CHECK(refusal_message({"geforce3", "front_to_back"}) == no_programs);
    CHECK(refusal_message({"geforce3", "dual"}) == no_float);
    CHECK(refusal_message({"geforce3", "weighted_average"}) == no_float);
    CHECK(refusal_message({"geforce3", "weighted_sum"}) == no_float);
    for (const std::string profile : {"geforce3", "geforce8"})
        CHECK(refusal_message({profile, "dual_independent"}) ==
              "profile " + profile +
                  " has no independent blend equations (ARB_draw_buffers_blend); use geforce8_dx101, ideal, llvmpipe, "
                  "llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(refusal_message({"geforce3", "coherent_stencil"}) == no_programs);
    CHECK(refusal_message({"geforce8", "coherent_ideal"}) ==
          "profile geforce8 has no ordered read-modify-write of render targets (STRATA_ordered_rmw); use ideal or "
          "direct3d11");
    CHECK(refusal_message({"llvmpipe", "stencil_routed_k_buffer"}) ==
          "profile llvmpipe has no 8 samples per pixel (ARB_multisample); use geforce8, geforce8_dx101, ideal or "
          "direct3d11");
}

TEST_CASE("depth replace is rejected by its extension where there are no texture shaders") {
    for (const std::string profile : {"geforce8", "geforce8_dx101", "llvmpipe"})
        CHECK(refusal_message({profile, "shadow_map_depth_replace"}) ==
              "profile " + profile +
                  " has no depth replace by texture shaders (NV_texture_shader); use geforce3 or ideal");
}

TEST_CASE("depth formats that a device lacks are rejected for every algorithm") {
    const auto with_depth = [](const Machine& machine, DepthFormat format) {
        RenderOptions options = options_for(one_fragment());
        options.depth = format;
        return refusal_message(machine, options);
    };
    const std::string d16 =
        " has no 16-bit depth buffers; use geforce3, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or "
        "direct3d11";
    for (const std::string profile : {"geforce8", "geforce8_dx101"})
        for (const char* algorithm : {"unsorted", "front_to_back", "dual", "a_buffer"}) {
            CHECK(with_depth({profile, algorithm}, DepthFormat::d16) == "profile " + profile + d16);
            CHECK(with_depth({profile, algorithm}, DepthFormat::d24).empty());
            CHECK(with_depth({profile, algorithm}, DepthFormat::d32f).empty());
        }
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        CHECK(with_depth({"geforce3", "depth_units"}, format).empty());
        CHECK(with_depth({"ideal", "dual"}, format).empty());
    }
    CHECK(with_depth({"geforce3", "unsorted"}, DepthFormat::d32f) ==
          "profile geforce3 has no float depth buffers (ARB_depth_buffer_float); use geforce8, geforce8_dx101, ideal, "
          "llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11");
}

TEST_CASE("float colour on geforce3 is rejected") {
    RenderOptions options = options_for(one_fragment());
    for (const Format format : {Format::rgba16f, Format::rgba32f}) {
        options.color_format = format;
        CHECK(refusal_message({"geforce3", "unsorted"}, options) == no_float);
        CHECK(refusal_message({"geforce8", "unsorted"}, options).empty());
    }
}

TEST_CASE("a depth pass is rejected for a colour format like any algorithm with and without opaque surfaces") {
    const strata::peeling::Algorithm& unsorted = *strata::peeling::find_algorithm("unsorted");
    for (const bool has_opaque : {false, true}) {
        FragmentScene scene = one_fragment();
        if (has_opaque) scene.pixels[0].opaque = GivenFragment{.depth = 0.75f};
        RenderOptions options = options_for(scene);
        options.color_format = Format::rgba16f;
        const auto list = draw_list(scene);
        strata::peeling::Renderer renderer{list, {}, *strata::pipeline::find_profile("geforce3"), options};
        const auto found = renderer.depth_pass();
        CHECK(found.outcome == strata::peeling::Outcome::refused);
        CHECK(found.refusal == renderer.render(unsorted).refusal);
    }
}

TEST_CASE("a depth pass is rejected for a depth format and a size like any algorithm") {
    const FragmentScene scene = one_fragment();
    const auto list = draw_list(scene);
    const auto refusals_of = [&](const char* profile, const RenderOptions& options) {
        strata::peeling::Renderer renderer{list, {}, *strata::pipeline::find_profile(profile), options};
        const auto found = renderer.depth_pass();
        CHECK(found.refusal == renderer.render(*strata::peeling::find_algorithm("unsorted")).refusal);
        return found.refusal.has_value();
    };
    RenderOptions options = options_for(scene);
    CHECK_FALSE(refusals_of("geforce3", options));
    options.depth = DepthFormat::d32f;
    CHECK(refusals_of("geforce3", options));
    CHECK_FALSE(refusals_of("geforce8", options));
    options.depth.reset();
    options.width = 16384;
    CHECK(refusals_of("geforce8", options));
}

TEST_CASE("depth paths run on their own machines and are rejected by name on others") {
    using strata::rasterizer::DepthPath;
    const auto with_path = [](const Machine& machine, DepthPath path) {
        RenderOptions options = options_for(one_fragment());
        options.depth_path = path;
        return refusal_message(machine, options);
    };
    for (const char* profile : {"geforce3", "geforce8", "ideal"})
        for (const DepthPath path : {DepthPath::float32, DepthPath::exact})
            CHECK(with_path({profile, "depth_units"}, path).empty());
    CHECK(with_path({"geforce3", "depth_units"}, DepthPath::window_z).empty());
    for (const std::string profile : {"geforce8", "ideal"})
        CHECK(with_path({profile, "depth_units"}, DepthPath::window_z) ==
              "profile " + profile +
                  " has no GeForce3's depth interpolator window_z; use --profile geforce3 with --depth-format d16 or "
                  "d24");
    for (const char* profile : {"geforce3", "ideal"})
        CHECK(with_path({profile, "depth_units"}, DepthPath::depth_replace).empty());
    for (const char* profile : {"geforce8", "ideal"})
        CHECK(with_path({profile, "depth_units"}, DepthPath::perspective_rq).empty());
    CHECK(with_path({"geforce8", "depth_units"}, DepthPath::depth_replace) ==
          "profile geforce8 has no depth replace by texture shaders (NV_texture_shader); use geforce3 or ideal");
    CHECK(with_path({"geforce3", "depth_units"}, DepthPath::float32_plane).empty());
}

TEST_CASE("a viewport beyond the device's limit is rejected before memory of its size is allocated") {
    const auto with_size = [](const Machine& machine, int width, int height) {
        RenderOptions options = options_for(one_fragment());
        options.width = width;
        options.height = height;
        options.audit = options.nearest_depth = false;
        return refusal_message(machine, options);
    };
    CHECK(with_size({"geforce3", "unsorted"}, 4096, 1).empty());
    CHECK(with_size({"geforce3", "unsorted"}, 4097, 1) ==
          "profile geforce3 has no viewport of 4097 x 1 pixels; use geforce8, geforce8_dx101, ideal, llvmpipe, "
          "llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(with_size({"geforce8", "dual"}, 1, 8192).empty());
    CHECK(with_size({"geforce8", "dual"}, 3, 8193) ==
          "profile geforce8 has no viewport of 3 x 8193 pixels; use ideal, llvmpipe, llvmpipe_sse, softpipe or "
          "direct3d11");
    CHECK(with_size({"ideal", "unsorted"}, 16384, 1).empty());
}

TEST_CASE("layers of an algorithm that composites immediately are rejected") {
    RenderOptions options = options_for(one_fragment());
    options.keep_layers = true;
    CHECK(refusal_message({"geforce8", "weighted_average"}, options) ==
          "algorithm weighted_average has no saved layers; use dual or front_to_back");
    CHECK(refusal_message({"geforce8", "dual"}, options).empty());
    CHECK(refusal_message({"geforce8", "front_to_back"}, options).empty());
    CHECK(refusal_message({"geforce3", "depth_units"}, options).empty());
}

TEST_CASE("a reversed depth range is rejected by name and depth clamping where the device has none") {
    RenderOptions options = options_for(one_fragment());
    options.raster.depth_clamp = true;
    CHECK(refusal_message({"geforce8", "dual"}, options).empty());
    DeviceProfile without = *find_profile("geforce8");
    without.has_depth_clamp = false;
    const DrawList list = draw_list(one_fragment());
    strata::peeling::Renderer renderer{list, {}, without, options};
    CHECK(renderer.render(*strata::peeling::find_algorithm("dual")).refusal->extension == "ARB_depth_clamp");
    options.raster.depth_near = 1;
    options.raster.depth_far = 0;
    for (const auto& algorithm : strata::peeling::algorithms())
        CHECK(refusal_message({"ideal", algorithm.name}, options) ==
              "profile ideal has no peeling with LESS over a reversed depth range; use a depth range with near below "
              "far, or --depth-order greater beside this one");
}

TEST_CASE("fragments of a rejected run are rejected with the same message") {
    const DrawList list = draw_list(one_fragment());
    strata::peeling::Renderer renderer{list, {}, *find_profile("geforce3"), options_for(one_fragment())};
    CHECK(renderer.fragments(*strata::peeling::find_algorithm("unsorted")).all.size() == 1);
    CHECK_THROWS_WITH(renderer.fragments(*strata::peeling::find_algorithm("dual")), no_float);
}

TEST_CASE("invalid options are input errors with the field and the expected and found values") {
    const auto message = [](auto change) -> std::string {
        RenderOptions options = options_for(one_fragment());
        change(options);
        try {
            static_cast<void>(render(one_fragment(), {"geforce8", "dual"}, options));
        } catch (const strata::InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message([](RenderOptions& o) { o.width = 0; }) == "render options: width: expected 1 to 16384, found 0");
    CHECK(message([](RenderOptions& o) { o.height = 16385; }) ==
          "render options: height: expected 1 to 16384, found 16385");
    CHECK(message([](RenderOptions& o) { o.tile_size = 24; }) ==
          "render options: tile_size: expected 8, 16, 32, 64 or 128, found 24");
    CHECK(message([](RenderOptions& o) { o.threads = -1; }) == "render options: threads: expected 0 to 1024, found -1");
    CHECK(message([](RenderOptions& o) { o.max_passes = -1; }) ==
          "render options: max_passes: expected 0 to 1000000, found -1");
    CHECK(message([](RenderOptions& o) { o.termination = {.rule = TerminationRule::fixed}; }) ==
          "render options: termination.passes: expected 1 to 1000000, found 0");  // it would never end
    CHECK(message([](RenderOptions& o) { o.termination = {.rule = TerminationRule::ratio, .ratio = -0.5}; }) ==
          "render options: termination.ratio: expected a number of at least 0, found -0.500000");
    CHECK(message([](RenderOptions& o) {
              o.termination = {.ratio = -0.5};  // not used by the default rule
          }).find("termination") == std::string::npos);
    CHECK(message([](RenderOptions& o) { o.alpha = std::nanf(""); }) ==
          "render options: alpha: expected a finite number, found nan");
    for (const double absolute : {1.5, -0.5})
        CHECK(message([&](RenderOptions& o) {
                  o.compare_epsilon.absolute = absolute;
              }).starts_with("render options: compare_epsilon.absolute: expected a number from 0 to 1, found "));
    for (const double absolute : {0.0, 1.0})
        CHECK(message([&](RenderOptions& o) {
                  o.compare_epsilon.absolute = absolute;
              }).find("compare_epsilon.absolute: expected") == std::string::npos);
    CHECK(message([](RenderOptions& o) { o.raster.clip_plane_count = 7; }) ==
          "raster state: clip_plane_count: expected 0 to 6, found 7");
    strata::pipeline::DrawList broken;
    broken.instances.push_back({.mesh = 3});
    CHECK(message([&](RenderOptions& o) { o.second_list = &broken; }) ==
          "draw list: instances[0].mesh: expected less than 0, found 3");
}

TEST_CASE("only the chip has a w buffer and it needs a perspective view") {
    RenderOptions options = options_for(one_fragment());
    options.depth_path = strata::rasterizer::DepthPath::w_buffer;
    options.depth = DepthFormat::d24;
    CHECK(
        refusal_message({"geforce3", "shadow_map"}, options) ==
        "profile geforce3 has no w buffer for a parallel projection, whose w is 1 everywhere; use depth path window_z, "
        "or a camera with perspective");
    CHECK(refusal_message({"geforce8", "dual"}, options) ==
          "profile geforce8 has no w buffer; use --profile geforce3 with --depth-format d16, d24, d16f or d24f");
}

TEST_CASE("a stored w is compared only with w and a stored depth never with w") {
    using strata::rasterizer::DepthPath;
    View view;
    view.projection = Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.02f, -1, 0, 0, -0.202f, 0};  // near 0.1, far 10
    RenderOptions options = options_for(one_fragment());
    options.depth = DepthFormat::d24;
    const auto told = [&](DepthPath stored, DepthPath compared) {
        options.depth_path = stored;
        options.reference_path = compared;
        const RenderResult result = render(draw_list(one_fragment()), view, {"geforce3", "shadow_map"}, options);
        return result.refusal ? result.refusal->message(*find_profile("geforce3")) : std::string{};
    };
    constexpr std::pair<DepthPath, DepthPath> unlike[] = {{DepthPath::w_buffer, DepthPath::perspective_rq},
                                                          {DepthPath::w_buffer, DepthPath::window_z},
                                                          {DepthPath::window_z, DepthPath::w_buffer},
                                                          {DepthPath::depth_replace, DepthPath::w_buffer}};
    for (const auto& [stored, compared] : unlike)
        CHECK(told(stored, compared) ==
              "profile geforce3 has no comparison of w with a depth; use "
              "w_buffer for both: --depth-path w_buffer --reference-path w_buffer");
    CHECK(told(DepthPath::w_buffer, DepthPath::w_buffer).empty());
    CHECK(told(DepthPath::window_z, DepthPath::perspective_rq).empty());
}
