// Expected values: each port is written here, on plain lists, with its mistake; the judge must say operation, property
// and threshold.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/oracle/program/plain_port.h"
#include "tools/oracle/program/fit/fitting.h"

using namespace strata::test;
using strata::oracle::program::PortFormat;

namespace {

using Picks = std::function<bool(const PortFragment& f, std::size_t k, std::size_t n, int x, int y)>;
using Does = void (*)(PortList& list, std::size_t k);

struct PortOperation {
    const char* words;
    Does does;
};
struct PortProperty {
    const char* words;
    Picks picks;
};

const PortOperation operations[] = {
    {"are left out", [](PortList& l, std::size_t k) { l.erase(l.begin() + static_cast<std::ptrdiff_t>(k)); }},
    {"are blended twice",
     [](PortList& l, std::size_t k) {
         const PortFragment copy = l[k];
         l.insert(l.begin() + static_cast<std::ptrdiff_t>(k), copy);
     }},
    {"have the colour of the ones before",
     [](PortList& l, std::size_t k) { l[k].color = k > 0 ? l[k - 1].color : l[k].color; }},
    {"have 1 - alpha as alpha", [](PortList& l, std::size_t k) { l[k].alpha = 1 - l[k].alpha; }},
    {"are not blended: they replace what is behind", [](PortList& l, std::size_t k) { l[k].alpha = 1; }},
    {"have red and blue exchanged", [](PortList& l, std::size_t k) { std::swap(l[k].color[0], l[k].color[2]); }},
    {"have colours times 0.5",
     [](PortList& l, std::size_t k) {
         for (double& c : l[k].color) c *= 0.5;
     }},
};

const PortProperty by_fragment[] = {
    {"fragments with depth at least 0.6",
     [](const PortFragment& f, std::size_t, std::size_t, int, int) { return f.depth >= 0.6; }},
    {"fragments of back faces", [](const PortFragment& f, std::size_t, std::size_t, int, int) { return !f.is_front; }},
    {"fragments with rank from the front 1",
     [](const PortFragment&, std::size_t k, std::size_t, int, int) { return k == 1; }},
    {"fragments with alpha below 0.5",
     [](const PortFragment& f, std::size_t, std::size_t, int, int) { return f.alpha < 0.5; }},
};

// From the far end, so that colours of the ones before are still theirs.
Change changed(const PortOperation& operation, const PortProperty& property) {
    return [&](PortList list, int x, int y) {
        const PortList given = list;
        for (std::size_t k = given.size(); k-- > 0;)
            if (property.picks(given[k], k, given.size(), x, y)) operation.does(list, k);
        return list;
    };
}

// The words of a number differ in the last digits from picture to picture: 0.6 may be 0.5998.
bool says(const std::string& text, const std::string& words) {
    const std::size_t at = words.find_last_of(' ');
    const std::string number = words.substr(at + 1);
    if (number.find('.') == number.npos) return text.find(words) != text.npos;
    const std::size_t found = text.find(words.substr(0, at + 1));
    return found != text.npos && std::fabs(std::stod(text.substr(found + at + 1)) - std::stod(number)) < 0.005;
}

}  // namespace

TEST_CASE("every operation is found with its property and threshold", "[slow]") {
    const PortScene scene = random_scene(11);
    std::vector<std::string> missed;
    std::size_t which = 0;
    for (const PortOperation& operation : operations)
        for (std::size_t i = 0; i < 2; ++i, ++which) {
            const PortProperty& property = by_fragment[which % 4];
            const PortFormat format = which % 3 == 0 ? PortFormat::exact : PortFormat::unorm8;
            const PortPicture picture =
                painted(scene, changed(operation, property), format == PortFormat::exact ? as_it_is : in_8_bits);
            const std::string text = judged(scene, picture, format);
            if (text.starts_with("wrong: fragments") && says(text, property.words) &&
                text.find(operation.words) != text.npos)
                continue;
            missed.push_back(std::string{property.words} + " " + operation.words + "\n" + text);
        }
    CHECK(missed == std::vector<std::string>{});
}

TEST_CASE("conditions on pixels are found with those on fragments", "[slow]") {
    const PortScene scene = random_scene(12);
    const auto left_out = [&](const Picks& picks) {
        return judged(scene, painted(scene, changed(operations[0], {"", picks})));
    };
    CHECK(left_out([](const PortFragment&, std::size_t, std::size_t n, int, int) {
              return n == 1;
          }).starts_with("wrong: all fragments at pixels with number of layers 1 are left out"));
    CHECK(left_out([](const PortFragment&, std::size_t k, std::size_t, int x, int y) {
              return k % 2 == 1 && (x + y) % 2 == 1;
          }).starts_with("wrong: fragments of odd ranks from the front at pixels of odd pixels of a checkerboard are"));
    CHECK(left_out([](const PortFragment& f, std::size_t, std::size_t, int, int) {
              return f.submission >= 4;
          }).starts_with("wrong: fragments with rank in drawing order at least 4 are left out"));
    const std::string three = left_out([](const PortFragment& f, std::size_t k, std::size_t, int, int) {
        return k > 0 && f.depth >= 0.5 && !f.is_front;
    });
    INFO(three);
    CHECK(three.starts_with("wrong: fragments "));
}

TEST_CASE("values of whole pictures are found with their parameters", "[slow]") {
    const PortScene scene = random_scene(13);
    const auto valued = [&](void (*change)(PortFragment&), PortFormat format = PortFormat::unorm8) {
        const Change all = [&](PortList list, int, int) {
            for (PortFragment& f : list) change(f);
            return list;
        };
        const std::string text =
            judged(scene, painted(scene, all, format == PortFormat::exact ? as_it_is : in_8_bits), format);
        return text.substr(0, text.find('\n'));
    };
    CHECK(valued([](PortFragment& f) { f.alpha *= 0.7; }) == "wrong: all fragments have alpha times 0.7");
    CHECK(valued([](PortFragment& f) { f.alpha = std::pow(f.alpha, 1.5); }) ==
          "wrong: all fragments have alpha to the power of 1.5");
    CHECK(valued([](PortFragment& f) { f.alpha = std::floor(f.alpha * 7 + 0.5) / 7; }) ==
          "wrong: all fragments have alpha rounded to 3 bits");
    CHECK(valued([](PortFragment& f) { f.alpha = std::min(f.alpha, 0.6); }, PortFormat::exact) ==
          "wrong: all fragments have an alpha of at most 0.6");
    CHECK(valued([](PortFragment& f) {
              for (double& c : f.color) c = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
          }) == "wrong: all fragments have colours decoded from sRGB");
    CHECK(valued([](PortFragment& f) {
              for (double& c : f.color) c = std::floor(c * 15 + 0.5) / 15;
          }) == "wrong: all fragments have colours rounded to 4 bits");
}

TEST_CASE("other backgrounds, orders, folds and finishes are found", "[slow]") {
    const PortScene scene = random_scene(14);
    const auto first_line = [&](const PortPicture& picture) {
        const std::string text = judged(scene, picture);
        return text.substr(0, text.find('\n'));
    };
    PortScene white = scene;
    white.background = {1, 1, 1};
    CHECK(first_line(painted(white, unchanged)) == "wrong: the background is white");
    CHECK(first_line(painted(scene, [](PortList list, int, int) {
              std::ranges::sort(list, std::ranges::greater{}, &PortFragment::submission);
              return list;
          })) == "wrong: all fragments are not sorted: the last drawn is in front");
    CHECK(first_line(painted(scene, [](PortList list, int, int) {
              const auto far = std::ranges::find_if(list, [](const PortFragment& f) { return f.depth >= 0.4; });
              std::reverse(far, list.end());
              return list;
          })).starts_with("wrong: fragments with depth at least 0.4"));
    PortPicture average, encoded = painted(scene, unchanged);
    for (const PortList& list : scene.pixels) {
        PortColor sum{};
        double weight = 0, through = 1;
        for (const PortFragment& f : list) {
            for (std::size_t c = 0; c < 3; ++c) sum[c] += f.alpha * f.color[c];
            weight += f.alpha;
            through *= 1 - f.alpha;
        }
        PortColor& color = average.emplace_back(scene.background);
        for (std::size_t c = 0; c < 3 && weight > 0; ++c)
            color[c] = sum[c] / weight * (1 - through) + through * scene.background[c];
        for (double& c : color) c = in_8_bits(c);
    }
    CHECK(first_line(average) == "wrong: layers are averaged by alpha, with the right transmittance");
    for (PortColor& color : encoded)
        for (double& c : color) c = in_8_bits(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
    CHECK(first_line(encoded) == "wrong: the picture is encoded as sRGB");
}

TEST_CASE("several parameters are fitted at once: a background, a matrix, a curve of alpha", "[slow]") {
    PortScene scene = random_scene(15);
    const auto text = [&](const PortPicture& picture, PortFormat format) { return judged(scene, picture, format); };
    PortScene other = scene;
    other.background = {0.15, 0.6, 0.45};
    CHECK(text(painted(other, unchanged, as_it_is), PortFormat::exact)
              .starts_with("wrong: the background is (0.15, 0.6, 0.45)"));
    const auto each = [](void (*change)(PortFragment&)) {
        return [change](PortList list, int, int) {
            for (PortFragment& f : list) change(f);
            return list;
        };
    };
    const std::string mixed =
        text(painted(scene, each([](PortFragment& f) {
                         const PortColor c = f.color;
                         f.color = {0.8 * c[0] + 0.2 * c[1], 0.9 * c[1], 0.7 * c[2] + 0.1 * c[0] + 0.05};
                     }),
                     as_it_is),
             PortFormat::exact);
    INFO(mixed);
    CHECK(mixed.starts_with("wrong: all fragments have red that acts as 0.8 red + 0.2 green + 0 blue + 0, green as"));
    const std::string curve = text(
        painted(scene, each([](PortFragment& f) { f.alpha = f.alpha < 0.5 ? 0.6 * f.alpha : 1.4 * f.alpha - 0.4; })),
        PortFormat::unorm8);
    INFO(curve);
    CHECK(curve.starts_with("wrong: all fragments have an alpha that acts as 0, 0.15, 0.3, 0.65, "));
}

TEST_CASE("two mistakes are told together if few words say each", "[slow]") {
    PortScene scene = random_scene(16);
    PortScene white = scene;
    white.background = {1, 1, 1};
    const Change left_out = [](PortList list, int, int) {
        std::erase_if(list, [](const PortFragment& f) { return f.depth >= 0.8; });
        return list;
    };
    const std::string text = judged(scene, painted(white, left_out));
    INFO(text);
    CHECK(text.starts_with("wrong: "));
    CHECK(text.find("the background is white") != text.npos);
    CHECK(text.find("with depth at least 0.8 are left out") != text.npos);
}

TEST_CASE("a large picture is searched on some pixels and proved on all", "[slow]") {
    PortScene scene = random_scene(17);
    const PortScene tile = scene;
    scene.width = 600;
    scene.height = 160;
    scene.pixels.clear();
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x)
            scene.pixels.push_back(
                tile.pixels[static_cast<std::size_t>(y % tile.height * tile.width + x % tile.width)]);
    PortPicture picture = painted(scene, changed(operations[0], by_fragment[0]));
    const std::string found = judged(scene, picture);
    INFO(found);
    CHECK(found.starts_with("wrong: fragments with depth at least 0."));
    CHECK(found.find("are left out\n    0 of 96000 pixels are wrong then") != found.npos);
    CHECK(judged(scene, painted(scene, unchanged)).starts_with("right: "));
    // Two in a thousand pixels more are too many.
    for (std::size_t i = 0; i < picture.size(); i += 300) picture[i] = {0, 1, 0};
    CHECK_FALSE(judged(scene, picture).starts_with("wrong: fragments"));
}
