// tools/oracle/program/fit/at_random.cpp - solves wrong pixels one by one (at_random.h).
#include "tools/oracle/program/fit/at_random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

Color off_from(const Color& predicted, const ListPixel& pixel, const Color& seen, double unit) {
    ListPixel other{.seen = seen};
    other.fragments = pixel.fragments;
    return residual(predicted, other, unit);
}
bool is_within(const Color& off, const ListPixel& pixel) {
    return std::ranges::all_of(off, [&](double r) { return std::fabs(r) <= bound_at(pixel); });
}

// Which of two pixels' colours an edit of one or two fragments of the first one gives.
struct Solves {
    bool own = false, others = false;
    double bits = std::numeric_limits<double>::infinity();  // of its own, at least
};

Solves solves(const StepEntry& entry, const ListPixel& pixel, const Color& others, const PortRounding& rounding,
              double unit) {
    Solves found;
    const std::size_t count = pixel.fragments.size();
    std::vector<char> mask(count, 0);
    const auto ask = [&] {
        const Applied edit{&entry, {}, mask};
        const Color color = run({&edit, 1}, pixel, rounding);
        const Color own = off_from(color, pixel, pixel.seen, unit);
        found.own = found.own || is_within(own, pixel);
        found.others = found.others || is_within(off_from(color, pixel, others, unit), pixel);
        found.bits = std::min(found.bits, bits_of(own));
    };
    const bool has_pairs = entry.edit == list_entries()[0].edit;
    for (std::size_t k = 0; k < count; ++k) {
        mask[k] = 1;
        ask();
        for (std::size_t j = k + 1; has_pairs && j < count; ++j) {
            mask[j] = 1;
            ask();
            mask[j] = 0;
        }
        mask[k] = 0;
    }
    return found;
}

}  // namespace

std::vector<Proof> explained_at_random(const Lists& lists, const Fitness& right) {
    std::vector<const ListPixel*> wrong;
    std::uint64_t deep = 0;
    double bits_of_right = 0;
    for (const ListPixel& pixel : lists.pixels) {
        deep += pixel.fragments.size() > 1 ? 1 : 0;
        const Color off = residual_of({}, pixel, right.rounding, lists.unit()).off;
        if (is_within(off, pixel))
            bits_of_right += bits_of(off);
        else
            wrong.push_back(&pixel);
    }
    constexpr std::size_t fewest = 40, most_layers = 40;
    if (wrong.size() < fewest) return {};
    for (const StepEntry& entry : list_entries()) {
        if (entry.is_order || !entry.parameters.empty()) continue;
        std::uint64_t unsolved = 0, by_chance = 0;
        double bits = bits_of_right;
        const std::size_t most = wrong.size() / 50;
        for (std::size_t i = 0; i < wrong.size() && unsolved <= most; ++i) {
            if (wrong[i]->fragments.size() > most_layers) return {};
            const Color& others = wrong[(i + wrong.size() / 2) % wrong.size()]->seen;
            const Solves found = solves(entry, *wrong[i], others, right.rounding, lists.unit());
            unsolved += found.own ? 0 : 1;
            by_chance += found.others ? 1 : 0;
            bits += found.bits;
        }
        if (unsolved > most || 5 * by_chance > wrong.size()) continue;
        Proof proof{.fitness = right, .is_whole = true};
        proof.program.drawing = fmt::format(
            "at {} of {} pixels of several layers some fragments {}, and no property separates them: by chance, as in "
            "a race",
            wrong.size(), deep, entry.words);
        proof.fitness.beyond = unsolved;
        proof.fitness.bits = bits;
        return {proof};
    }
    return {};
}

}  // namespace strata::oracle::program
