// tools/oracle/program/drawing/lookups.cpp - the table of places, and layers that are read there (lookups.h).
#include "tools/oracle/program/drawing/lookups.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/oracle/program/fit/score.h"

namespace strata::oracle::program {

namespace {

const Lookup table[] = {
    {.words = "upside down", .mirrors_y = true},
    {.words = "mirrored", .mirrors_x = true},
    {.words = "turned by half a turn", .mirrors_x = true, .mirrors_y = true},
    {.words = "at the first pixel of each block of 2 x 2", .is_half_size = true},
    {.words = "half a texel to the left and up, filtered", .right = -1, .down = -1, .is_filtered = true},
    {.words = "half a texel to the right and down, filtered", .right = 1, .down = 1, .is_filtered = true},
    {.words = "half a texel to the left and down, filtered", .right = -1, .down = 1, .is_filtered = true},
    {.words = "half a texel to the right and up, filtered", .right = 1, .down = -1, .is_filtered = true},
    {.words = "half a texel to the left, filtered", .right = -1, .is_filtered = true},
    {.words = "half a texel to the right, filtered", .right = 1, .is_filtered = true},
    {.words = "half a texel up, filtered", .down = -1, .is_filtered = true},
    {.words = "half a texel down, filtered", .down = 1, .is_filtered = true},
    {.words = "one pixel to the left", .right = -1},
    {.words = "one pixel to the right", .right = 1},
    {.words = "one pixel above", .down = -1},
    {.words = "one pixel below", .down = 1},
    {.words = "one pixel to the left and above", .right = -1, .down = -1},
    {.words = "one pixel to the right and below", .right = 1, .down = 1},
    {.words = "one pixel to the left and below", .right = -1, .down = 1},
    {.words = "one pixel to the right and above", .right = 1, .down = -1},
    {.words = "two pixels to the left", .right = -2},
    {.words = "two pixels to the right", .right = 2},
    {.words = "two pixels above", .down = -2},
    {.words = "two pixels below", .down = 2},
};

}  // namespace

std::span<const Lookup> lookups() { return table; }

void PixelPlaces::read(const Lookup& lookup, const ListPixel& pixel, std::vector<std::size_t>& found) const {
    found.clear();
    const int width = lists_->width, height = lists_->height;
    const auto add = [&](int x, int y) {
        const int cx = std::clamp(x, 0, width - 1), cy = std::clamp(y, 0, height - 1);
        if (!lookup.clamps && (cx != x || cy != y)) return;
        const int row = lists_->pixels[0].y == 0 ? cy : height - 1 - cy;
        found.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(cx));
    };
    int x = lookup.mirrors_x ? width - 1 - pixel.x : pixel.x, y = lookup.mirrors_y ? height - 1 - pixel.y : pixel.y;
    if (lookup.is_half_size) {
        x -= x % 2;
        y -= y % 2;
    }
    add(x + lookup.right, y + lookup.down);
    if (!lookup.is_filtered) return;
    if (lookup.right != 0) add(x, y + lookup.down);
    if (lookup.down != 0) add(x + lookup.right, y);
    if (lookup.right != 0 && lookup.down != 0) add(x, y);
}

double PixelPlaces::weight(const Lookup& lookup) noexcept {
    if (!lookup.is_filtered) return 1;
    return lookup.right != 0 && lookup.down != 0 ? 0.25 : 0.5;
}

CheapLists::CheapLists(const Lists& given) : coarse_{some_of(given, 800)}, fine_{some_of(given, 4000)} {}

CheapLists::Some CheapLists::some_of(const Lists& given, std::size_t pixels) {
    Some some{.step = given.pixels.size() / pixels | 1};
    for (std::size_t i = 0; i < given.pixels.size(); i += some.step)
        some.right += bits_of(residual_of({}, given.pixels[i], {}, given.unit()).off);
    return some;
}

double CheapLists::cost_of(const Lists& lists) const {
    double cost = 0;
    for (const ListPixel& pixel : lists.pixels) cost += bits_of(residual_of({}, pixel, {}, lists.unit()).off);
    return cost;
}

namespace {
constexpr std::size_t most_cheap = 4;
}

bool CheapLists::is_kept(double cost) const {
    constexpr double some = 0.7;  // of the right drawing's
    return cost < some * fine_.right && (kept_.size() < most_cheap || cost < kept_.back().first);
}

void CheapLists::keep(double cost, OtherLists lists) {
    const auto at = std::ranges::find_if(kept_, [&](const auto& k) { return cost < k.first; });
    kept_.insert(at, {cost, std::move(lists)});
    if (kept_.size() > most_cheap) kept_.pop_back();
}

std::vector<OtherLists> CheapLists::best() && {
    std::vector<OtherLists> all;
    for (auto& [cost, lists] : kept_)
        if (cost < 2 * kept_.front().first + 20) all.push_back(std::move(lists));
    return all;
}

namespace {

const LayerChoice choices[] = {
    {"all layers", 2, false, [](const ListPixel&, std::size_t) { return true; }},
    {"the nearest layer", 3, true, [](const ListPixel&, std::size_t k) { return k == 0; }},
    {"all layers but the nearest", 3, false, [](const ListPixel&, std::size_t k) { return k > 0; }},
    {"the farthest layer", 4, true, [](const ListPixel& p, std::size_t k) { return k + 1 == p.fragments.size(); }},
    {"all layers but the farthest", 4, false,
     [](const ListPixel& p, std::size_t k) { return k + 1 < p.fragments.size(); }},
    {"every second layer, from the second on,", 4, true, [](const ListPixel&, std::size_t k) { return k % 2 == 1; }},
    {"every second layer, from the nearest on,", 4, true, [](const ListPixel&, std::size_t k) { return k % 2 == 0; }},
};

}  // namespace

std::span<const LayerChoice> layer_choices() { return choices; }

Lists empty_like(const Lists& given) {
    Lists made;
    made.width = given.width;
    made.height = given.height;
    made.format = given.format;
    return made;
}

ListPixel& add_like(const ListPixel& pixel, Lists& made) {
    return made.pixels.emplace_back(ListPixel{.x = pixel.x,
                                              .y = pixel.y,
                                              .first = made.fragments.size(),
                                              .behind = pixel.behind,
                                              .has_opaque = pixel.has_opaque,
                                              .opaque_code = pixel.opaque_code,
                                              .seen = pixel.seen});
}

namespace {

// The layer of a rank, as it is read; alpha 0 if there is none.
ListFragment layer_at(const PixelPlaces& places, const std::vector<std::size_t>& read, double weight,
                      std::size_t rank) {
    ListFragment made;
    Color sum{};
    for (const std::size_t i : read) {
        const ListPixel& pixel = places.lists().pixels[i];
        if (rank >= pixel.fragments.size()) continue;
        const ListFragment& f = pixel.fragments[rank];
        if (made.alpha == 0)
            made = {.depth = f.depth,
                    .code = f.code,
                    .submission = f.submission,
                    .primitive = f.primitive,
                    .instance = f.instance,
                    .material = f.material,
                    .is_front_facing = f.is_front_facing};
        made.alpha += weight * f.alpha;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * f.alpha * f.color[c];
    }
    for (std::size_t c = 0; c < 3 && made.alpha > 0; ++c) made.color[c] = sum[c] / made.alpha;
    return made;
}

// Without a choice what is behind the layers is read.
Lists read_by(const PixelPlaces& places, const Lookup& lookup, const LayerChoice* choice, std::size_t step) {
    const Lists& given = places.lists();
    Lists made = empty_like(given);
    const double weight = PixelPlaces::weight(lookup);
    std::vector<std::size_t> read;
    for (std::size_t i = 0; i < given.pixels.size(); i += step) {
        const ListPixel& pixel = given.pixels[i];
        places.read(lookup, pixel, read);
        ListPixel& to = add_like(pixel, made);
        if (choice == nullptr && !read.empty()) {
            to.behind = {};
            for (const std::size_t j : read)
                for (std::size_t c = 0; c < 3; ++c) to.behind[c] += weight * given.pixels[j].behind[c];
        }
        std::size_t most = pixel.fragments.size();
        for (const std::size_t j : read) most = std::max(most, given.pixels[j].fragments.size());
        for (std::size_t k = 0; k < most; ++k) {
            if (choice == nullptr || !choice->has(pixel, k)) {
                if (k < pixel.fragments.size()) made.fragments.push_back(pixel.fragments[k]);
            } else if (const ListFragment f = layer_at(places, read, weight, k); f.alpha > 0) {
                made.fragments.push_back(f);
            }
        }
    }
    complete(made, false);
    return made;
}

}  // namespace

std::vector<OtherLists> other_lookups(const Lists& given) {
    CheapLists cheap{given};
    const PixelPlaces places{given};
    const auto ask = [&](const Lookup& lookup, const LayerChoice* choice, const std::string& words, double price) {
        Lookup place = lookup;
        const auto make = [&](std::size_t step) { return read_by(places, place, choice, step); };
        if (!cheap.add(words, price + price_of_lookup, make) || !lookup.moves()) return;
        place.clamps = false;
        cheap.add(words, price + price_of_lookup, make);
    };
    for (const Lookup& lookup : lookups()) {
        for (const LayerChoice& choice : layer_choices())
            ask(lookup, &choice, fmt::format("{} {} read {}", choice.words, choice.is_one ? "is" : "are", lookup.words),
                choice.price);
        ask(lookup, nullptr, fmt::format("what is behind the layers is read {}", lookup.words), 4);
    }
    return std::move(cheap).best();
}

}  // namespace strata::oracle::program
