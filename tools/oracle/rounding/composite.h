// tools/oracle/rounding/composite.h - computes the interval of values that a pixel can have if a list of layers is
// composited under a rounding hypothesis.
//
// Rule     `reach` contains every result of every implementation that the hypothesis describes: sources, blends and
//          conversions may have any value that their rounding allows, and colours and alphas any value within the
//          slack. Each channel is bounded independently.
// Numbers  Intervals of binary64 with outward rounding (interval.h). Blends in binary32 have an error of at most 2^-22
//          of the sum of their terms: at most five operations with 2^-24 each. Codes are whole numbers times 1 / (2^n -
//          1), rounded once.
// Source   GL 4.6 17.3.6; pipeline/reference/fragment-stages.md 8 and 9; peeling/reference/algorithms.md 4 (UNDER), 5
//          (both ends).
// Tests    tests/tools/oracle/rounding/composite_test.cpp: all pairs of 8-bit source and target for one layer and for
//          two; random lists against a model of each rounding
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "rasterizer/base/vector.h"
#include "tools/oracle/rounding/hypothesis.h"
#include "tools/oracle/rounding/interval.h"
#include "tools/oracle/rounding/storage_rounding.h"

namespace strata::oracle::verdict {

struct Layer {
    Rgba color{};                   // straight, alpha within [0, 1]
    bool is_premultiplied = false;  // colours are multiplied by alpha already, or are a sum; alpha is arbitrary
    float slack = 0;                // error in addition to the hypothesis' slack, for colours that are sums
    float spread = 0;               // further error if the stack is moved, in addition to a few units in the last place
    friend bool operator==(const Layer&, const Layer&) = default;
};

// The conversion of a finished picture's colours before they are stored.
enum class Finish : std::uint8_t { as_is, encoded, decoded };

// Deviations of a port's blending that a hypothesis does not describe. The defaults are correct.
struct Mixing {
    enum class Through : std::uint8_t {
        product,
        squared,
        summed
    };  // product of 1 - alpha; product of 1 - alpha^2; 1 - sum of alphas
    // The back's factor: the front's transmittance t, t^2, or 1 - t.
    enum class Behind : std::uint8_t { once, twice, inverted };
    Through through = Through::product;
    Behind behind = Behind::once;
    bool attenuates = true;  // false: layers are added without the transmittance of the layers before them
    // Bits of the front accumulator's colours and of its transmittance; 0: as in the hypothesis.
    std::uint8_t color_bits = 0, weight_bits = 0;
    bool picture_too = false;  // the finished picture also has only color_bits
    friend bool operator==(const Mixing&, const Mixing&) = default;
};

// The layers of a pixel, near to far, and its background.
struct Stack {
    std::vector<Layer> layers{};
    Rgba background{};
    float background_spread = 0;
    // For peels from both ends: the number of layers in the near half of the depths, including the middle depth and
    // excluding it.
    std::size_t near = 0, near_without_middle = 0;
    bool is_linear = false;  // colours are linear, and stored values are encoded as sRGB
    Finish finish = Finish::as_is;
    Mixing mixing{};
    bool is_moved = false;  // positions are snapped differently, so colours have their spreads as errors
    friend bool operator==(const Stack&, const Stack&) = default;
};

// The exact set of values of a float picture that is computed from accumulators of codes or of halves: only front +
// weight * back of such values is possible.
struct Sums {
    double front_unit = 0, back_unit = 0;  // the step of the codes; 0 for an end of floats
    bool is_front_half = false, is_back_half = false;
    std::array<Interval, 3> front{}, back{};
    Interval weight{};
    double relative = 0;  // error of a sum, relative to its terms
    friend bool operator==(const Sums&, const Sums&) = default;
    [[nodiscard]] bool is_known() const noexcept { return front_unit > 0 || is_front_half; }
    [[nodiscard]] bool hold(const std::array<double, 4>& value) const noexcept;
    [[nodiscard]] double count() const noexcept;         // number of such sums, not counting floats
    [[nodiscard]] std::size_t weights() const noexcept;  // number of weights that `hold` tries; 0: the set is not known
};

// The possible red, green, blue and alpha of the finished pixel, as values (not codes) in the result's storage.
struct ReachableColor {
    std::array<Interval, 4> channels{};
    Sums sums{};
    [[nodiscard]] Interval& operator[](std::size_t c) noexcept { return channels[c]; }
    [[nodiscard]] const Interval& operator[](std::size_t c) const noexcept { return channels[c]; }
    friend bool operator==(const ReachableColor&, const ReachableColor&) = default;
};
// True if the pixel can have this colour; alpha is not compared.
[[nodiscard]] bool holds(const ReachableColor& reach, const std::array<double, 4>& value) noexcept;

// What the layers of one stack become at either end, by the rounding of the end: many hypotheses share their ends.
class KnownEnds {
  public:
    using Channels = std::array<Interval, 4>;
    enum class Part : std::uint8_t { background, back, back_apart, front };
    [[nodiscard]] Channels of(Part part, const End& end, double slack, std::size_t near, const auto& make) {
        const std::uint64_t key = std::uint64_t{near} << 32 | static_cast<std::uint64_t>(part) << 24 |
                                  static_cast<std::uint64_t>(end.storage) << 16 |
                                  static_cast<std::uint64_t>(end.source) << 8 |
                                  static_cast<std::uint64_t>(end.rounding);
        for (std::size_t i = 0; i < keys_.size(); ++i)
            if (keys_[i] == key && all_[i].slack == slack) return all_[i].channels;
        keys_.push_back(key);
        return all_.emplace_back(Known{slack, make()}).channels;
    }

  private:
    struct Known {
        double slack = 0;
        Channels channels{};
    };
    std::vector<std::uint64_t> keys_{};
    std::vector<Known> all_{};
};

class Compositor {
  public:
    Compositor(const Hypothesis& hypothesis);
    [[nodiscard]] ReachableColor reach(const Stack& stack) const noexcept;
    // The same; `known` belongs to this stack, and receives its ends if they have many layers.
    [[nodiscard]] ReachableColor reach(const Stack& stack, KnownEnds& known) const;
    [[nodiscard]] const Hypothesis& hypothesis() const noexcept { return hypothesis_; }

  private:
    // The rounding at one end: of its sources, and of the stored result of a blend.
    struct Means {
        End end{};
        StorageRounding source{}, blend{}, under{}, weight{};  // weight: of the transmittance
        double slack = 0;
    };
    struct Operand {
        std::array<Interval, 4> color{};  // straight or premultiplied; the fourth is the blend of 1
        Interval alpha{};
        bool is_premultiplied = false;
    };
    using Channels = KnownEnds::Channels;

    [[nodiscard]] std::size_t near_of(const Stack& stack) const noexcept;
    // `ends` makes a part, or has it: of a part, its rounding, the number of near layers and a function that makes it.
    [[nodiscard]] ReachableColor reach_of(const Stack& stack, const auto& ends) const;
    // False if the stack's mixing needs a front accumulator and the order has none. Such a stack has no possible value.
    [[nodiscard]] bool can_mix(const Stack& stack) const noexcept;
    [[nodiscard]] static Means means_of(const End& end, double slack);
    [[nodiscard]] static Operand operand(const Means& means, const Layer& layer, bool is_moved) noexcept;
    // UNDER. The fourth channel is the transmittance.
    [[nodiscard]] static Channels under(const Means& means, std::span<const Layer> near_to_far,
                                        const Stack& stack) noexcept;
    static void over(const Means& means, std::span<const Layer> near_to_far, const Stack& stack,
                     Channels& onto) noexcept;
    [[nodiscard]] static Channels background_of(const Means& means, const Stack& stack) noexcept;
    // The set of sums for a float picture with accumulators of codes or halves; otherwise an unknown set.
    [[nodiscard]] Sums sums_of(const Stack& stack, const Channels& front, Interval weight,
                               const Channels& back) const noexcept;

    Hypothesis hypothesis_;
    Means front_, back_;
    StorageRounding result_;
    bool converts_ = false;  // the result of `over` still has to be converted to the result's storage
};

}  // namespace strata::oracle::verdict
