// tools/oracle/program/lists.cpp - fills the lists from a scene's fragments, and orders equal depths (lists.h).
#include "tools/oracle/program/lists.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/fragments/coverages.h"
#include "tools/oracle/fragments/sample.h"

namespace strata::oracle::program {

namespace {

Color colors_of(const Rgba& c) { return {double{c[0]}, double{c[1]}, double{c[2]}}; }

void add(Lists& lists, const verdict::PixelList& list, const std::array<double, 4>& seen) {
    lists.pixels.push_back({.x = list.x,
                            .y = list.y,
                            .first = lists.fragments.size(),
                            .behind = colors_of(list.behind),
                            .has_opaque = list.has_opaque,
                            .opaque_code = list.opaque,
                            .seen = {seen[0], seen[1], seen[2]}});
    for (const verdict::Fragment& f : list.visible) lists.fragments.push_back(list_fragment(f, list.visible));
}

Color composite_of(std::span<const verdict::Fragment> visible, const Rgba& behind) {
    Color color{};
    double through = 1;
    for (const verdict::Fragment& f : visible) {
        const double alpha = std::clamp(double{f.color[3]}, 0.0, 1.0);
        for (std::size_t c = 0; c < 3; ++c) color[c] += through * alpha * double{f.color[c]};
        through *= 1 - alpha;
    }
    for (std::size_t c = 0; c < 3; ++c) color[c] += through * double{behind[c]};
    return color;
}

// True if only the fragments of another rasterizer come near the candidate's colour: such a pixel shows no mistake.
bool is_covered_otherwise(const verdict::PixelList& list, const std::array<double, 4>& seen) {
    if (list.edge == nullptr) return false;
    const auto is_near = [&](std::span<const verdict::Fragment> visible, const Rgba& behind) {
        const double most = (1.5 + static_cast<double>(visible.size()) / 2) / 255;
        const Color color = composite_of(visible, behind);
        return std::fabs(color[0] - seen[0]) <= most && std::fabs(color[1] - seen[1]) <= most &&
               std::fabs(color[2] - seen[2]) <= most;
    };
    return !is_near(list.visible, list.behind) && std::ranges::any_of(list.edge->others, [&](const auto& other) {
        return is_near(other.visible, other.behind);
    });
}

// What becomes of a group of equal codes: all of it, one of it, or the MAX of each channel.
enum class Group { given, reversed, first, last, largest_premultiplied, largest_straight };

ListFragment largest_of(std::span<const ListFragment> group, bool is_straight) {
    ListFragment made = group.front();
    Color largest{};
    for (const ListFragment& f : group) {
        made.alpha = std::max(made.alpha, f.alpha);
        for (std::size_t c = 0; c < 3; ++c) largest[c] = std::max(largest[c], f.color[c] * (is_straight ? 1 : f.alpha));
    }
    for (std::size_t c = 0; c < 3; ++c)
        made.color[c] = is_straight ? largest[c] : made.alpha > 0 ? largest[c] / made.alpha : 0;
    return made;
}

// The list with what is left of each group, of the nearer half of the groups and of the farther.
std::vector<ListFragment> with_groups(std::span<const ListFragment> given, Group near, Group far) {
    std::vector<std::span<const ListFragment>> groups;
    for (std::size_t i = 0, end = 0; i < given.size(); i = end) {
        end = i + 1;
        while (end < given.size() && given[end].code == given[i].code) ++end;
        groups.push_back(given.subspan(i, end - i));
    }
    std::vector<ListFragment> made;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto group = groups[g];
        switch (2 * g < groups.size() ? near : far) {
            case Group::given: made.insert(made.end(), group.begin(), group.end()); break;
            case Group::reversed: made.insert(made.end(), group.rbegin(), group.rend()); break;
            case Group::first: made.push_back(group.front()); break;
            case Group::last: made.push_back(group.back()); break;
            case Group::largest_premultiplied: made.push_back(largest_of(group, false)); break;
            case Group::largest_straight: made.push_back(largest_of(group, true)); break;
        }
    }
    return made;
}

void find_ties(ListPixel& pixel) {
    const std::span<const ListFragment> all = pixel.fragments;
    if (std::ranges::adjacent_find(all, {}, &ListFragment::code) == all.end()) return;
    using enum Group;
    for (const auto& [near, far] :
         {std::pair{reversed, reversed}, std::pair{given, reversed}, std::pair{first, first}, std::pair{last, last},
          std::pair{largest_premultiplied, largest_straight}, std::pair{largest_premultiplied, largest_premultiplied}})
        pixel.ties.push_back(with_groups(all, near, far));
}

void set_triangle_depths(Lists& lists) {
    struct Sum {
        double depth = 0, count = 0;
    };
    std::vector<Sum> sums;
    for (const ListFragment& f : lists.fragments) {
        if (f.primitive >= sums.size()) sums.resize(f.primitive + 1);
        sums[f.primitive].depth += f.depth;
        sums[f.primitive].count += 1;
    }
    for (ListFragment& f : lists.fragments) f.triangle_depth = sums[f.primitive].depth / sums[f.primitive].count;
}

// A background halfway between two codes, as 0.3 in 8 bits, is stored as one of them by all blends of a port. It is
// moved by a hair to the side that pixels without layers show, or up.
void settle_background(Lists& lists) {
    if (lists.format == PortFormat::exact || lists.format == PortFormat::half) return;
    const double codes = codes_of(lists.format), hair = 2e-3 / codes;
    Color side{1, 1, 1};
    for (const ListPixel& pixel : lists.pixels)
        if (pixel.fragments.empty() && !pixel.has_opaque)
            for (std::size_t c = 0; c < 3; ++c) {
                const double off = (pixel.seen[c] - pixel.behind[c]) * codes;
                side[c] = -1 < off && off < 0 ? -1 : 1;
            }
    for (ListPixel& pixel : lists.pixels)
        for (std::size_t c = 0; c < 3 && !pixel.has_opaque; ++c) {
            const double code = pixel.behind[c] * codes, part = code - std::floor(code);
            if (std::fabs(part - 0.5) < 1e-3) pixel.behind[c] += side[c] * hair;
        }
}

}  // namespace

ListFragment list_fragment(const verdict::Fragment& f, std::span<const verdict::Fragment> of) {
    const auto before =
        std::ranges::count_if(of, [&](const verdict::Fragment& other) { return other.primitive < f.primitive; });
    return {.color = colors_of(f.color),
            .alpha = std::clamp(double{f.color[3]}, 0.0, 1.0),
            .depth = double{f.shader_z},
            .code = f.code,
            .submission = static_cast<std::uint32_t>(before),
            .primitive = f.primitive,
            .instance = f.instance,
            .material = f.material,
            .is_front_facing = f.is_front_facing};
}

void complete(Lists& lists, bool is_tied) {
    for (std::size_t i = 0; i < lists.pixels.size(); ++i) {
        const std::size_t first = lists.pixels[i].first;
        const std::size_t end = i + 1 < lists.pixels.size() ? lists.pixels[i + 1].first : lists.fragments.size();
        lists.pixels[i].fragments = std::span<const ListFragment>{lists.fragments}.subspan(first, end - first);
    }
    settle_background(lists);
    set_triangle_depths(lists);
    if (is_tied)
        for (ListPixel& pixel : lists.pixels) find_ties(pixel);
}

Lists lists_of(const verdict::SceneFragments& scene, const verdict::Colors& candidate, bool has_all_pixels) {
    Lists lists;
    lists.width = candidate.width();
    lists.height = candidate.height();
    for (int row = 0; row < scene.height(); ++row)
        for (int x = 0; x < scene.width(); ++x) {
            const verdict::PixelList list = scene.list_at(x, row);
            const std::array<double, 4> seen = candidate.at(list.x, list.y);
            if (has_all_pixels || !is_covered_otherwise(list, seen)) add(lists, list, seen);
        }
    std::vector<double> seen;
    for (const ListPixel& pixel : lists.pixels) seen.insert(seen.end(), pixel.seen.begin(), pixel.seen.end());
    lists.format = narrowest(seen);
    complete(lists);
    return lists;
}

}  // namespace strata::oracle::program
