// tools/oracle/verdict/sample.h - pixels of a scene with their fragments and the candidate's colours: some, chosen
// evenly, or those that are added.
//
// Rule     The choice depends on pixels' places alone, so it is the same in every run and on every machine.
#pragma once
#include <array>
#include <deque>
#include <vector>

#include "tools/oracle/picture.h"
#include "tools/oracle/verdict/fragments.h"

namespace strata::oracle::verdict {

// The colours of a candidate, row by row from the top: values of red, green, blue and alpha; grey stands for three
// channels.
class Colors {
  public:
    explicit Colors(const Target& target);
    [[nodiscard]] const Target& target() const noexcept { return *target_; }
    [[nodiscard]] int width() const noexcept { return target_->width; }
    [[nodiscard]] int height() const noexcept { return target_->height; }
    [[nodiscard]] Code code() const noexcept { return target_->code; }
    [[nodiscard]] bool has_alpha() const noexcept { return target_->channels == 2 || target_->channels == 4; }
    // Alpha is 1 where there is none.
    [[nodiscard]] std::array<double, 4> at(int x, int y) const noexcept;

  private:
    const Target* target_;
};

struct SampledPixel {
    std::vector<Fragment> fragments{};  // visible ones first
    PixelList list{};                   // its spans are of `fragments`
    std::array<double, 4> value{};      // the candidate's
};

class Sample {
  public:
    explicit Sample(const Setting& setting) : setting_{&setting} {}
    Sample(const Sample& other);  // lists of the copy are its own
    Sample(Sample&&) noexcept = default;
    Sample& operator=(Sample&&) noexcept = default;
    ~Sample() = default;
    void add(const PixelList& list, const std::array<double, 4>& value);
    [[nodiscard]] bool has(int x, int y) const noexcept;
    [[nodiscard]] const std::deque<SampledPixel>& pixels() const noexcept { return pixels_; }
    // In rows from the top: threads add them in no order.
    void sort();
    // About `most` of them, evenly spread.
    [[nodiscard]] Sample thinned(std::size_t most) const;
    // Those whose structures are few (ties and edges make many of them), and of the others as many as `most` structures
    // allow.
    [[nodiscard]] Sample with_few_structures(std::size_t most) const;
    [[nodiscard]] const Setting& setting() const noexcept { return *setting_; }

  private:
    const Setting* setting_;  // the scene's, which outlives the sample
    std::deque<SampledPixel> pixels_{};
};

// About `most` pixels: those with fragments are preferred, and of these the ones with more.
[[nodiscard]] Sample sampled(const SceneFragments& scene, const Colors& candidate, std::size_t most);

}  // namespace strata::oracle::verdict
