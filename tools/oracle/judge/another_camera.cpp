// tools/oracle/judge/another_camera.cpp - fits small movements of the camera (another_camera.h).
#include "tools/oracle/judge/another_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/vertices/matrix.h"
#include "scenes/bounds.h"
#include "tools/oracle/fragments/eye_point.h"
#include "tools/oracle/judge/emulated.h"
#include "tools/oracle/picture/stored_like.h"

namespace strata::oracle {

namespace {

using pipeline::Matrix;
using pipeline::View;
using Point = EyePoint;

constexpr std::size_t most_pixels = std::size_t{1} << 16;  // of a picture whose camera is fitted
constexpr double two_codes = 2.5 / 255;

// Turns by an angle in degrees in the plane of two axes, about a point.
Matrix turn(int from, int to, double degrees, const Point& about) {
    const double angle = degrees * std::numbers::pi / 180;
    Matrix m = identity;
    m[from][from] = m[to][to] = std::cos(angle);
    m[from][to] = std::sin(angle);
    m[to][from] = -std::sin(angle);
    const Point moved = transformed(m, about);
    for (int row = 0; row < 3; ++row) {
        const auto r = static_cast<std::size_t>(row);
        m[3][row] = about[r] - moved[r];
    }
    return m;
}

Matrix shift(int axis, double by) {
    Matrix m = identity;
    m[3][axis] = by;
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

void in_world(View& view, const Matrix& m) { view.view = pipeline::product(view.view, m); }
void in_eye(View& view, const Matrix& m) { view.view = pipeline::product(m, view.view); }
void scale(View& view, double x, double y) {
    for (int column = 0; column < 4; ++column) {
        view.projection[column][0] *= x;
        view.projection[column][1] *= y;
    }
}
void move_picture(View& view, int row, double by) {
    for (int column = 0; column < 4; ++column) view.projection[column][row] += by * view.projection[column][3];
}

const Movement movements[] = {
    {"the eye is {} degrees further to the left around the scene",
     "the eye is {} degrees further to the right around the scene",
     [](View& v, double by, const Middle& m) { in_world(v, turn(2, 0, by, m.in_world)); }},
    {"the eye is {} degrees higher around the scene", "the eye is {} degrees lower around the scene",
     [](View& v, double by, const Middle& m) { in_eye(v, turn(1, 2, by, m.in_eye)); }},
    {"the picture is turned to the left by {} degrees", "the picture is turned to the right by {} degrees",
     [](View& v, double by, const Middle&) { in_eye(v, turn(0, 1, by, {})); }},
    {"the eye is turned to the left by {} degrees", "the eye is turned to the right by {} degrees",
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
// Other projections, which no small movement reaches.
struct OtherProjection {
    std::string_view words;
    void (*apply)(View& view, double aspect);
};
const OtherProjection projections[] = {
    {"the projection is that of a square picture: the aspect is taken as 1",
     [](View& v, double aspect) { scale(v, aspect, 1); }},
    {"the aspect is applied twice", [](View& v, double aspect) { scale(v, 1 / aspect, 1); }},
    {"the aspect is applied to the height instead of the width",
     [](View& v, double aspect) { scale(v, aspect, aspect); }},
    {"the vertical field of view is taken as the horizontal one",
     [](View& v, double aspect) { scale(v, 1 / aspect, 1 / aspect); }},
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

    [[nodiscard]] std::optional<AnotherCamera> found() const {
        const std::size_t given = wrong_by(input_.view);
        if (given < 8) return std::nullopt;
        for (const OtherProjection& projection : projections) {
            View view = input_.view;
            projection.apply(view, double(middle_.width) / middle_.height);
            if (const std::size_t wrong = wrong_by(view); wrong <= std::max(few, given / 50))
                return AnotherCamera{std::string{projection.words}, wrong};
        }
        const std::vector<std::size_t> order = likely(given);
        if (order.empty()) return std::nullopt;
        Fit best{.wrong = given};
        std::size_t first = 0;
        for (std::size_t i = 0; i < refined; ++i) {
            Amounts alone{};
            if (const std::size_t wrong = refine(alone, order[i]); wrong < best.wrong)
                best = {alone, wrong}, first = order[i];
        }
        if (best.wrong > std::max(few, given / 20)) best = with_another(best, first, order, std::max(few, given / 20));
        if (best.wrong > std::max(few, given / 6)) return std::nullopt;
        return AnotherCamera{words_of(best.amounts), best.wrong};
    }

  private:
    static constexpr std::size_t refined = 5, few = 3;

    struct Fit {
        Amounts amounts{};
        std::size_t wrong = 0;
    };

    // The movements by what half a pixel or one makes right, most first; none if that is less than an eighth.
    [[nodiscard]] std::vector<std::size_t> likely(std::size_t given) const {
        std::array<std::size_t, movement_count> wrong{};
        std::vector<std::size_t> order;
        for (std::size_t k = 0; k < movement_count; ++k) {
            order.push_back(k);
            wrong[k] = given;
            for (const double by : {-2.0, -1.0, 1.0, 2.0}) {
                Amounts amounts{};
                amounts[k] = by * unit(k);
                wrong[k] = std::min(wrong[k], wrong_by(amounts));
            }
        }
        std::ranges::stable_sort(order, {}, [&](std::size_t k) { return wrong[k]; });
        return 8 * wrong[order[0]] > 7 * given ? std::vector<std::size_t>{} : order;
    }

    // The best of two movements, each refined in turn; the first that leaves at most `good` wrong.
    [[nodiscard]] Fit with_another(const Fit& alone, std::size_t first, const std::vector<std::size_t>& order,
                                   std::size_t good) const {
        Fit best = alone;
        for (const std::size_t k : order) {
            if (k == first) continue;
            if (best.wrong <= good) break;
            Fit both = alone;
            both.wrong = refine(both.amounts, k);
            for (int round = 0; round < 2 && both.wrong > good; ++round) {
                refine(both.amounts, first);
                both.wrong = refine(both.amounts, k);
            }
            if (both.wrong < best.wrong) best = both;
        }
        return best;
    }

    // All pixels if the device refuses the algorithm.
    [[nodiscard]] std::size_t wrong_by(const Amounts& amounts) const {
        View view = input_.view;
        for (std::size_t k = 0; k < movement_count; ++k)
            if (amounts[k] != 0) movements[k].apply(view, amounts[k], middle_);
        return wrong_by(view);
    }
    [[nodiscard]] std::size_t wrong_by(const View& view) const {
        const auto drawn = own_picture({input_.list, view, input_.profile, input_.options, input_.space}, algorithm_);
        if (!drawn) return picture_.target().pixels();
        const Picture own = stored_like(*drawn, Picture{.file = "", .targets = {picture_.target()}}, input_.space);
        return differing(verdict::Colors{own.targets[0], picture_.use()}, picture_);
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
    std::size_t refine(Amounts& amounts, std::size_t k) const {
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
};

}  // namespace

std::string AnotherCamera::sentence(std::size_t pixels) const {
    return fmt::format("wrong: another camera: {}; {} of {} pixels are wrong then", words, wrong, pixels);
}

std::optional<AnotherCamera> another_camera(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                            const verdict::Colors& picture) {
    if (picture.target().pixels() > most_pixels) return std::nullopt;
    return CameraFit{input, algorithm, picture}.found();
}

}  // namespace strata::oracle
