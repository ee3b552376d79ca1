#include "tools/oracle/rules/distinguish_rules.h"

#include <algorithm>
#include <mutex>

#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

bool is_of_any_scene(const std::vector<Rule>& rules) noexcept {
    return std::ranges::none_of(rules,
                                [](const Rule& r) { return r.scope == Scope::instance || r.scope == Scope::material; });
}

namespace {

bool are_apart(const ReachableColor& a, const ReachableColor& b) noexcept {
    constexpr double seen = 2.0 / 255;
    for (std::size_t c = 0; c < 3; ++c)
        if (a[c].low > b[c].high + seen || b[c].low > a[c].high + seen) return true;
    return false;
}

}  // namespace

bool distinguishes(const SceneFragments& scene, const std::vector<std::vector<Rule>>& all) {
    std::vector<std::vector<Rule>> ports = all;
    ports.emplace_back();  // the right structure
    const End end{Storage::unorm8, SourceRounding::stored, Rounding::nearest};
    const Compositor compositor{{.order = Order::under, .front = end, .back = end, .result = end}};
    const std::size_t n = ports.size();
    std::vector<bool> apart(n * n);
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        StackMaker maker{scene.setting()};
        std::vector<bool> own(n * n);
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            std::vector<ReachableColor> reaches;
            for (const auto& rules : ports) reaches.push_back(compositor.reach(maker.with(rules, list, {})));
            for (std::size_t a = 0; a < n; ++a)
                for (std::size_t b = a + 1; b < n; ++b)
                    own[a * n + b] = own[a * n + b] || are_apart(reaches[a], reaches[b]);
        }
        const std::scoped_lock lock{mutex};
        for (std::size_t i = 0; i < own.size(); ++i) apart[i] = apart[i] || own[i];
    });
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = a + 1; b < n; ++b)
            if (!apart[a * n + b]) return false;
    return true;
}

}  // namespace strata::oracle::verdict
