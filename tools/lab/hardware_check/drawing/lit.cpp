#include "tools/lab/hardware_check/drawing/lit.h"

#include <cmath>

namespace strata::hardware_check {

using pipeline::Three;

LitCamera::LitCamera()
    : camera_{default_camera(16777215.0f)},
      whole_{columns_of(camera_.composite)},
      to_eye_{columns_of(look_at({0, 0, -7}, {0, 0, 0}))} {}

namespace {

TriangleSoup soup_of_lit() {
    TriangleSoup soup;
    soup.extras = {.stride = 8, .has_secondary = true, .values = {}};
    return soup;
}

void add_lit(TriangleSoup& soup, const LightingRegisters& registers, const WorldVertex& v, const HostVector& eye,
             const HostVector& window) {
    const pipeline::LitColors colors =
        light_vertex(registers, {{eye[0], eye[1], eye[2]}, v.normal, v.diffuse, v.specular});
    soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
    soup.vertices.push_back(at(window[0], window[1], window[2], colors.primary, window[3]));
    for (int side = 0; side < 2; ++side)
        soup.extras.values.insert(soup.extras.values.end(), colors.secondary.begin(), colors.secondary.end());
}

}  // namespace

TriangleSoup LitCamera::lit(const LightingRegisters& registers, std::span<const WorldVertex> vertices) const {
    TriangleSoup soup = soup_of_lit();
    for (const WorldVertex& v : vertices)
        add_lit(soup, registers, v, chip_product(to_eye_, v.point), chip_window_point(whole_, v.point));
    return soup;
}

TriangleSoup lit_in_window(const LightingRegisters& registers, std::span<const WorldVertex> vertices) {
    TriangleSoup soup = soup_of_lit();
    for (const WorldVertex& v : vertices) add_lit(soup, registers, v, v.point, v.point);
    return soup;
}

namespace {

// As the host computes it.
Three normalized(const Three& v) {
    const float inverse = 1.0f / std::sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
    return {v[0] * inverse, v[1] * inverse, v[2] * inverse};
}
Three negative(const Three& v) { return {-v[0], -v[1], -v[2]}; }

}  // namespace

pipeline::LightRegisters infinite_light(const Three& direction) {
    const Three unit = normalized(direction);
    pipeline::LightRegisters light;
    light.kind = pipeline::LightKind::infinite;
    light.direction = negative(unit);
    light.half_vector = negative(normalized({unit[0], unit[1], unit[2] + 1.0f}));
    return light;
}

pipeline::Combiners show_lit(Shown shown, ShownAlpha alpha) {
    using pipeline::CombinerMapping;
    using Reg = pipeline::CombinerRegister;
    const auto factor = [](bool is_one) {
        return pipeline::CombinerInput{
            .source = Reg::zero,
            .mapping = is_one ? CombinerMapping::unsigned_invert : CombinerMapping::unsigned_identity};
    };
    pipeline::CombinerPortion sum{.a = {.source = Reg::primary_color},
                                  .b = factor(shown != Shown::secondary),
                                  .c = {.source = Reg::secondary_color},
                                  .d = factor(shown != Shown::primary),
                                  .sum = Reg::spare0};
    pipeline::Combiners combiners;
    combiners.stages.resize(1);
    combiners.stages[0].rgb = sum;
    if (alpha == ShownAlpha::one) sum = {.a = factor(true), .b = factor(true), .sum = Reg::spare0};
    combiners.stages[0].alpha = sum;
    combiners.final_stage.d = {.source = Reg::spare0};
    combiners.final_stage.g = {.source = Reg::spare0};
    return combiners;
}

pipeline::Surface cleared_to(const pipeline::DeviceProfile& profile, Argb color) {
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(color));
    return surface;
}

void draw_lit(pipeline::Surface& surface, const pipeline::Combiners& combiners, const TriangleSoup& soup) {
    const pipeline::FragmentPath path{{}, combiners, {}};
    pipeline::DrawState state{.blend = pipeline::blend_mode::over};
    state.path = &path;
    surface.draw(state, soup);
}

}  // namespace strata::hardware_check
