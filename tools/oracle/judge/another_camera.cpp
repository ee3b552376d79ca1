// tools/oracle/judge/another_camera.cpp - fits small movements of the camera (another_camera.h).
#include "tools/oracle/judge/another_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "peeling/render.h"
#include "scenes/bounds.h"
#include "tools/oracle/picture/stored_like.h"

namespace strata::oracle {

namespace {

using pipeline::Matrix;
using pipeline::View;
using Point = std::array<double, 3>;

constexpr std::size_t most_pixels = std::size_t{1} << 16;  // of a picture whose camera is fitted
constexpr double two_codes = 2.5 / 255;

Point transformed(const Matrix& m, const Point& p) {
    Point to{};
    for (int row = 0; row < 3; ++row)
        to[static_cast<std::size_t>(row)] = m[0][row] * p[0] + m[1][row] * p[1] + m[2][row] * p[2] + m[3][row];
    return to;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c = identity;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            double sum = 0;
            for (int k = 0; k < 4; ++k) sum += double{a[k][row]} * double{b[column][k]};
            c[column][row] = static_cast<float>(sum);
        }
    return c;
}

// Turns by an angle in degrees in the plane of two axes, about a point.
Matrix turn(int from, int to, double degrees, const Point& about) {
    const double angle = degrees * std::numbers::pi / 180;
    Matrix m = identity;
    m[from][from] = m[to][to] = static_cast<float>(std::cos(angle));
    m[from][to] = static_cast<float>(std::sin(angle));
    m[to][from] = static_cast<float>(-std::sin(angle));
    const Point moved = transformed(m, about);
    for (int row = 0; row < 3; ++row) {
        const auto r = static_cast<std::size_t>(row);
        m[3][row] = static_cast<float>(about[r] - moved[r]);
    }
    return m;
}

Matrix shift(int axis, double by) {
    Matrix m = identity;
    m[3][axis] = static_cast<float>(by);
    return m;
}

struct Middle {
    Point in_world{}, in_eye{};
    int width = 0, height = 0;
};

// One number by which a camera is moved.
struct Movement {
    std::string_view more, less;  // of a positive and of a negative number; {} is the number
    void (*apply)(View& view, double by, const Middle& middle);
};

void in_world(View& view, const Matrix& m) { view.view = product(view.view, m); }
void in_eye(View& view, const Matrix& m) { view.view = product(m, view.view); }
void scale(View& view, double x, double y) {
    for (int column = 0; column < 4; ++column) {
        view.projection[column][0] *= static_cast<float>(x);
        view.projection[column][1] *= static_cast<float>(y);
    }
}
void move_picture(View& view, int row, double by) {
    for (int column = 0; column < 4; ++column)
        view.projection[column][row] += static_cast<float>(by) * view.projection[column][3];
}

const Movement movements[] = {
    {"the eye is {} degrees further to the left around the scene",
     "the eye is {} degrees further to the right around the scene",
     [](View& v, double by, const Middle& m) { in_world(v, turn(2, 0, by, m.in_world)); }},
    {"the eye is {} degrees higher around the scene", "the eye is {} degrees lower around the scene",
     [](View& v, double by, const Middle& m) { in_eye(v, turn(1, 2, by, m.in_eye)); }},
    {"the picture is turned to the left by {} degrees", "the picture is turned to the right by {} degrees",
     [](View& v, double by, const Middle&) { in_eye(v, turn(0, 1, by, {})); }},
    {"the eye is turned to the right by {} degrees", "the eye is turned to the left by {} degrees",
     [](View& v, double by, const Middle&) { in_eye(v, turn(2, 0, -by, {})); }},
    {"the eye is turned up by {} degrees", "the eye is turned down by {} degrees",
     [](View& v, double by, const Middle&) { in_eye(v, turn(1, 2, -by, {})); }},
    {"the eye is {} further to the right", "the eye is {} further to the left",
     [](View& v, double by, const Middle&) { in_eye(v, shift(0, -by)); }},
    {"the eye is {} higher", "the eye is {} lower",
     [](View& v, double by, const Middle&) { in_eye(v, shift(1, -by)); }},
    {"the eye is {} nearer", "the eye is {} farther away",
     [](View& v, double by, const Middle&) { in_eye(v, shift(2, by)); }},
    {"the picture is {} percent larger: another field of view",
     "the picture is {} percent smaller: another field of view",
     [](View& v, double by, const Middle&) { scale(v, 1 + by / 100, 1 + by / 100); }},
    {"the picture is {} percent wider: another aspect", "the picture is {} percent narrower: another aspect",
     [](View& v, double by, const Middle&) { scale(v, 1 + by / 100, 1); }},
    {"the picture is {} pixels further to the right", "the picture is {} pixels further to the left",
     [](View& v, double by, const Middle& m) { move_picture(v, 0, 2 * by / m.width); }},
    {"the picture is {} pixels higher", "the picture is {} pixels lower",
     [](View& v, double by, const Middle& m) { move_picture(v, 1, 2 * by / m.height); }},
};
constexpr std::size_t movement_count = std::size(movements);
using Amounts = std::array<double, movement_count>;

std::size_t differing(const verdict::Colors& one, const verdict::Colors& other) {
    std::size_t pixels = 0;
    for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x) {
            const auto a = one.at(x, y), b = other.at(x, y);
            const auto differs = [&](std::size_t c) { return std::fabs(a[c] - b[c]) > two_codes; };
            pixels += differs(0) || differs(1) || differs(2) ? 1 : 0;
        }
    return pixels;
}

class CameraFit {
  public:
    CameraFit(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, const verdict::Colors& picture)
        : input_{input}, algorithm_{algorithm}, picture_{picture} {
        const scenes::Bounds bounds = scenes::bounds_of(input.list);
        for (int axis = 0; axis < 3; ++axis)
            middle_.in_world[static_cast<std::size_t>(axis)] = (double{bounds.lo[axis]} + double{bounds.hi[axis]}) / 2;
        middle_.in_eye = transformed(input.view.view, middle_.in_world);
        middle_.width = input.options.width;
        middle_.height = input.options.height;
        for (int corner = 0; corner < 8; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis)
                corners_[static_cast<std::size_t>(corner)][axis] = double{
                    (corner >> axis & 1) != 0 ? bounds.hi[static_cast<int>(axis)] : bounds.lo[static_cast<int>(axis)]};
    }

    // The best movement, or the best with another one, of those that make most pixels right by half a pixel or one.
    [[nodiscard]] std::optional<AnotherCamera> found() {
        const std::size_t given = wrong_by({});
        if (given < 8) return std::nullopt;
        std::array<std::size_t, movement_count> roughly{}, order{};
        for (std::size_t k = 0; k < movement_count; ++k) {
            order[k] = k;
            roughly[k] = given;
            for (const double by : {-2.0, -1.0, 1.0, 2.0}) {
                Amounts amounts{};
                amounts[k] = by * unit(k);
                roughly[k] = std::min(roughly[k], wrong_by(amounts));
            }
        }
        std::ranges::stable_sort(order, {}, [&](std::size_t k) { return roughly[k]; });
        if (8 * roughly[order[0]] > 7 * given) return std::nullopt;
        constexpr std::size_t refined = 5;
        std::array<Amounts, refined> alone{};
        std::array<std::size_t, refined> wrong{}, rank{};
        for (std::size_t i = 0; i < refined; ++i) {
            rank[i] = i;
            wrong[i] = refine(alone[i], order[i]);
        }
        std::ranges::stable_sort(rank, {}, [&](std::size_t i) { return wrong[i]; });
        const std::size_t first = rank[0], most_wrong = std::max<std::size_t>(3, given / 6),
                          good = std::max<std::size_t>(3, given / 20);
        Amounts best = alone[first];
        std::size_t least = wrong[first];
        for (std::size_t k = 0; k < movement_count && least > good; ++k) {
            if (order[k] == order[first]) continue;
            Amounts both = alone[first];
            std::size_t left = refine(both, order[k]);
            for (int round = 0; round < 2 && left > good; ++round) {
                refine(both, order[first]);
                left = refine(both, order[k]);
            }
            if (left < least) least = left, best = both;
        }
        if (least > most_wrong) return std::nullopt;
        return AnotherCamera{words_of(best), least};
    }

    // False if the device refuses the algorithm.
    [[nodiscard]] bool is_drawn() { return drawn({}).has_value(); }

  private:
    // The right picture of a camera.
    [[nodiscard]] std::optional<verdict::Colors> drawn(const Amounts& amounts) {
        View view = input_.view;
        for (std::size_t k = 0; k < movement_count; ++k)
            if (amounts[k] != 0) movements[k].apply(view, amounts[k], middle_);
        peeling::RenderOptions options = input_.options;
        options.audit = options.keep_layers = false;
        const auto run = peeling::Renderer{input_.list, view, input_.profile, options}.render(algorithm_);
        if (run.outcome == peeling::Outcome::refused) return std::nullopt;
        Picture own{.file = "", .targets = {as_target(run.frame.color, "color")}};
        own.targets[0].alpha_form = AlphaForm::premultiplied;
        own_ = stored_like(std::move(own), Picture{.file = "", .targets = {picture_.target()}}, input_.space);
        return verdict::Colors{own_.targets[0], picture_.use()};
    }

    [[nodiscard]] std::size_t wrong_by(const Amounts& amounts) {
        const auto own = drawn(amounts);
        return own ? differing(*own, picture_) : picture_.target().pixels();
    }

    // The amount that moves a corner of the scene by half a pixel.
    [[nodiscard]] double unit(std::size_t k) const {
        constexpr double little = 0.01;
        View moved = input_.view;
        movements[k].apply(moved, little, middle_);
        double most = 0;
        for (const Point& corner : corners_) {
            const auto at = window(input_.view, corner), to = window(moved, corner);
            most = std::max(most, std::hypot(at[0] - to[0], at[1] - to[1]));
        }
        return most > 0 ? 0.5 * little / most : 0;
    }

    [[nodiscard]] std::array<double, 2> window(const View& view, const Point& p) const {
        const Point eye = transformed(view.view, p);
        const auto row = [&](int r) {
            const Matrix& m = view.projection;
            return m[0][r] * eye[0] + m[1][r] * eye[1] + m[2][r] * eye[2] + m[3][r];
        };
        const double w = row(3);
        return {row(0) / w * middle_.width / 2, row(1) / w * middle_.height / 2};
    }

    // Changes one amount to the best near it; returns the wrong pixels.
    std::size_t refine(Amounts& amounts, std::size_t k) {
        const double step = unit(k), start = amounts[k];
        std::size_t least = wrong_by(amounts);
        double best = start;
        const auto attempt = [&](double value) {
            amounts[k] = value;
            const std::size_t wrong = wrong_by(amounts);
            if (wrong < least) least = wrong, best = value;
        };
        for (const double by : {-4.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 4.0}) attempt(start + by * step);
        for (double by = std::max(0.25, std::fabs(best - start) / step / 4) * step; by > step / 64; by /= 2) {
            const double centre = best;
            attempt(centre - by);
            attempt(centre + by);
        }
        amounts[k] = best;
        return least;
    }

    [[nodiscard]] static std::string words_of(const Amounts& amounts) {
        std::string text;
        for (std::size_t k = 0; k < movement_count; ++k) {
            if (amounts[k] == 0) continue;
            const std::string_view words = amounts[k] > 0 ? movements[k].more : movements[k].less;
            text += (text.empty() ? "" : ", and ") +
                    fmt::format(fmt::runtime(words), fmt::format("{:.2g}", std::fabs(amounts[k])));
        }
        return text;
    }

    const peeling::FrameRequest& input_;
    const peeling::Algorithm& algorithm_;
    const verdict::Colors& picture_;
    Middle middle_{};
    std::array<Point, 8> corners_{};
    Picture own_{};
};

}  // namespace

std::string AnotherCamera::sentence(std::size_t pixels) const {
    return fmt::format("wrong: another camera: {}; {} of {} pixels are wrong then", words, wrong, pixels);
}

std::optional<AnotherCamera> another_camera(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                            const verdict::Colors& picture) {
    if (picture.target().pixels() > most_pixels) return std::nullopt;
    CameraFit fit{input, algorithm, picture};
    if (!fit.is_drawn()) return std::nullopt;
    return fit.found();
}

}  // namespace strata::oracle
