// tools/oracle/program/lists.cpp - fills the lists from a scene's fragments, and orders equal depths (lists.h).
#include "tools/oracle/program/lists.h"

#include <algorithm>
#include <cmath>

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
                            .seen = {seen[0], seen[1], seen[2]}});
    for (const verdict::Fragment& f : list.visible) {
        const auto before = std::ranges::count_if(
            list.visible, [&](const verdict::Fragment& other) { return other.primitive < f.primitive; });
        lists.fragments.push_back({.color = colors_of(f.color),
                                   .alpha = std::clamp(double{f.color[3]}, 0.0, 1.0),
                                   .depth = double{f.shader_z},
                                   .code = f.code,
                                   .submission = static_cast<std::uint32_t>(before),
                                   .primitive = f.primitive,
                                   .instance = f.instance,
                                   .material = f.material,
                                   .is_front_facing = f.is_front_facing});
    }
}

// The list with every group of equal codes reversed; empty if there is none.
std::vector<ListFragment> with_reversed_ties(std::span<const ListFragment> given) {
    std::vector<ListFragment> other{given.begin(), given.end()};
    bool has_ties = false;
    for (std::size_t i = 0, end = 0; i < other.size(); i = end) {
        end = i + 1;
        while (end < other.size() && other[end].code == other[i].code) ++end;
        has_ties |= end - i > 1;
        std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i), other.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return has_ties ? other : std::vector<ListFragment>{};
}

void reverse_ties(Lists& lists) {
    std::vector<std::size_t> starts;
    for (const ListPixel& pixel : lists.pixels) {
        const std::vector<ListFragment> other = with_reversed_ties(pixel.fragments);
        starts.push_back(lists.reversed.size());
        lists.reversed.insert(lists.reversed.end(), other.begin(), other.end());
    }
    starts.push_back(lists.reversed.size());
    for (std::size_t i = 0; i < lists.pixels.size(); ++i)
        lists.pixels[i].reversed =
            std::span<const ListFragment>{lists.reversed}.subspan(starts[i], starts[i + 1] - starts[i]);
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

void complete(Lists& lists) {
    for (std::size_t i = 0; i < lists.pixels.size(); ++i) {
        const std::size_t first = lists.pixels[i].first;
        const std::size_t end = i + 1 < lists.pixels.size() ? lists.pixels[i + 1].first : lists.fragments.size();
        lists.pixels[i].fragments = std::span<const ListFragment>{lists.fragments}.subspan(first, end - first);
    }
    settle_background(lists);
    set_triangle_depths(lists);
    reverse_ties(lists);
}

Lists lists_of(const verdict::SceneFragments& scene, const verdict::Colors& candidate) {
    Lists lists;
    lists.width = candidate.width();
    lists.height = candidate.height();
    for (int row = 0; row < scene.height(); ++row)
        for (int x = 0; x < scene.width(); ++x) {
            const verdict::PixelList list = scene.list_at(x, row);
            add(lists, list, candidate.at(list.x, list.y));
        }
    std::vector<double> seen;
    for (const ListPixel& pixel : lists.pixels) seen.insert(seen.end(), pixel.seen.begin(), pixel.seen.end());
    lists.format = narrowest(seen);
    complete(lists);
    return lists;
}

}  // namespace strata::oracle::program
