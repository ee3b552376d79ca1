// tools/oracle/program/drawing/peels.cpp - a peel, pass by pass: each finds the next fragment beyond the depth that an
// earlier pass has stored, of another precision, another pass or another pixel (lookups.h).
//
// Source   Everitt 2001, Interactive order-independent transparency.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tools/oracle/program/drawing/lookups.h"

namespace strata::oracle::program {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// How the depths of a peel are stored.
struct PeelDepth {
    int bits = 0;  // 0: as they are; -1: halves
    bool truncates = false;
    bool is_of_both = false;  // those that are compared with it, too
    [[nodiscard]] double of(double v) const {
        if (bits == 0) return v;
        if (bits < 0) return stored(PortFormat::half, v);
        const double codes = std::exp2(bits) - 1;
        return (truncates ? std::floor(v * codes) : std::nearbyint(v * codes)) / codes;
    }
};

struct Peel {
    std::optional<Lookup> place{};  // none: the own pixel
    PeelDepth depth{};
    bool finds_again = false;  // what is at the stored depth passes the test
    bool is_from_back = false;
    int ago = 1;               // the depth is that of this many passes ago
    bool keeps_layer = false;  // of a pass that finds nothing the last layer is composited again
    bool takes_last = false;   // of equal depths the last drawn one stays
    bool keeps_ties = false;   // layers of equal depth codes are found one after the other
    std::size_t passes = 0;

    [[nodiscard]] double price() const {
        return 3 + (place ? price_of_lookup : 0) + (depth.bits != 0 ? 5 : 0) + (finds_again ? 2 : 0) +
               (is_from_back ? 2 : 0) + (ago != 1 ? 3 : 0) + (keeps_layer ? 2 : 0) + (takes_last ? 1 : 0) +
               (keeps_ties ? 1 : 0);
    }
    [[nodiscard]] std::string words(std::size_t most) const {
        std::string all = is_from_back ? "a peel from the back" : "a peel";
        const std::string_view stored = ago == 1 ? "the previous pass" : "an earlier pass";
        if (place) all += fmt::format(" compares with the depth of {} read {}", stored, place->words);
        if (depth.bits != 0)
            all += fmt::format(" {} depths {} {}", depth.is_of_both ? "compares" : "keeps",
                               depth.truncates ? "truncated to" : "rounded to",
                               depth.bits < 0 ? "halves" : fmt::format("{} bits", depth.bits));
        if (ago != 1) all += fmt::format(" compares with the depth of {} passes ago", ago);
        if (finds_again)
            all += fmt::format(" finds the {} layer again in every pass: the test is not strict",
                               is_from_back ? "farthest" : "nearest");
        if (keeps_layer) all += " composites the last layer again in every pass that finds none";
        if (passes != most) all += fmt::format(", in {} passes", passes);
        return all;
    }
    // The number of passes matters where layers are found again.
    [[nodiscard]] bool has_own_count() const { return finds_again || keeps_layer || depth.bits != 0 || ago != 1; }
};

// What each pass finds at each pixel.
class PeelRun {
  public:
    PeelRun(const PixelPlaces& places, const Peel& peel, std::size_t step)
        : places_{places}, peel_{peel}, shown_{step} {
        find_needed();
        const std::size_t count = places.lists().pixels.size();
        depths_.assign(static_cast<std::size_t>(peel.ago) + 1, std::vector<double>(count, start()));
        found_.resize(count);
    }

    Lists lists() && {
        const Lists& given = places_.lists();
        for (std::size_t pass = 0; pass < peel_.passes; ++pass) {
            std::vector<double>& written = depths_[pass % depths_.size()];
            const std::vector<double>& read = depths_[(pass + 1) % depths_.size()];
            for (const std::size_t i : needed_) written[i] = find(i, read);
        }
        Lists made = empty_like(given);
        for (std::size_t i = 0; i < given.pixels.size(); i += shown_) {
            const ListPixel& pixel = given.pixels[i];
            add_like(pixel, made);
            std::vector<std::size_t>& found = found_[i];
            if (peel_.is_from_back) std::ranges::reverse(found);
            for (const std::size_t k : found) made.fragments.push_back(pixel.fragments[k]);
        }
        complete(made, false);
        return made;
    }

  private:
    // Those that are shown, and those whose depths they read, pass by pass.
    void find_needed() {
        const std::vector<ListPixel>& pixels = places_.lists().pixels;
        std::vector<char> is_needed(pixels.size(), 0);
        for (std::size_t i = 0; i < pixels.size(); i += shown_) {
            std::size_t at = i;
            is_needed[at] = 1;
            for (std::size_t pass = 0; peel_.place && shown_ > 1 && pass < peel_.passes; ++pass) {
                places_.read(*peel_.place, pixels[at], taken_);
                if (taken_.empty()) break;
                at = taken_[0];
                is_needed[at] = 1;
            }
        }
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (is_needed[i] != 0) needed_.push_back(i);
    }
    [[nodiscard]] double start() const { return peel_.is_from_back ? infinity : -infinity; }

    // Equal codes are one depth, or are a hair apart.
    [[nodiscard]] double depth_of(const ListPixel& pixel, std::size_t k) const {
        std::size_t first = k;
        while (first > 0 && pixel.fragments[first - 1].code == pixel.fragments[k].code) --first;
        return pixel.fragments[first].depth + (peel_.keeps_ties ? 1e-12 * static_cast<double>(k - first) : 0);
    }

    // The depth that the pass stores: beyond all others if nothing is found.
    double find(std::size_t i, const std::vector<double>& read) {
        const ListPixel& pixel = places_.lists().pixels[i];
        double limit = read[i];
        if (peel_.place) {
            places_.read(*peel_.place, pixel, taken_);
            limit = taken_.empty() ? -start() : read[taken_[0]];
        }
        const double sign = peel_.is_from_back ? -1 : 1;
        const ListFragment* best = nullptr;
        double best_depth = infinity;
        double best_given = 0;
        for (std::size_t k = 0; k < pixel.fragments.size(); ++k) {
            const ListFragment& f = pixel.fragments[k];
            const double given = depth_of(pixel, k);
            const double own = sign * (peel_.depth.is_of_both ? peel_.depth.of(given) : given);
            if (!(peel_.finds_again ? own >= sign * limit : own > sign * limit)) continue;
            const bool is_later = best != nullptr && f.submission > best->submission;
            if (own < best_depth || (own == best_depth && is_later == peel_.takes_last)) {
                best = &f;
                best_depth = own;
                best_given = given;
            }
        }
        std::vector<std::size_t>& found = found_[i];
        if (best != nullptr) {
            found.push_back(static_cast<std::size_t>(best - pixel.fragments.data()));
            return peel_.depth.of(best_given);
        }
        if (peel_.keeps_layer && !found.empty()) found.push_back(found.back());
        return -start();
    }

    const PixelPlaces& places_;
    const Peel& peel_;
    std::size_t shown_;
    std::vector<std::size_t> needed_{};
    std::vector<std::vector<double>> depths_{};  // of the last passes
    std::vector<std::vector<std::size_t>> found_{};
    std::vector<std::size_t> taken_{};
};

// One thing is changed in each.
std::vector<Peel> changed_peels() {
    std::vector<Peel> all;
    for (const bool is_from_back : {false, true}) {
        const Peel peel{.is_from_back = is_from_back};
        const auto add = [&](auto change) { change(all.emplace_back(peel)); };
        add([](Peel& p) { p.finds_again = true; });
        add([](Peel& p) { p.keeps_layer = true; });
        for (const int ago : {2, 3}) add([&](Peel& p) { p.ago = ago; });
        for (const Lookup& lookup : lookups())
            if (!lookup.is_filtered) add([&](Peel& p) { p.place = lookup; });
        for (const int bits : {-1, 8, 10, 12, 14, 15, 16, 20, 24})
            for (const bool truncates : {false, true}) {
                if (bits < 0 && truncates) continue;
                add([&](Peel& p) { p.depth = {bits, truncates, false}; });
                add([&](Peel& p) { p.depth = {bits, truncates, true}; });
                add([&](Peel& p) {
                    p.depth = {bits, truncates, true};
                    p.takes_last = true;
                });
            }
    }
    return all;
}

}  // namespace

std::vector<OtherLists> other_peels(const Lists& given) {
    CheapLists cheap{given};
    const PixelPlaces places{given};
    std::size_t most = 0;
    for (const ListPixel& pixel : given.pixels) most = std::max(most, pixel.fragments.size());
    const auto is_tried = [&](const Peel& peel) {
        return cheap.add(peel.words(most), peel.price() + (peel.passes == most ? 0 : 4), [&](std::size_t step) {
            return PeelRun{places, peel, step}.lists();
        });
    };
    for (Peel peel : changed_peels()) {
        peel.passes = most;
        if (!is_tried(peel)) continue;
        if (peel.place && peel.place->moves()) {
            peel.place->clamps = false;
            is_tried(peel);
        }
        if (peel.depth.bits == 0) {
            peel.keeps_ties = true;
            is_tried(peel);
        }
        if (!peel.has_own_count()) continue;
        for (const std::size_t count :
             {most + 1, most - 1, std::size_t{4}, std::size_t{8}, std::size_t{16}, std::size_t{32}}) {
            peel.passes = count;
            if (count != most) is_tried(peel);
        }
    }
    return std::move(cheap).best();
}

}  // namespace strata::oracle::program
