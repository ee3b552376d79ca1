// tools/oracle/fragments/sample.h - a sample of pixels, each with its fragments and the candidate's colour.
//
// Rule     The selection depends only on the pixels' positions, so it is the same on every computer.
#pragma once
#include <array>
#include <deque>
#include <vector>

#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle::verdict {

// How the channels of a target are used.
struct ChannelUse {
    bool is_divided = false;  // the file has straight colours, and the target has them multiplied by alpha again
    bool has_alpha = true;    // false: alpha is not compared
    bool is_encoded = false;  // the file holds sRGB codes of a frame of linear values (resolved.h)
};

// The colours of a candidate, row by row from the top; grey is used for all three colour channels.
class Colors {
  public:
    explicit Colors(const TargetImage& target, const ChannelUse& use = {});
    [[nodiscard]] const TargetImage& target() const noexcept { return *target_; }
    [[nodiscard]] int width() const noexcept { return target_->width; }
    [[nodiscard]] int height() const noexcept { return target_->height; }
    [[nodiscard]] Code code() const noexcept { return target_->code; }
    [[nodiscard]] const ChannelUse& use() const noexcept { return use_; }
    [[nodiscard]] bool has_alpha() const noexcept {
        return use_.has_alpha && (target_->channels == 2 || target_->channels == 4);
    }
    // Red, green, blue, and always 1: alpha is compared separately (alpha.h).
    [[nodiscard]] std::array<double, 4> at(int x, int y) const noexcept;
    // 1 if the candidate has no alpha.
    [[nodiscard]] double alpha_at(int x, int y) const noexcept;

  private:
    [[nodiscard]] double value(int x, int y, int channel) const noexcept;

    const TargetImage* target_;
    ChannelUse use_;
};

struct SampledPixel {
    std::vector<Fragment> fragments{};  // visible ones first
    PixelList list{};                   // its spans point into `fragments`
    std::array<double, 4> value{};      // the candidate's
};

class Sample {
  public:
    explicit Sample(const Setting& setting) : setting_{&setting} {}
    Sample(const Sample& other);  // the lists of the copy point into the copy
    Sample(Sample&&) noexcept = default;
    Sample& operator=(Sample&&) noexcept = default;
    ~Sample() = default;
    void add(const PixelList& list, const std::array<double, 4>& value);
    [[nodiscard]] bool has(int x, int y) const noexcept;
    [[nodiscard]] const std::deque<SampledPixel>& pixels() const noexcept { return pixels_; }
    // Sorts by rows from the top, because threads add pixels in any order.
    void sort();
    // About `most` of the pixels, at even distances.
    [[nodiscard]] Sample thinned(std::size_t most) const;
    // All pixels with few structures (ties and edges make many), and of the others as many as fit into a total of
    // `most` structures.
    [[nodiscard]] Sample with_few_structures(std::size_t most) const;
    [[nodiscard]] const Setting& setting() const noexcept { return *setting_; }

  private:
    const Setting* setting_;  // of the scene, which must outlive the sample
    std::deque<SampledPixel> pixels_{};
};

// About `most` pixels; the chance of a pixel grows with its number of fragments.
[[nodiscard]] Sample sampled(const SceneFragments& scene, const Colors& candidate, std::size_t most);

}  // namespace strata::oracle::verdict
