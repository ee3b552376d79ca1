// Expected values: worked out by hand, or counted by plain loops of the test.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/tools/oracle/program/plain_port.h"
#include "tools/oracle/program/fit/fitting.h"
#include "tools/oracle/program/fit/search.h"
#include "tools/oracle/program/steps/entries.h"

using namespace strata::oracle::program;
using namespace strata::test;

namespace {

const FragmentProperty& property_named(std::string_view name) {
    for (const FragmentProperty& property : properties())
        if (property.name == name) return property;
    throw std::runtime_error{std::string{name}};
}

}  // namespace

TEST_CASE("a cost counts the bits of residuals: 0 for none, n for a channel that is off by the root of 2^n - 1") {
    CHECK(bits_of({0, 0, 0}) == 0);
    CHECK(bits_of({1, 0, 0}) == 1);
    CHECK(bits_of({0, -std::sqrt(3.0), 0}) == Approx(2));
    CHECK(bits_of({1, 1, 1}) == 3);
    int off = 0;
    for (int i = 1; i < 100000; ++i) {
        const double r = i * 0.37, exact = std::log2(1 + r * r);
        off += std::fabs(bits_of({r, 0, 0}) - exact) > 0.012 ? 1 : 0;
        off += bits_of({r, 0, 0}) < bits_of({r - 0.37, 0, 0}) ? 1 : 0;
    }
    CHECK(off == 0);
}

TEST_CASE("one code is free without layers, and clamped values are what a port clamps") {
    ListPixel pixel{.seen = {0.5, 1, 0}};
    CHECK(residual({0.5 + 1.0 / 255, 1.25, -3}, pixel, 1.0 / 255) == Color{0, 0, 0});
    CHECK(residual({0.5 + 3.0 / 255, 1, 0}, pixel, 1.0 / 255)[0] == Approx(2));
    const ListFragment fragment{};
    pixel.fragments = {&fragment, 1};
    CHECK(residual({0.5 + 1.0 / 255, 1, 0}, pixel, 1.0 / 255)[0] == Approx(1));
}

TEST_CASE("stored values are the nearest codes, halves up, or truncated, or the nearest half float") {
    CHECK(stored(PortFormat::unorm8, 0.5) == 128.0 / 255);
    CHECK(stored(PortFormat::unorm8, 0.5, true) == 127.0 / 255);
    CHECK(stored(PortFormat::unorm10, 2) == 1);
    CHECK(stored(PortFormat::half, 1 + 0x1p-11 + 0x1p-20) == 1 + 0x1p-10);
    CHECK(stored(PortFormat::exact, 0.3) == 0.3);
}

TEST_CASE("the narrowest format that holds all values is recognised") {
    const auto of = [](std::vector<double> values) { return narrowest(values); };
    CHECK(of({0, 17 / 255.0, 1}) == PortFormat::unorm8);
    CHECK(of({0, static_cast<double>(static_cast<float>(500 / 1023.0)), 1}) == PortFormat::unorm10);
    CHECK(of({0.25, 1 + 0x1p-10, 0x1p-9}) == PortFormat::half);
    CHECK(of({static_cast<double>(static_cast<float>(12345 / 65535.0)), 0}) == PortFormat::unorm16);
    CHECK(of({0.1234567, 0.7}) == PortFormat::exact);
}

TEST_CASE("properties of a fragment are those of its place in the list") {
    std::vector<ListFragment> f(3);
    f[0] = {.alpha = 0.5, .depth = 0.25, .code = 4, .submission = 2};
    f[1] = {.color = {0.1, 0.7, 0.2}, .alpha = 0.25, .depth = 0.26, .code = 5, .submission = 0};
    f[2] = {.alpha = 0.1, .depth = 0.75, .code = 5, .submission = 1, .primitive = 7};
    const ListPixel pixel{.x = 5, .y = 2, .first = 100, .fragments = f};
    const auto of = [&](std::string_view name, std::size_t k) { return property_named(name).of(pixel, k); };
    CHECK(of("rank from the back", 0) == 2);
    CHECK(of("twice the rank from the middle layer", 2) == 2);
    CHECK(of("twice the rank from the middle layer", 1) == 0);
    CHECK(of("rank in drawing order", 0) == 2);
    CHECK(of("node number in all lists", 2) == 101);
    CHECK(of("distance in depth to the next one behind", 1) == Approx(0.49));
    CHECK(std::isinf(of("distance in depth behind the one before", 0)));
    CHECK(of("number of bits of depth shared with the one before", 1) == 6);  // 16/64 to 17/64
    CHECK(of("ones at the depth of the one before", 2) == 1);
    CHECK(of("triangle number", 2) == 7);
    CHECK(of("triangles of odd number", 2) == 1);
    CHECK(of("triangle number modulo 3", 2) == 1);
    CHECK(of("mostly green ones", 1) == 1);
    CHECK(of("transmittance before", 2) == Approx(0.375));
    CHECK(of("transmittance behind", 0) == Approx(0.5));
    CHECK(of("odd pixels of a checkerboard", 0) == 1);
    CHECK(of("x modulo 8", 0) == 5);
}

TEST_CASE("names of properties and words of entries are unique, and a parameter is in the words") {
    std::set<std::string_view> names, words;
    for (const FragmentProperty& property : properties()) names.insert(property.name);
    CHECK(names.size() == properties().size());
    int wrong = 0;
    for (const StepEntry* entry : entries()) {
        words.insert(entry->words);
        const bool has_place = entry->words.find("{}") != entry->words.npos;
        wrong += !entry->parameters.empty() && !has_place ? 1 : 0;
        const bool is_list = entry->step == PortStep::list, is_fold = entry->step == PortStep::fold;
        wrong += (entry->edit != nullptr) == is_list && (entry->fold != nullptr) == is_fold &&
                         (entry->recolor != nullptr) == (!is_list && !is_fold)
                     ? 0
                     : 1;
    }
    CHECK(words.size() == entries().size());
    CHECK(wrong == 0);
}

TEST_CASE("of equal depths the order counts that comes closest, or the one that is kept") {
    PortScene scene{.width = 2, .height = 1, .pixels = {{}, {}}};
    scene.pixels[0] = {{.color = {1, 0, 0}, .alpha = 0.5, .depth = 0.5, .submission = 0},
                       {.color = {0, 0, 1}, .alpha = 0.5, .depth = 0.5, .submission = 1}};
    scene.pixels[1] = scene.pixels[0];
    scene.pixels[1][1].depth = 0.6;
    const PortList reversed{scene.pixels[0].rbegin(), scene.pixels[0].rend()};
    const PortColor color = over(reversed, scene.background, as_it_is);
    const Lists lists = strata::test::lists_of(scene, {color, color}, PortFormat::exact);
    CHECK(bits_of(residual_of({}, lists.pixels[0], {}, lists.unit()).off) == 0);
    CHECK(bits_of(residual_of({}, lists.pixels[1], {}, lists.unit()).off) > 10);
    CHECK(lists.pixels[1].ties.empty());
    const PortColor one = over({scene.pixels[0][1]}, scene.background, as_it_is);
    const Lists lossy = strata::test::lists_of(scene, {one, one}, PortFormat::exact);
    CHECK(residual_of({}, lossy.pixels[0], {}, lossy.unit()).loses);
    CHECK(bits_of(residual_of({}, lossy.pixels[0], {}, lossy.unit()).off) == 0);
}

TEST_CASE("a background between two codes is the one that is seen") {
    PortScene scene{.width = 2, .height = 1, .background = {0.3, 0.7, 0.5}, .pixels = {{}, {}}};
    scene.pixels[1] = {{.color = {0, 0, 0}, .alpha = 0.1, .depth = 0.5}};
    const PortPicture picture{{76 / 255.0, 179 / 255.0, 127 / 255.0}, {0, 0, 0}};
    const Color behind = strata::test::lists_of(scene, picture).pixels[1].behind;
    CHECK(stored(PortFormat::unorm8, behind[0]) == 76 / 255.0);
    CHECK(stored(PortFormat::unorm8, behind[1]) == 179 / 255.0);
    CHECK(stored(PortFormat::unorm8, behind[2]) == 127 / 255.0);
}

TEST_CASE("the right program emulates the roundings of plain ports") {
    PortScene scene = random_scene(21);
    scene.background = {0.8, 0.37, 0.12};  // no code and a half
    const Lists lists = strata::test::lists_of(scene, PortPicture(scene.pixels.size()));
    int off = 0;
    const auto compare = [&](const PortRounding& rounding,
                             PortColor (*composite)(const PortList&, const PortColor&, Keep), Keep keep) {
        for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
            const Color found = value(Program{}, lists.pixels[i], rounding);
            const PortColor wanted = composite(scene.pixels[i], scene.background, keep);
            for (std::size_t c = 0; c < 3; ++c) off += std::fabs(found[c] - wanted[c]) > 1e-12 ? 1 : 0;
        }
    };
    const auto at_each_blend = [](BlendForm form, PortFormat format, bool truncates = false) {
        return PortRounding{.form = form, .blend = format, .weight = format, .truncates = truncates};
    };
    compare({}, over, as_it_is);
    compare(at_each_blend(BlendForm::over, PortFormat::unorm8), over, in_8_bits);
    compare(at_each_blend(BlendForm::over, PortFormat::unorm8, true), over, in_8_bits_truncated);
    compare(at_each_blend(BlendForm::under, PortFormat::unorm8), under, in_8_bits);
    compare(at_each_blend(BlendForm::under, PortFormat::half), under, in_half);
    CHECK(off == 0);
}

TEST_CASE("the number with the fewest digits above one and up to another is taken") {
    CHECK(shortest_between(0.4993, 0.5021) == 0.5);
    CHECK(shortest_between(0.31, 0.39) == 0.35);
    CHECK(shortest_between(0.6, 0.6003) > 0.6);
    CHECK(shortest_between(0.1234, 0.1236) == 0.1235);
}

TEST_CASE("numbers of few digits cost less, in tenths and in sixteenths") {
    const auto price_of = [](double parameter) {
        return price(Edit{.entry = &value_entries()[0], .parameters = {parameter}});
    };
    CHECK(price_of(0.5) == price_of(0.7));
    CHECK(price_of(0.5) < price_of(0.93));
    CHECK(price_of(0.9375) == price_of(0.93));
    CHECK(price_of(0.93) < price_of(1.979));
}
