#include "tools/lab/hardware_check/drawing/fogged.h"

namespace strata::hardware_check {

void FoggedSoup::add_triangle(const FoggedVertex& a, const FoggedVertex& b, const FoggedVertex& c) {
    for (const FoggedVertex* v : {&a, &b, &c})
        soup_.extras.values.push_back(pipeline::vertex_fog(registers_, v->coordinate));
    hardware_check::add_triangle(soup_, a.vertex, b.vertex, c.vertex);
}

void FoggedSoup::add_quad(const std::array<FoggedVertex, 4>& corner) {
    add_triangle(corner[0], corner[1], corner[2]);
    add_triangle(corner[0], corner[2], corner[3]);
}

void FoggedSoup::draw(pipeline::Surface& surface, const pipeline::Combiners& combiners) const {
    const pipeline::FragmentPath path{{}, combiners, registers_};
    pipeline::DrawState state;
    state.path = &path;
    surface.draw(state, soup_);
}

pipeline::Combiners mix_with_fog() {
    using Reg = pipeline::CombinerRegister;
    pipeline::Combiners combiners;
    combiners.final_stage.a = {.source = Reg::fog, .component = pipeline::CombinerComponent::alpha};
    combiners.final_stage.b = {.source = Reg::primary_color};
    combiners.final_stage.c = {.source = Reg::fog};
    combiners.final_stage.g = {.source = Reg::primary_color};
    return combiners;
}

std::optional<FogFunction> fog_function(std::string_view word) {
    using enum FogFunction;
    constexpr std::pair<std::string_view, FogFunction> all[] = {
        {"linear", linear}, {"linear_abs", linear_abs}, {"lin", linear}, {"lin_abs", linear_abs},
        {"exp", exp},       {"exp_abs", exp_abs},       {"exp2", exp2},  {"exp2_abs", exp2_abs}};
    for (const auto& [name, function] : all)
        if (word == name) return function;
    return std::nullopt;
}

FogRegisters usual_registers(FogFunction function, const Rgba& color) {
    constexpr float density = 0.025f, ln_256 = 5.5452f, root_of_ln_256 = 2.3548f, start = 1.0f, end = 200.0f;
    if (pipeline::is_linear(function)) {
        const float multiplier = -1.0f / (end - start);
        return {function, 1.0f + -end * multiplier, multiplier, color};
    }
    const bool is_square = function == FogFunction::exp2 || function == FogFunction::exp2_abs;
    return {function, 1.5f, -density / (2.0f * (is_square ? root_of_ln_256 : ln_256)), color};
}

namespace {

const std::array<float, 3> eye_position{0, 0, -7}, looked_at{0, 0, 0};

}  // namespace

FogCamera::FogCamera(Transform transform, float depth_units)
    : transform_{transform},
      camera_{default_camera(depth_units)},
      whole_{columns_of(camera_.composite)},
      to_eye_{columns_of(look_at(eye_position, looked_at))},
      // Colours show no pixel of a program beyond the range of depths, which world z = 200 reaches (assumed: half of
      // it).
      to_window_{columns_of(perspective_to_window(depth_units / 2))} {}

ClipVertex FogCamera::vertex(const HostVector& world, const std::array<float, 4>& color) const {
    const auto [x, y, z, w] = transform_ == Transform::fixed ? chip_window_point(whole_, world)
                                                             : chip_quotient(chip_product(to_window_, eye(world)));
    return at(x, y, z, color, w);
}

}  // namespace strata::hardware_check
