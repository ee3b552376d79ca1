// tools/oracle/verdict/composite.h - the values that a pixel can have if a list of layers is composited as a hypothesis
// says.
//
// Rule     `reach` holds every result of every implementation that the hypothesis describes: sources, blends and
//          conversions take all values that their rounding allows, colours and alpha all within the slack. Channels are
//          bounded one by one.
// Numbers  Intervals of binary64 with outward rounding (interval.h). Blends in binary32 are off by at most 2^-22 of the
//          sum of their terms: at most five operations, 2^-24 each. Codes are whole numbers times 1 / (2^n - 1),
//          rounded once.
// Source   GL 4.6 17.3.6; fragment-stages.md 8 and 9; algorithms.md 4 (UNDER), 5 (both ends).
// Tests    tests/tools/oracle/verdict/composite_test.cpp: every 8-bit source and target of one layer and of two; random
//          lists by a model of each rounding
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "rasterizer/base/vector.h"
#include "tools/oracle/verdict/hypothesis.h"
#include "tools/oracle/verdict/interval.h"

namespace strata::oracle::verdict {

struct Layer {
    Rgba color{};                   // straight, alpha within [0, 1]
    bool is_premultiplied = false;  // colours are times alpha already, or stand for a sum; alpha may be anything
    float slack = 0;                // beside the hypothesis' own: of colours that come out of sums
    float spread = 0;               // the same, where the stack is moved, beside some units in the last place
    friend bool operator==(const Layer&, const Layer&) = default;
};

// What becomes of a finished picture's colours before they are stored.
enum class Finish : std::uint8_t { as_is, encoded, decoded };

// How a port blends beside what a hypothesis says: the defaults are right.
struct Mixing {
    enum class Through : std::uint8_t {
        product,
        squared,
        summed
    };                                                           // of 1 - alpha; of 1 - alpha^2; 1 - the sum of alphas
    enum class Behind : std::uint8_t { once, twice, inverted };  // how what is let through weighs what lies behind
    float first_through = 1;
    Through through = Through::product;
    Behind behind = Behind::once;
    bool attenuates = true;  // layers by what those before them let through
    // Bits of the front accumulator's colours and of what is let through; 0: as the hypothesis says.
    std::uint8_t color_bits = 0, weight_bits = 0;
    bool picture_too = false;  // the finished picture has passed through as few
    friend bool operator==(const Mixing&, const Mixing&) = default;
};

// A pixel's layers, near to far, over its background.
struct Stack {
    std::vector<Layer> layers{};
    Rgba background{};
    float background_spread = 0;
    // Of peels from both ends: how many layers the near half of the depths has, with the middle depth and without it.
    std::size_t near = 0, near_without_middle = 0;
    bool is_linear = false;  // colours are in linear light, and what is kept is encoded to sRGB
    Finish finish = Finish::as_is;
    Mixing mixing{};
    bool is_moved = false;  // positions are snapped otherwise: colours are off by their spreads, too
    friend bool operator==(const Stack&, const Stack&) = default;
};

// Where a picture of floats is put together of what accumulators keep in codes, it has no other values than front +
// weight * back of these.
struct Sums {
    double front_unit = 0,
           back_unit = 0;  // of a code; of the back 0 where it is a float. No front unit: nothing is known
    bool is_back_half = false;
    std::array<Interval, 3> front{}, back{};
    Interval weight{};
    double relative = 0;  // by which a sum is off, of its terms
    friend bool operator==(const Sums&, const Sums&) = default;
    [[nodiscard]] bool hold(const std::array<double, 4>& value) const noexcept;
    [[nodiscard]] double count() const noexcept;         // how many there are, floats aside
    [[nodiscard]] std::size_t weights() const noexcept;  // that `hold` tries; 0: nothing is known
};

// Red, green, blue and alpha of the finished pixel, as values (not codes) of the result's storage.
struct Reach {
    std::array<Interval, 4> channels{};
    Sums sums{};
    [[nodiscard]] Interval& operator[](std::size_t c) noexcept { return channels[c]; }
    [[nodiscard]] const Interval& operator[](std::size_t c) const noexcept { return channels[c]; }
    friend bool operator==(const Reach&, const Reach&) = default;
};
// Whether the pixel can have this colour; alpha aside.
[[nodiscard]] bool holds(const Reach& reach, const std::array<double, 4>& value) noexcept;

// How a storage rounds what it gets: a hypothesis' rounding turned into numbers once.
struct Keeper {
    bool has_codes = true;  // false: a float
    double scale = 255, inverse = 1.0 / 255;
    double minus = 0, plus = 0;  // codes: how far a stored one may lie below and above the exact result
    bool snaps = true;           // false: codes are not all that may be kept
    double cut_low = 0, cut_high = 0;
    bool cuts = false;               // whole codes below the exact result, moved by the two numbers above
    double relative = 0, least = 0;  // floats
    enum class Half : std::uint8_t { none, nearest, cut };
    Half half = Half::none;  // what is off by the two numbers above becomes the nearest number of binary16, or the one
                             // before it

    [[nodiscard]] Interval kept(Interval exact, double magnitude) const noexcept {
        if (!has_codes && half != Half::none) {
            const auto rounded = [&](double v) { return half == Half::cut ? cut_half(v) : nearest_half(v); };
            const Interval off = exact.widened(magnitude * relative);
            return Interval{rounded(off.low), rounded(off.high)}.widened(least);
        }
        if (!has_codes) return exact.widened(magnitude * relative + least);
        double low = below(exact.low * scale), high = above(exact.high * scale);
        if (cuts) {
            low = floor_of(low + cut_low);
            high = floor_of(high + cut_high);
        } else {
            low -= minus;
            high += plus;
            if (snaps) {
                low = ceil_of(low);
                high = floor_of(high);
            }
        }
        return {std::min(std::max(low, 0.0), scale) * inverse, std::min(std::max(high, 0.0), scale) * inverse};
    }

    // Exact for |x| < 2^51: binary64 has no finer numbers beyond 2^52.
    [[nodiscard]] static double nearest_whole(double x) noexcept { return (x + 0x1.8p52) - 0x1.8p52; }
    [[nodiscard]] static double floor_of(double x) noexcept {
        const double whole = nearest_whole(x);
        return whole - (whole > x ? 1.0 : 0.0);
    }
    // To 11 bits, by Veltkamp's splitting: of two that are as near, either.
    [[nodiscard]] static double nearest_half(double x) noexcept {
        const double far = (0x1p42 + 1) * x;
        return far - (far - x);
    }
    [[nodiscard]] static double cut_half(double x) noexcept {
        const double near = nearest_half(x);
        return std::fabs(near) > std::fabs(x) ? nearest_half(near * (1 - 0x1p-11)) : near;
    }
    [[nodiscard]] static double ceil_of(double x) noexcept {
        const double whole = nearest_whole(x);
        return whole + (whole < x ? 1.0 : 0.0);
    }
};

class Compositor {
  public:
    Compositor(const Hypothesis& hypothesis);  // what it describes
    [[nodiscard]] Reach reach(const Stack& stack) const noexcept;
    [[nodiscard]] const Hypothesis& hypothesis() const noexcept { return hypothesis_; }

  private:
    // How one end takes its sources, and what it keeps of a blend.
    struct Means {
        End end{};
        Keeper source{}, blend{}, under{}, weight{};  // weight: of what is let through
        double slack = 0;
    };
    struct Operand {
        std::array<Interval, 4> color{};  // straight or times alpha; the fourth: of 1
        Interval alpha{};
        bool is_premultiplied = false;
    };
    using Channels = std::array<Interval, 4>;

    // An order without a front accumulator reaches nothing by a mixing that has to do with one.
    [[nodiscard]] bool can_mix(const Stack& stack) const noexcept;
    [[nodiscard]] static Means means_of(const End& end, double slack);
    [[nodiscard]] static Operand operand(const Means& means, const Layer& layer, bool is_moved) noexcept;
    // UNDER: the fourth channel is what is let through.
    [[nodiscard]] static Channels under(const Means& means, std::span<const Layer> near_to_far,
                                        const Stack& stack) noexcept;
    static void over(const Means& means, std::span<const Layer> near_to_far, const Stack& stack,
                     Channels& onto) noexcept;
    [[nodiscard]] static Channels background_of(const Means& means, const Stack& stack) noexcept;
    // Of a float picture and accumulators of codes; else nothing.
    [[nodiscard]] Sums sums_of(const Stack& stack, const Channels& front, Interval weight,
                               const Channels& back) const noexcept;

    Hypothesis hypothesis_;
    Means front_, back_;
    Keeper result_;
    bool converts_ = false;  // what `over` leaves is not yet of the result's storage
};

}  // namespace strata::oracle::verdict
