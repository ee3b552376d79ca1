// tools/lab/probe/search/comparison.h - compares a device's answers with those of a profile, pixel by pixel.
//
// Rule     A pixel's colour agrees if all of its codes do, a depth if its code does; each counts as one pixel. All NaNs
//          of float targets are equal, because a profile has no rule for the payload that an operation returns.
// Tests    tests/tools/lab/probe/infer_test.cpp
#pragma once
#include <string_view>
#include <vector>

#include "tools/lab/probe/files/pack.h"
#include "tools/lab/probe/search/fields.h"

namespace strata::probe {

struct Tally {
    std::uint64_t equal = 0, all = 0;
    friend bool operator==(const Tally&, const Tally&) = default;
    Tally& operator+=(const Tally& o) noexcept {
        equal += o.equal;
        all += o.all;
        return *this;
    }
};

// Every pixel's colour, then every depth: true if the two answers have the same bits.
[[nodiscard]] std::vector<bool> equal_values(const Answer& a, const Answer& b);

// The numbers of pixels of two answers that differ. A pixel is covered if its depth is not the cleared one, or, without
// a depth buffer, its colour.
struct Difference {
    std::uint64_t pixels = 0, coverage = 0, depth = 0, color = 0;
    Difference& operator+=(const Difference& o) noexcept {
        pixels += o.pixels;
        coverage += o.coverage;
        depth += o.depth;
        color += o.color;
        return *this;
    }
    [[nodiscard]] bool is_none() const noexcept { return coverage + depth + color == 0; }
};
[[nodiscard]] Difference difference(const Answer& a, const Answer& b);

// The similarity of two answers: a position that agrees counts most_points, another one less, the more bits its code is
// off. So a search moves towards the right value while another field still makes every code wrong. The coverage is that
// of `difference`.
struct Nearness {
    std::uint64_t coverage = 0, depth = 0, color = 0, equal = 0, places = 0;
};
inline constexpr int most_points = 40;
[[nodiscard]] Nearness nearness(const Answer& a, const Answer& b);

class KitComparison {
  public:
    // `pack` and `items` must outlive it.
    KitComparison(const ProbePack& pack, const std::vector<Item>& items, YDirection y);

    // Answered items whose names begin with the first prefix, in the kit's order, then those of the next.
    [[nodiscard]] std::vector<std::size_t> items_of(const std::vector<std::string_view>& beginnings) const;
    [[nodiscard]] const Answer& answer(std::size_t number) const noexcept { return *items_[number].answer; }
    [[nodiscard]] const Item& item(std::size_t number) const noexcept { return *items_[number].item; }
    [[nodiscard]] std::size_t count() const noexcept { return items_.size(); }

    // The reply of a device with this profile. equal: where it agrees with the device's answer; all false if the
    // profile refuses what the device drew.
    [[nodiscard]] Reply drawn(const DeviceProfile& profile, std::size_t number) const;
    [[nodiscard]] std::vector<bool> equal(const Reply& drawn, std::size_t number) const;
    [[nodiscard]] Tally tally(const DeviceProfile& profile, const std::vector<std::size_t>& numbers) const;
    // True if the driver reports float depth buffers.
    [[nodiscard]] bool reports_float_depth() const noexcept { return reports_float_depth_; }
    [[nodiscard]] YDirection orientation() const noexcept { return y_; }

  private:
    struct Answered {
        const Item* item;
        const Answer* answer;
    };
    std::vector<Answered> items_{};
    YDirection y_;
    bool reports_float_depth_ = false;
};

}  // namespace strata::probe
