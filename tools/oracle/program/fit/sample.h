// tools/oracle/program/fit/sample.h - some wrong and some right pixels, on which a change of a program is tried in
// microseconds.
//
// Rule     A trial's prediction is emulated(base) + exact(trial) - exact(base): rounding cancels wherever the trial
//          changes nothing. Where it changes much that adds two roundings, so that exact(trial) alone is then scored,
//          too, and the lesser cost counts. Pixels are weighted so that the sample stands for the picture.
// Numbers  Covered pixels that are wrong and right, and pixels without layers that are, at even distances. Pixels with
//          equal depths are left out unless most wrong pixels have them.
// Tests    tests/tools/oracle/program/found_test.cpp
#pragma once
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/oracle/program/fit/score.h"

namespace strata::oracle::program {

struct SamplePixel {
    const ListPixel* pixel = nullptr;
    double weight = 1;
    bool is_wrong = false;
    std::size_t first = 0;  // of its fragments in the sample
    Color emulated{}, exact{};
    double cost = 0, exact_cost = 0;         // of these
    double cost_from_here = 0;               // weighted, of this pixel and the following ones
    std::vector<std::vector<char>> masks{};  // of the base program's edits
};

// The most pixels of each class.
struct SampleSize {
    std::size_t wrong = 120, right = 100, wrong_empty = 20, right_empty = 20;
};
inline constexpr SampleSize small_sample{60, 40, 8, 8};

// The pixels of a picture as a program leaves them: wrong, right, and the same without layers. Samples of any size are
// taken from one.
struct PixelClasses {
    struct Seen {
        const ListPixel* pixel = nullptr;
        Color color{};
        double cost = 0;
    };
    PixelClasses(const Lists& lists, const Program& base, const PortRounding& rounding);

    Program base;
    double unit = 1;
    std::array<std::vector<Seen>, 4> all{};
};

// What a trial must reach to be of use: otherwise its score is cut short.
struct WantedScore {
    double bits = std::numeric_limits<double>::infinity();  // at most
    double saved = 0;                                       // or at least
};

// The cost of a trial, and what it saves at the pixels where it is better: a condition on pixels can save that much.
struct Score {
    double bits = 0, saved = 0;
};

// A rounding with the costs of the base program.
struct Emulation {
    PortRounding rounding{};
    std::vector<double> base{};  // weighted, per pixel
};

// Numbers the masks of each pixel: equal ones have one number, and those that select nothing 0. Conditions that select
// the same fragments of a pixel share what is known about it.
class MaskNumbers {
  public:
    [[nodiscard]] std::uint32_t of(std::size_t pixel, std::span<const char> mask);

  private:
    std::vector<std::map<std::string, std::uint32_t, std::less<>>> pixels_{};
};

// The fragments of a sample, or its pixels, that an edit changes. Numbers are found when they are asked.
class SampleMask {
  public:
    SampleMask(std::vector<char> all, MaskNumbers& numbers) : all_{std::move(all)}, numbers_{&numbers} {}
    [[nodiscard]] const std::vector<char>& all() const noexcept { return all_; }
    [[nodiscard]] std::uint32_t number(std::size_t pixel, std::span<const char> own) {
        constexpr std::uint32_t unknown = ~0u;
        if (of_pixels_.size() <= pixel) of_pixels_.resize(pixel + 1, unknown);
        if (of_pixels_[pixel] == unknown) of_pixels_[pixel] = numbers_->of(pixel, own);
        return of_pixels_[pixel];
    }

  private:
    std::vector<char> all_;
    MaskNumbers* numbers_;
    std::vector<std::uint32_t> of_pixels_{};
};

// What an edit costs at the pixels of a sample, by the number of the mask there.
class KnownCosts {
  public:
    struct Cost {
        double moved = -1, exact = -1;  // negative: not known
    };
    template <class Find>
    const Cost& at(std::size_t pixel, std::uint32_t number, const Find& find) {
        if (pixels_.size() <= pixel) pixels_.resize(pixel + 1);
        std::vector<Cost>& costs = pixels_[pixel];
        if (costs.size() <= number) costs.resize(number + 1);
        if (costs[number].moved < 0) costs[number] = find();
        return costs[number];
    }
    void forget() { pixels_.clear(); }

  private:
    std::vector<std::vector<Cost>> pixels_{};
};

class FitSample {
  public:
    explicit FitSample(const PixelClasses& classes, const SampleSize& size = {});

    [[nodiscard]] const std::vector<SamplePixel>& pixels() const noexcept { return pixels_; }
    [[nodiscard]] std::size_t fragments() const noexcept { return fragments_; }
    [[nodiscard]] double unit() const noexcept { return unit_; }
    [[nodiscard]] const Program& base() const noexcept { return base_; }
    [[nodiscard]] double cost() const noexcept { return cost_; }  // of the base program
    [[nodiscard]] std::size_t wrong() const noexcept { return wrong_; }

    // The values of a property at all fragments, or for edits of other steps than the list at all pixels.
    [[nodiscard]] const std::vector<double>& values(const FragmentProperty& property, PortStep step) const;

    // The exact colour with one more edit; `mask`: of the pixel's fragments, or one element.
    [[nodiscard]] Color exact(const SamplePixel& pixel, const StepEntry& entry, Parameters p,
                              std::span<const char> mask) const;
    // The score with one more edit; `mask`: of all fragments for edits of lists, of all pixels for others. `known`:
    // what was found before of the same entry and parameters.
    [[nodiscard]] Score score(const StepEntry& entry, Parameters p, SampleMask& mask, KnownCosts& known,
                              const WantedScore& wanted = {}) const;
    [[nodiscard]] Score score(const Edit& edit) const;
    // The same by emulation of a port's rounding: slower, and right where an edit changes most. Beyond `most` it is cut
    // short.
    [[nodiscard]] Emulation emulation(const PortRounding& rounding) const;
    [[nodiscard]] double emulated(const StepEntry& entry, Parameters p, SampleMask& mask, const Emulation& emulation,
                                  KnownCosts& known, double most) const;
    // Under each of several roundings.
    [[nodiscard]] std::vector<double> emulated(const Edit& edit, std::span<const Emulation> emulations) const;
    // The mask of an edit with these conditions.
    [[nodiscard]] std::vector<char> mask(const StepEntry& entry, std::span<const Condition> conditions) const;

    // The part of a mask at a pixel.
    [[nodiscard]] std::span<const char> mask_at(std::size_t i, PortStep step, std::span<const char> all) const;
    // The range of depths.
    [[nodiscard]] std::pair<double, double> depths() const;

  private:
    void choose(const PixelClasses& classes, const SampleSize& size);
    // The pixel after the base program's edits and one more; until the next call of the thread.
    [[nodiscard]] const EditedPixel& edited(const SamplePixel& pixel, const Applied& edit) const;

    Program base_;
    double unit_ = 1, cost_ = 0;
    std::size_t fragments_ = 0, wrong_ = 0;
    std::vector<SamplePixel> pixels_{};
    std::vector<std::vector<double>> of_fragments_{}, of_pixels_{};  // by property
};

}  // namespace strata::oracle::program
