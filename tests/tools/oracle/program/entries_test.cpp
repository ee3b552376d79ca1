// Expected values: what the words of an entry say, done to plain lists by a few lines of the test.
#include "tools/oracle/program/steps/entries.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/oracle/program/plain_port.h"
#include "tools/oracle/program/fit/prove.h"

using namespace strata::oracle::program;
using namespace strata::test;

namespace {

using PaintsList = std::function<PortColor(const PortList& list, const PortColor& background)>;

PaintsList over_changed(const std::function<void(PortFragment&)>& change) {
    return [change](PortList list, const PortColor& background) {
        for (PortFragment& f : list) change(f);
        return over(list, background, as_it_is);
    };
}
PaintsList over_list(const std::function<PortList(const PortList&)>& change) {
    return [change](const PortList& list, const PortColor& background) {
        return over(change(list), background, as_it_is);
    };
}
// Back to front by a blend of each channel.
PaintsList blended_by(const std::function<double(double below, double color, double alpha)>& blend) {
    return [blend](const PortList& list, const PortColor& background) {
        PortColor color = background;
        for (auto f = list.rbegin(); f != list.rend(); ++f)
            for (std::size_t c = 0; c < 3; ++c) color[c] = blend(color[c], f->color[c], f->alpha);
        return color;
    };
}
PaintsList finished_by(const std::function<double(double)>& finish) {
    return [finish](const PortList& list, const PortColor& background) {
        PortColor color = over(list, background, as_it_is);
        for (double& c : color) c = finish(c);
        return color;
    };
}

// The average of weighted layers, over the background by the product of all 1 - alpha.
struct PortAverage {
    PortColor sum{};
    double weights = 0, alphas = 0, through = 1;
};
PortAverage averaged(const PortList& list, bool is_weighted) {
    PortAverage a;
    for (const PortFragment& f : list) {
        const double near = 1 - f.depth, w = is_weighted ? f.alpha * std::max(0.01, 3000 * near * near * near) : 1;
        for (std::size_t c = 0; c < 3; ++c) a.sum[c] += w * f.alpha * f.color[c];
        a.weights += w * f.alpha;
        a.alphas += f.alpha;
        a.through *= 1 - f.alpha;
    }
    return a;
}
PortColor joined(const PortAverage& a, double divisor, double through, const PortColor& background) {
    PortColor color = background;
    for (std::size_t c = 0; c < 3 && divisor > 0; ++c)
        color[c] = a.sum[c] / divisor * (1 - through) + through * background[c];
    return color;
}

struct EntryCase {
    std::string_view words;
    std::vector<double> parameters;
    PaintsList paints;
};

PortList in_batches(const PortList& given, std::uint32_t size, bool is_last_in_front) {
    PortList list;
    for (std::uint32_t k = 0; k < 8; ++k) {
        const std::uint32_t batch = is_last_in_front ? 7 - k : k;
        for (const PortFragment& f : given)
            if (f.submission / size == batch) list.push_back(f);
    }
    return list;
}

std::vector<EntryCase> cases() {
    return {
        {"have alpha read from green", {}, over_changed([](PortFragment& f) { f.alpha = f.color[1]; })},
        {"are blended over a cleared target when they are stored: colours are multiplied by alpha, alpha by itself",
         {},
         over_changed([](PortFragment& f) {
             for (double& c : f.color) c *= f.alpha;
             f.alpha *= f.alpha;
         })},
        {"have the colour of the ones at the same rank from the other end", {}, over_list([](const PortList& given) {
             PortList list = given;
             for (std::size_t k = 0; k < list.size(); ++k) list[k].color = given[given.size() - 1 - k].color;
             return list;
         })},
        {"are kept in an array of {} layers, where later ones replace the first",
         {3},
         over_list([](const PortList& given) {
             PortList list;
             for (const PortFragment& f : given) {
                 const auto place = static_cast<std::size_t>(&f - given.data()) % 3;
                 if (list.size() <= place) list.push_back(f);
                 list[place] = f;
             }
             return list;
         })},
        {"are sorted in batches of {} in drawing order only, the first batch in front",
         {2},
         over_list([](const PortList& given) { return in_batches(given, 2, false); })},
        {"are sorted in batches of {} in drawing order only, the last batch in front",
         {2},
         over_list([](const PortList& given) { return in_batches(given, 2, true); })},
        {"layers multiply what is behind, whatever their alpha", {}, blended_by([](double below, double color, double) {
             return below * color;
         })},
        {"what is behind is multiplied by 1 - colour (ONE_MINUS_SRC_COLOR)",
         {},
         blended_by([](double below, double color, double a) { return color * a + below * (1 - color); })},
        {"what is behind is multiplied by 1 - colour (ONE_MINUS_SRC_COLOR), colours not by alpha",
         {},
         blended_by([](double below, double color, double) { return color + below * (1 - color); })},
        {"what is behind is multiplied by the colour (SRC_COLOR)",
         {},
         blended_by([](double below, double color, double a) { return color * a + below * color; })},
        {"once the transmittance is below {}, all that is behind is missing",
         {0.3},
         [](const PortList& list, const PortColor& background) {
             PortColor color{};
             double through = 1;
             for (const PortFragment& f : list) {
                 for (std::size_t c = 0; c < 3; ++c) color[c] += through * f.alpha * f.color[c];
                 through *= 1 - f.alpha;
                 if (through < 0.3) return color;
             }
             for (std::size_t c = 0; c < 3; ++c) color[c] += through * background[c];
             return color;
         }},
        {"weighted sums: alpha max(0.01, 3000 (1 - depth)^3), divided by the sum of alphas without weights",
         {},
         [](const PortList& list, const PortColor& background) {
             const PortAverage a = averaged(list, true);
             return joined(a, a.alphas, a.through, background);
         }},
        {"weighted sums: alpha max(0.01, 3000 (1 - depth)^3), as if the transmittance were 0: no background",
         {},
         [](const PortList& list, const PortColor&) {
             const PortAverage a = averaged(list, true);
             return joined(a, a.weights, 0, {});
         }},
        {"layers are averaged by alpha, as if the transmittance were 0: no background",
         {},
         [](const PortList& list, const PortColor&) {
             const PortAverage a = averaged(list, false);
             return joined(a, a.weights, 0, {});
         }},
        {"the average of the layers behind the first {} is that of all layers",
         {2},
         [](const PortList& list, const PortColor& background) {
             const auto first = static_cast<std::ptrdiff_t>(std::min<std::size_t>(list.size(), 2));
             const PortAverage all = averaged(list, false), tail = averaged({list.begin() + first, list.end()}, false);
             return over({list.begin(), list.begin() + first}, joined(all, all.weights, tail.through, background),
                         as_it_is);
         }},
        {"the picture is in video range: 0 is stored as 16, 255 as 235", {}, finished_by([](double v) {
             return 16 / 255.0 + v * 219 / 255;
         })},
        {"the picture is taken for one in video range: 16 is stored as 0, 235 as 255", {}, finished_by([](double v) {
             return (v - 16 / 255.0) * 255 / 219;
         })},
        {"the picture's values are stored as {} + {} times them", {0.1, 0.7}, finished_by([](double v) {
             return 0.1 + 0.7 * v;
         })},
    };
}

}  // namespace

TEST_CASE("entries do to a list what their words say") {
    const PortScene scene = random_scene(31);
    const Lists lists = strata::test::lists_of(scene, PortPicture(scene.pixels.size()), PortFormat::exact);
    for (const EntryCase& c : cases()) {
        const auto entry = std::ranges::find(entries(), c.words, &StepEntry::words);
        INFO(c.words);
        REQUIRE(entry != entries().end());
        const Program program{.edits = {{.entry = *entry, .parameters = c.parameters}}};
        int off = 0;
        for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
            const Color found = value(program, lists.pixels[i], {});
            const PortColor wanted = c.paints(scene.pixels[i], scene.background);
            for (std::size_t k = 0; k < 3; ++k) off += std::fabs(found[k] - wanted[k]) > 1e-12 ? 1 : 0;
        }
        CHECK(off == 0);
    }
}

// Of layers of 0.4, 0.5 and 0.5 the transmittance is 0.15, which 8 bits round to either side in different orders.
TEST_CASE("pixels whose transmittance is as near to a threshold as rounding do not count against a program") {
    PortScene scene = random_scene(32);
    for (std::size_t i = 0; i < scene.pixels.size(); i += 3)
        for (PortFragment& f : scene.pixels[i]) f.alpha = f.alpha < 0.5 ? 0.4 : 0.5;
    PortPicture picture;
    for (const PortList& list : scene.pixels) {
        PortColor color{};
        double through = 1;
        for (const PortFragment& f : list) {
            if (through == 0) break;
            for (std::size_t c = 0; c < 3; ++c) color[c] = in_8_bits(color[c] + through * f.alpha * f.color[c]);
            through = in_8_bits(through * (1 - f.alpha));
            if (through < 0.15) through = 0;
        }
        for (std::size_t c = 0; c < 3; ++c) color[c] = in_8_bits(color[c] + through * in_8_bits(scene.background[c]));
        picture.push_back(color);
    }
    const Lists lists = strata::test::lists_of(scene, picture);
    const auto stop = std::ranges::find(entries(), "once the transmittance is below {}, all that is behind is missing",
                                        &StepEntry::words);
    const auto proved = [&](double threshold) {
        return prove(lists, {.edits = {{.entry = *stop, .parameters = {threshold}}}}, best_fitness(lists, {}));
    };
    const Proof at_threshold = proved(0.15), above = proved(0.17);
    CHECK(at_threshold.fitness.beyond > 10);
    CHECK(at_threshold.fitness.beyond - at_threshold.open <= 2);
    CHECK(at_threshold.is_whole);
    CHECK(above.fitness.beyond > 10);
    CHECK(above.open == 0);
    CHECK_FALSE(above.is_whole);
}
