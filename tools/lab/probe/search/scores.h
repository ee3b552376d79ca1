// tools/lab/probe/search/scores.h - scores profiles by how well they explain a device's answers; each scene is drawn
// once for all profiles that draw it identically.
//
// Rule     Two profiles draw a scene identically if they agree in every field that has an effect under them (fields.h)
//          and can change the scene.
// Tests    tests/tools/lab/probe/search_test.cpp
#pragma once
#include <map>
#include <memory_resource>

#include "tools/lab/probe/search/comparison.h"

namespace strata::probe {

using Numbers = std::vector<std::size_t>;

class Scores {
  public:
    // The comparison must outlive it.
    explicit Scores(const KitComparison& device);

    [[nodiscard]] const KitComparison& device() const noexcept { return device_; }
    // Points of a part of one scene; `equal` counts the positions that agree.
    [[nodiscard]] const Nearness& of(const DeviceProfile& profile, std::size_t number);
    [[nodiscard]] std::uint64_t points(const DeviceProfile& profile, std::size_t number, Part part);
    // The sum over these scenes if it is more than `bar`; otherwise any number that is not.
    [[nodiscard]] std::uint64_t points(const DeviceProfile& profile, const Numbers& numbers, Part part,
                                       std::uint64_t bar = 0);
    [[nodiscard]] std::uint64_t most(std::size_t number, Part part) const;
    [[nodiscard]] std::uint64_t most(const Numbers& numbers, Part part) const;
    [[nodiscard]] bool can_change(std::string_view key, std::size_t number) const;

    // Number of scenes drawn so far.
    [[nodiscard]] std::size_t drawn() const noexcept { return drawn_; }

  private:
    const KitComparison& device_;
    // Per scene, the fields that can change it, then the results by their values.
    std::vector<std::vector<const ProfileField*>> fields_{};
    // In a memory resource of its own: small permanent allocations between the temporary buffers of drawing fragment
    // the heap of glibc 2.36, which would waste 100 KB per scene.
    std::pmr::monotonic_buffer_resource memory_{std::size_t{1} << 20};
    std::vector<std::pmr::map<std::pmr::vector<int>, Nearness>> known_{};
    std::size_t drawn_ = 0;
    // The driver reports float depth buffers but draws none: such a device has the depth path window_z.
    bool refuses_float_depth_ = false;
};

}  // namespace strata::probe
