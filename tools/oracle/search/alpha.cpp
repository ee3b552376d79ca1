// tools/oracle/search/alpha.cpp - decides whether a picture's alpha is right, a known alternative, or wrong, from the
// stacks that its colours have (alpha.h).
#include "tools/oracle/search/alpha.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>

#include "rasterizer/base/enum_values.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

// Returns the hypothesis with any source and any rounding, which allows an error of one code per blend.
Hypothesis loosened(Hypothesis h) {
    for (End* end : {&h.front, &h.back}) {
        end->source = SourceRounding::any;
        end->rounding = Rounding::any;
    }
    h.result.rounding = Rounding::any;
    return h;
}

// The error per layer of coverage stored as a float: relative to 1, even if the transmittance is small.
double error_of(const Hypothesis& h) noexcept {
    const auto is_half = [](const End& end) { return end.storage == Storage::half; };
    return is_half(h.front) || is_half(h.back) || is_half(h.result) ? 0x1p-10 : 0x1p-23;
}

// An alpha that a picture may have instead of the right one. `unknown` stands for the right one.
struct Alternative {
    AlphaMistake mistake = AlphaMistake::unknown;
    float background = 1;  // its alpha
};

// Alpha that is blended by SRC_ALPHA gives what a colour channel equal to alpha gives.
Stack with_alpha_as_red(Stack stack) {
    for (Layer& layer : stack.layers) layer.color[0] = layer.color[3];
    stack.background[0] = stack.background[3];
    return stack;
}

}  // namespace

AlphaReach::AlphaReach(const Hypothesis& colors) : compositor_{loosened(colors)}, error_{error_of(colors)} {}

Interval AlphaReach::with_error(const Interval& alpha, const Stack& stack) const {
    const double error = static_cast<double>(stack.layers.size() + 1) * error_;
    return {alpha.low - error, alpha.high + error};
}

Interval AlphaReach::of(const Stack& stack) const { return with_error(compositor_.reach(stack)[3], stack); }

Interval AlphaReach::weighted_by_itself(const Stack& stack) const {
    return with_error(compositor_.reach(with_alpha_as_red(stack))[0], stack);
}

namespace {

class AlphaChecker {
  public:
    AlphaChecker(const SceneFragments& scene, const Colors& candidate, const Hypothesis& colors)
        : scene_{scene}, candidate_{candidate}, reach_{colors} {}

    // The pixels with another alpha, ascending; at most `most` per tile.
    [[nodiscard]] std::vector<std::uint32_t> wrong(const Alternative& alternative, std::size_t most) const {
        std::vector<std::uint32_t> all;
        std::mutex mutex;
        scene_.for_each_tile([&](const TileLists& tile) {
            StackMaker maker{scene_.setting()};
            std::vector<std::uint32_t> here;
            std::optional<double> blank;  // the alpha of a right pixel where nothing is drawn: most have the same
            for (std::size_t p = 0; p < tile.rect.area() && here.size() < most; ++p) {
                const PixelList list = scene_.at(tile, p);
                const bool is_blank =
                    !list.has_opaque && list.visible.empty() && list.edge == nullptr && list.behind_spread == 0;
                const double alpha = candidate_.alpha_at(list.x, list.y);
                if (is_blank && blank == alpha) continue;
                if (!can_be(list, alternative, maker))
                    here.push_back(static_cast<std::uint32_t>(list.y * scene_.width() + list.x));
                else if (is_blank)
                    blank = alpha;
            }
            const std::scoped_lock lock{mutex};
            all.insert(all.end(), here.begin(), here.end());
        });
        std::ranges::sort(all);
        return all;
    }
    [[nodiscard]] bool is_everywhere(const Alternative& alternative) const { return wrong(alternative, 1).empty(); }

  private:
    [[nodiscard]] bool can_be(const PixelList& list, const Alternative& alternative, StackMaker& maker) const {
        const bool has_background = !list.has_opaque;
        const auto is_reached = [&](Stack stack) {
            if (has_background) stack.background[3] = alternative.background;
            return reaches(stack, list, alternative.mistake);
        };
        if (is_reached(maker.right(list, {}))) return true;
        const StackedPixel all = stacked({}, {.list = list}, maker);  // ties and edges
        return std::ranges::any_of(all.stacks, is_reached);
    }

    [[nodiscard]] bool reaches(const Stack& stack, const PixelList& list, AlphaMistake mistake) const {
        const double given = candidate_.alpha_at(list.x, list.y);
        const double alpha = mistake == AlphaMistake::inverted ? 1 - given : given;
        const bool is_weighted = mistake == AlphaMistake::weighted_by_itself;
        return (is_weighted ? reach_.weighted_by_itself(stack) : reach_.of(stack)).holds(alpha);
    }

    const SceneFragments& scene_;
    const Colors& candidate_;
    AlphaReach reach_;
};

// The candidate's alpha where nothing is drawn, if it is a single value.
std::optional<float> seen_alpha(const SceneFragments& scene, const Colors& candidate) {
    std::mutex mutex;
    std::optional<double> alpha;
    bool is_one = true;
    scene.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            if (!list.visible.empty() || list.has_opaque || list.edge != nullptr) continue;
            const double value = candidate.alpha_at(list.x, list.y);
            const std::scoped_lock lock{mutex};
            if (!alpha) alpha = value;
            is_one = is_one && value == *alpha;
        }
    });
    return alpha && is_one ? std::optional{static_cast<float>(*alpha)} : std::nullopt;
}

}  // namespace

bool is_everywhere(const Colors& candidate, double alpha) {
    for (int y = 0; y < candidate.height(); ++y)
        for (int x = 0; x < candidate.width(); ++x)
            if (candidate.alpha_at(x, y) != alpha) return false;
    return true;
}

namespace {

void name_mistake(const SceneFragments& scene, const Colors& candidate, const AlphaChecker& checker,
                  AlphaChecked& found) {
    const float given = scene.setting().cleared[3], seen = seen_alpha(scene, candidate).value_or(0.0f);
    const auto is_it = [&](AlphaMistake mistake, float background) {
        if (!checker.is_everywhere({mistake, background})) return false;
        found.mistake = mistake;
        found.background = background;
        return true;
    };
    using enum AlphaMistake;
    if (is_everywhere(candidate, 0)) {
        found.mistake = unwritten;
        return;
    }
    if (seen != given && is_it(other_background, seen)) return;
    for (const float background : {given, 1 - seen})
        if (is_it(inverted, background)) return;
    for (const float background : {given, seen})
        if (is_it(weighted_by_itself, background)) return;
}

}  // namespace

AlphaChecked check_alpha(const SceneFragments& scene, const Colors& candidate, const Hypothesis& colors) {
    const float background = scene.setting().cleared[3];
    AlphaChecked found{.background = background, .is_told = background < 1};
    if (!candidate.has_alpha()) return found;
    const AlphaChecker checker{scene, candidate, colors};
    found.wrong_pixels = checker.wrong({AlphaMistake::unknown, background}, std::numeric_limits<std::size_t>::max());
    if (found.wrong_pixels.empty()) {
        found.state = AlphaState::right;
    } else if (is_everywhere(candidate, 1)) {
        found.state = AlphaState::opaque;
        found.wrong_pixels.clear();
    } else {
        found.state = AlphaState::wrong;
        found.is_told = true;
        name_mistake(scene, candidate, checker, found);
    }
    return found;
}

std::string describe(const AlphaChecked& alpha) {
    if (!alpha.is_told) return "";
    switch (alpha.state) {
        case AlphaState::absent: return "there is no alpha to compare";
        case AlphaState::opaque: return "alpha is 1 everywhere, as on an opaque canvas: there is none to compare";
        case AlphaState::right: return "alpha is right at all pixels";
        case AlphaState::wrong: break;
    }
    switch (alpha.mistake) {
        case AlphaMistake::unknown: return "no known mistake explains the alpha";
        case AlphaMistake::other_background:
            return fmt::format("alpha is right over a background of alpha {:.3g}: --background R,G,B,A states one",
                               alpha.background);
        case AlphaMistake::weighted_by_itself:
            return "alpha is blended by SRC_ALPHA and ONE_MINUS_SRC_ALPHA, as colours are; right is ONE for SRC_ALPHA";
        case AlphaMistake::inverted: return "alpha holds the transmittance; the right value is 1 - alpha";
        case AlphaMistake::unwritten: break;
    }
    return "alpha is 0 everywhere: nothing writes it";
}

std::string_view name(AlphaState state) noexcept { return enum_name(state); }

std::string_view name(AlphaMistake mistake) noexcept { return enum_name(mistake); }

}  // namespace strata::oracle::verdict
