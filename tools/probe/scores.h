// tools/probe/scores.h - how well profiles explain a device's answers, each scene drawn once for all profiles that draw
// it alike.
//
// Rule     Two profiles draw a scene alike if they agree in every field that matters under them (fields.h) and can
//          change it.
// Tests    tests/tools/probe/search_test.cpp
#pragma once
#include <map>
#include <memory_resource>

#include "tools/probe/comparison.h"

namespace strata::probe {

using Numbers = std::vector<std::size_t>;

class Scores {
  public:
    // The comparison outlives it.
    explicit Scores(const Comparison& device);

    [[nodiscard]] const Comparison& device() const noexcept { return device_; }
    // Points of one scene's part; of `equal` the places that agree.
    [[nodiscard]] const Nearness& of(const DeviceProfile& profile, std::size_t number);
    [[nodiscard]] std::uint64_t points(const DeviceProfile& profile, std::size_t number, Part part);
    // Of all these scenes, if it is more than `bar`; otherwise any number that is not.
    [[nodiscard]] std::uint64_t points(const DeviceProfile& profile, const Numbers& numbers, Part part,
                                       std::uint64_t bar = 0);
    [[nodiscard]] std::uint64_t most(std::size_t number, Part part) const;
    [[nodiscard]] std::uint64_t most(const Numbers& numbers, Part part) const;
    [[nodiscard]] bool can_change(std::string_view key, std::size_t number) const;

    // Scenes that were drawn so far.
    [[nodiscard]] std::size_t drawn() const noexcept { return drawn_; }

  private:
    const Comparison& device_;
    // For every scene the fields that can change it, then what is known of it by their values.
    std::vector<std::vector<const ProfileField*>> fields_{};
    // All of it in memory of its own: small pieces that stay, between the buffers of drawing that come and go, break up
    // the heap of glibc 2.36 so that 100 KB a scene are lost.
    std::pmr::monotonic_buffer_resource memory_{std::size_t{1} << 20};
    std::vector<std::pmr::map<std::pmr::vector<int>, Nearness>> known_{};
    std::size_t drawn_ = 0;
    // It says that it has float depth buffers, and draws into none: as a device whose depth path is window_z.
    bool refuses_float_depth_ = false;
};

}  // namespace strata::probe
