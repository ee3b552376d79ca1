// tools/oracle/program/steps/color_entries.cpp - the background, and the finished colour, as another one (entries.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

template <auto f>
Color each_channel(const Color& color, Parameters p) {
    return {f(color[0], p), f(color[1], p), f(color[2], p)};
}
template <std::size_t r, std::size_t g, std::size_t b>
Color exchanged(const Color& color, Parameters) {
    return {color[r], color[g], color[b]};
}
Color given(const Color&, Parameters p) { return {p[0], p[1], p[2]}; }

std::vector<double> middle_grey(double, double) { return {0.5, 0.5, 0.5}; }
Color mixed(const Color& c, Parameters p) {
    Color made{};
    for (std::size_t i = 0; i < 3; ++i)
        made[i] = p[4 * i] * c[0] + p[4 * i + 1] * c[1] + p[4 * i + 2] * c[2] + p[4 * i + 3];
    return made;
}
std::vector<double> identity(double, double) { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; }

double black(double, Parameters) { return 0; }
double white(double, Parameters) { return 1; }
double grey(double, Parameters p) { return p[0]; }
double inverted(double v, Parameters) { return 1 - v; }
double encode(double v, Parameters) { return encoded(v); }
double decode(double v, Parameters) { return decoded(v); }
double quantised(double v, Parameters p) { return in_bits(v, p[0]); }
double times(double v, Parameters p) { return v * p[0]; }
double power(double v, Parameters p) { return std::pow(std::max(v, 0.0), p[0]); }
double video(double v, Parameters) { return (16 + 219 * v) / 255; }
double from_video(double v, Parameters) { return (255 * v - 16) / 219; }
double scaled(double v, Parameters p) { return p[0] + p[1] * v; }
std::vector<double> unscaled(double, double) { return {0, 1}; }
bool is_scale(Parameters p) { return p[1] > 0.05 && std::fabs(p[0]) + std::fabs(p[1] - 1) > 0.02; }
double at_most(double v, Parameters p) { return std::min(v, p[0]); }

constexpr double greys[] = {0.25, 0.5, 0.75}, factors[] = {0.5, 0.75, 1.25, 2}, powers[] = {0.5, 1.5, 2, 2.2},
                 limits[] = {0.5, 0.75}, bits[] = {1, 2, 3, 4, 5, 6, 7};

const StepEntry backgrounds[] = {
    {.step = PortStep::background, .words = "the background is black", .price = 3, .recolor = each_channel<black>},
    {.step = PortStep::background, .words = "the background is white", .price = 3, .recolor = each_channel<white>},
    {.step = PortStep::background,
     .words = "the background is a grey of {}",
     .parameters = greys,
     .is_continuous = true,
     .recolor = each_channel<grey>},
    {.step = PortStep::background, .words = "the background is inverted", .recolor = each_channel<inverted>},
    {.step = PortStep::background, .words = "the background is encoded as sRGB", .recolor = each_channel<encode>},
    {.step = PortStep::background, .words = "the background is decoded from sRGB", .recolor = each_channel<decode>},
    {.step = PortStep::background,
     .words = "red and blue of the background are exchanged",
     .recolor = exchanged<2, 1, 0>},
    {.step = PortStep::background,
     .words = "the background is multiplied by {}",
     .price = 5,
     .parameters = factors,
     .is_continuous = true,
     .recolor = each_channel<times>},
    {.step = PortStep::background,
     .words = "the background is ({}, {}, {})",
     .price = 6,
     .start = middle_grey,
     .recolor = given},
};

const StepEntry finishes[] = {
    {.step = PortStep::finish, .words = "the picture is encoded as sRGB", .recolor = each_channel<encode>},
    {.step = PortStep::finish, .words = "the picture is decoded from sRGB", .recolor = each_channel<decode>},
    {.step = PortStep::finish,
     .words = "red and blue of the picture are exchanged",
     .price = 3,
     .recolor = exchanged<2, 1, 0>},
    {.step = PortStep::finish, .words = "red and green of the picture are exchanged", .recolor = exchanged<1, 0, 2>},
    {.step = PortStep::finish, .words = "green and blue of the picture are exchanged", .recolor = exchanged<0, 2, 1>},
    {.step = PortStep::finish,
     .words = "the picture's red acts as {} red + {} green + {} blue + {}, green as {}, {}, {} + {}, blue as {}, {}, "
              "{} + {}",
     .price = 10,
     .start = identity,
     .recolor = mixed},
    {.step = PortStep::finish,
     .words = "the picture is in video range: 0 is stored as 16, 255 as 235",
     .recolor = each_channel<video>},
    {.step = PortStep::finish,
     .words = "the picture is taken for one in video range: 16 is stored as 0, 235 as 255",
     .recolor = each_channel<from_video>},
    {.step = PortStep::finish,
     .words = "the picture's values are stored as {} + {} times them",
     .price = 8,
     .start = unscaled,
     .is_plausible = is_scale,
     .recolor = each_channel<scaled>},
    {.step = PortStep::finish, .words = "the picture is inverted", .recolor = each_channel<inverted>},
    {.step = PortStep::finish,
     .words = "the picture is rounded to {} bits",
     .parameters = bits,
     .recolor = each_channel<quantised>},
    {.step = PortStep::finish,
     .words = "the picture is multiplied by {}",
     .parameters = factors,
     .is_continuous = true,
     .recolor = each_channel<times>},
    {.step = PortStep::finish,
     .words = "the picture has the power of {}",
     .price = 5,
     .parameters = powers,
     .is_continuous = true,
     .recolor = each_channel<power>},
    {.step = PortStep::finish,
     .words = "the picture is clamped to {}",
     .price = 5,
     .parameters = limits,
     .is_continuous = true,
     .recolor = each_channel<at_most>},
};

}  // namespace

std::span<const StepEntry> background_entries() { return backgrounds; }
std::span<const StepEntry> finish_entries() { return finishes; }

}  // namespace strata::oracle::program
