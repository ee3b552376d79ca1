// Expected values: opaque surfaces and layers of random pixels, drawn by plain code of this test with one mistake in
// the opaque pass; of scenes, the lists that the renderer's own opaque pass gives.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/tools/oracle/program/plain_port.h"
#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tools/oracle/program/drawing/fit_drawings.h"

using namespace strata::test;
using namespace strata::oracle::program;

namespace {

struct PortSurface {
    PortFragment f{};
    bool is_opaque = false;
};
// In drawing order.
using PortSurfaces = std::vector<PortSurface>;

// 0 to 4 opaque surfaces and 0 to 3 layers per pixel, opaque ones drawn first or in any order.
std::vector<PortSurfaces> random_surfaces(std::uint32_t seed, std::size_t pixels, bool is_mixed) {
    std::mt19937 engine{seed};
    const auto number = [&] { return static_cast<double>(engine() >> 8) * 0x1p-24; };
    std::vector<PortSurfaces> all(pixels);
    for (PortSurfaces& pixel : all) {
        const std::size_t opaque = engine() % 5, layers = engine() % 4;
        for (std::size_t k = 0; k < opaque + layers; ++k)
            pixel.push_back({{.color = {number(), number(), number()},
                              .alpha = k < opaque ? 1 : 0.2 + 0.6 * number(),
                              .depth = number(),
                              .instance = static_cast<std::uint32_t>(engine() % 5),
                              .material = static_cast<std::uint32_t>(k < opaque ? 0 : 1),
                              .is_front = engine() % 2 == 0},
                             k < opaque});
        if (is_mixed)
            for (std::size_t k = pixel.size(); k > 1; --k) std::swap(pixel[k - 1], pixel[engine() % k]);
        for (std::size_t k = 0; k < pixel.size(); ++k) pixel[k].f.submission = static_cast<std::uint32_t>(k);
    }
    return all;
}

const PortColor sky{0.8, 0.3, 0.1};
constexpr int columns = 60;

// A port's opaque pass: the surface that stays of a pixel, or null.
using Stays = std::function<const PortSurface*(const PortSurfaces&)>;

const PortSurface* nearest_of(const PortSurfaces& pixel,
                              const std::function<bool(const PortFragment&)>& is_drawn = {}) {
    const PortSurface* best = nullptr;
    for (const PortSurface& s : pixel)
        if (s.is_opaque && (!is_drawn || is_drawn(s.f)) && (best == nullptr || s.f.depth < best->f.depth)) best = &s;
    return best;
}

PortPicture painted_surfaces(const std::vector<PortSurfaces>& pixels, const Stays& stays) {
    PortPicture picture;
    for (const PortSurfaces& pixel : pixels) {
        const PortSurface* const behind = stays(pixel);
        PortList list;
        for (const PortSurface& s : pixel)
            if (!s.is_opaque && (behind == nullptr || s.f.depth < behind->f.depth)) list.push_back(s.f);
        std::ranges::sort(list, {}, &PortFragment::depth);
        picture.push_back(over(list, behind != nullptr ? behind->f.color : sky, in_8_bits));
    }
    return picture;
}

ListFragment fragment_of(const PortFragment& f) {
    return {.color = f.color,
            .alpha = f.alpha,
            .depth = f.depth,
            .code = static_cast<std::uint32_t>(f.depth * 0x1p24),
            .submission = f.submission,
            .primitive = f.submission,
            .instance = f.instance,
            .material = f.material,
            .is_front_facing = f.is_front};
}

SceneSurfaces surfaces_with(const std::vector<PortSurfaces>& pixels, const PortPicture& picture) {
    SceneSurfaces made;
    made.background = sky;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        made.opaque.pixels.push_back({.x = static_cast<int>(i) % columns,
                                      .y = static_cast<int>(i) / columns,
                                      .first = made.opaque.fragments.size(),
                                      .seen = picture[i]});
        PortSurfaces sorted = pixels[i];
        std::ranges::sort(sorted, {}, [](const PortSurface& s) { return s.f.depth; });
        std::vector<ListFragment>& layers = made.layers.emplace_back();
        for (const PortSurface& s : sorted) (s.is_opaque ? made.opaque.fragments : layers).push_back(fragment_of(s.f));
    }
    complete(made.opaque);
    return made;
}

Lists right_lists(const std::vector<PortSurfaces>& pixels, const PortPicture& picture) {
    Lists made;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const PortSurface* const behind = nearest_of(pixels[i]);
        made.pixels.push_back({.x = static_cast<int>(i) % columns,
                               .y = static_cast<int>(i) / columns,
                               .first = made.fragments.size(),
                               .behind = behind != nullptr ? behind->f.color : sky,
                               .has_opaque = behind != nullptr,
                               .seen = picture[i]});
        PortSurfaces sorted = pixels[i];
        std::ranges::sort(sorted, {}, [](const PortSurface& s) { return s.f.depth; });
        for (const PortSurface& s : sorted)
            if (!s.is_opaque && (behind == nullptr || s.f.depth < behind->f.depth))
                made.fragments.push_back(fragment_of(s.f));
    }
    complete(made);
    return made;
}

std::string said_of(const std::vector<PortSurfaces>& pixels, const PortPicture& picture) {
    return to_text(fit_drawings(right_lists(pixels, picture), other_opaque_passes(surfaces_with(pixels, picture))));
}

}  // namespace

TEST_CASE("what became of opaque surfaces is named") {
    struct Case {
        const char* words;
        bool is_mixed;
        Stays stays;
    };
    const auto by = [](auto key) {
        return [key](const PortSurfaces& pixel) {
            const PortSurface* best = nullptr;
            for (const PortSurface& s : pixel)
                if (s.is_opaque && (best == nullptr || key(s.f) > key(best->f))) best = &s;
            return best;
        };
    };
    const Case cases[] = {
        {"opaque surfaces are not tested: the last drawn stays", false,
         by([](const PortFragment& f) { return f.submission; })},
        {"the farthest opaque surface stays", false, by([](const PortFragment& f) { return f.depth; })},
        {"of opaque surfaces the first drawn stays", false,
         by([](const PortFragment& f) { return 100 - f.submission; })},
        {"opaque fragments of back faces are left out", false,
         [](const PortSurfaces& p) { return nearest_of(p, [](const PortFragment& f) { return f.is_front; }); }},
        {"opaque fragments with instance 3 are left out", false,
         [](const PortSurfaces& p) { return nearest_of(p, [](const PortFragment& f) { return f.instance != 3; }); }},
        {"opaque fragments with depth at least 0.70", false,
         [](const PortSurfaces& p) { return nearest_of(p, [](const PortFragment& f) { return f.depth < 0.7; }); }},
        {"opaque surfaces behind layers that are drawn before them are lost: layers write depth", true,
         [](const PortSurfaces& p) {
             return nearest_of(p, [&](const PortFragment& f) {
                 return std::ranges::none_of(p, [&](const PortSurface& s) {
                     return !s.is_opaque && s.f.depth < f.depth && s.f.submission < f.submission;
                 });
             });
         }},
    };
    for (const Case& c : cases) {
        const std::vector<PortSurfaces> pixels = random_surfaces(7, 1500, c.is_mixed);
        const std::string text = said_of(pixels, painted_surfaces(pixels, c.stays));
        INFO(text);
        CHECK(text.find(c.words) != text.npos);
        CHECK(text.starts_with("wrong: "));
    }
}

TEST_CASE("an opaque pass and a mistake with layers are named together") {
    const std::vector<PortSurfaces> pixels = random_surfaces(9, 2000, false);
    std::vector<PortSurfaces> darker = pixels;
    for (PortSurfaces& pixel : darker)
        for (PortSurface& s : pixel)
            if (!s.is_opaque)
                for (double& c : s.f.color) c *= 0.5;
    const PortPicture picture = painted_surfaces(
        darker, [](const PortSurfaces& p) { return nearest_of(p, [](const PortFragment& f) { return f.is_front; }); });
    const std::string text = said_of(pixels, picture);
    INFO(text);
    CHECK(
        text.starts_with("wrong: opaque fragments of back faces are left out; and all fragments have colours times "
                         "0.5\n"));
}

TEST_CASE("a right opaque pass is not called wrong") {
    const std::vector<PortSurfaces> pixels = random_surfaces(8, 1500, true);
    const PortPicture picture = painted_surfaces(pixels, [](const PortSurfaces& p) { return nearest_of(p); });
    const Fitting found =
        fit_drawings(right_lists(pixels, picture), other_opaque_passes(surfaces_with(pixels, picture)));
    CHECK(found.found.empty());
}

TEST_CASE("of all surfaces of a scene the nearest opaque one is what its opaque pass keeps") {
    const OpenedScene opened{"showroom", 64, 48};
    const auto picture = opened.picture("front_to_back", strata::pipeline::Format::rgba8);
    REQUIRE(picture);
    const strata::oracle::verdict::SceneFragments fragments = opened.fragments();
    const Lists lists = lists_of(fragments, strata::oracle::verdict::Colors{*picture}, true);
    const SceneSurfaces surfaces = surfaces_of(opened.input(), lists);
    REQUIRE(surfaces.has_opaque());
    std::size_t different = 0;
    for (std::size_t i = 0; i < lists.pixels.size(); ++i) {
        const ListPixel &given = lists.pixels[i], &opaque = surfaces.opaque.pixels[i];
        if (given.has_opaque != !opaque.fragments.empty())
            ++different;
        else if (given.has_opaque && given.behind != opaque.fragments[0].color)
            ++different;
    }
    CHECK(different == 0);
}

TEST_CASE("a pixel's colour that is that of another opaque surface is told as that") {
    OpenedScene opened{"showroom", 64, 48};
    const auto picture = opened.picture("front_to_back", strata::pipeline::Format::rgba8);
    REQUIRE(picture);
    const strata::oracle::verdict::SceneFragments fragments = opened.fragments();
    const SceneSurfaces surfaces =
        surfaces_of(opened.input(), lists_of(fragments, strata::oracle::verdict::Colors{*picture}, true));
    for (std::size_t i = 0; i < surfaces.opaque.pixels.size(); ++i) {
        const ListPixel& pixel = surfaces.opaque.pixels[i];
        if (pixel.fragments.size() < 2 || !surfaces.layers[i].empty()) continue;
        const std::string words = shown_surface(opened.input(), pixel.x, pixel.y, pixel.fragments[1].color);
        INFO(words);
        CHECK(words.starts_with("it comes out so if the opaque surface of instance " +
                                std::to_string(pixel.fragments[1].instance)));
        CHECK(shown_surface(opened.input(), pixel.x, pixel.y, {0.123, 0.987, 0.456}).empty());
        return;
    }
    FAIL("no pixel has two opaque surfaces and no layer");
}

TEST_CASE("positions on a coarse grid are named") {
    OpenedScene opened{"teapot", 64, 48};
    opened.profile.raster.subpixel_bits = 1;
    const auto picture = opened.picture("front_to_back", strata::pipeline::Format::rgba8);
    REQUIRE(picture);
    opened.profile.raster.subpixel_bits = 8;
    const strata::oracle::verdict::SceneFragments fragments = opened.fragments();
    const strata::oracle::verdict::Colors colors{*picture};
    const Lists lists = lists_of(fragments, colors, true);
    const std::string text = to_text(fit_drawings(lists, other_drawings(opened.input(), lists, colors)));
    CHECK(text.starts_with("wrong: positions are rounded to half pixels\n"));
}

namespace {

// A picture of the scene with other colours, or with the layers of `made`, judged by the scene as it is.
std::string judged_by(const OpenedScene& opened, const strata::oracle::TargetImage& picture) {
    const strata::oracle::verdict::SceneFragments fragments = opened.fragments();
    const strata::oracle::verdict::Colors colors{picture};
    const Lists lists = lists_of(fragments, colors, true);
    const std::string text = to_text(fit_drawings(lists, other_drawings(opened.input(), lists, colors)));
    return text.substr(0, text.find('\n'));
}

// What plain code composites of the layers at a pixel.
using Paints = std::function<PortColor(const ListPixel& given, const ListPixel& clear)>;
strata::oracle::TargetImage painted_from(const Lists& given, const Lists& clear, const Paints& paints) {
    strata::oracle::TargetImage made{.name = "color", .width = given.width, .height = given.height, .channels = 3};
    for (std::size_t i = 0; i < given.pixels.size(); ++i)
        for (const double c : paints(given.pixels[i], clear.pixels[i]))
            made.codes.push_back(static_cast<std::uint32_t>(c * 255 + 0.5));
    return made;
}

void blend_over(PortColor& below, const PortColor& color, double alpha) {
    for (std::size_t c = 0; c < 3; ++c) below[c] = color[c] * alpha + below[c] * (1 - alpha);
}

}  // namespace

TEST_CASE("sides that are exchanged, and layers without fog, are named") {
    OpenedScene opened{"teapot", 64, 48};
    opened.options.alpha = 0.6f;
    for (auto& material : opened.scene.list.materials) std::swap(material.front, material.back);
    const auto exchanged = opened.picture("front_to_back", strata::pipeline::Format::rgba8);
    REQUIRE(exchanged);
    for (auto& material : opened.scene.list.materials) std::swap(material.front, material.back);
    CHECK(judged_by(opened, *exchanged) == "wrong: all layers have the colours of their other side");

    const auto sides = opened.scene.list.materials;
    for (auto& material : opened.scene.list.materials) material.back = material.front;
    const auto of_one_side = opened.picture("front_to_back", strata::pipeline::Format::rgba8);
    opened.scene.list.materials = sides;
    CHECK(judged_by(opened, *of_one_side) == "wrong: all layers have the colours of their front");

    const Lists without = lists_of(opened.fragments(), strata::oracle::verdict::Colors{*exchanged}, true);
    opened.options.fog = strata::pipeline::Fog{.start = 10, .end = 18, .color = {0.6f, 0.6f, 0.9f, 1}};
    const Lists with = lists_of(opened.fragments(), strata::oracle::verdict::Colors{*exchanged}, true);
    const auto first_fogged = [](const ListPixel& given, const ListPixel& other) {
        PortColor color = given.behind;
        for (std::size_t k = given.fragments.size(); k-- > 0;)
            blend_over(color, (k == 0 ? given : other).fragments[k].color, given.fragments[k].alpha);
        return color;
    };
    CHECK(judged_by(opened, painted_from(with, without, first_fogged)) ==
          "wrong: all layers but the nearest have no fog");
    const auto fogged_at_end = [](const ListPixel& given, const ListPixel& other) {
        PortColor color = given.behind;
        for (std::size_t k = given.fragments.size(); k-- > 0;)
            blend_over(color, other.fragments[k].color, given.fragments[k].alpha);
        if (given.fragments.empty()) return color;
        const double fogged = given.fragments[0].color[2], bare = other.fragments[0].color[2], fog = double{0.9f};
        blend_over(color, {double{0.6f}, double{0.6f}, fog}, (fogged - bare) / (fog - bare));
        return color;
    };
    CHECK(judged_by(opened, painted_from(with, without, fogged_at_end)) ==
          "wrong: the finished pixel has the fog of its nearest layer, where each layer is to have its own");
    const auto fog_in_alpha = [](const ListPixel& given, const ListPixel& other) {
        PortColor color = given.behind;
        for (std::size_t k = given.fragments.size(); k-- > 0;) {
            const double fogged = given.fragments[k].color[2], bare = other.fragments[k].color[2];
            const double share = (fogged - bare) / (double{0.9f} - bare);
            blend_over(color, given.fragments[k].color, given.fragments[k].alpha * (1 - share));
        }
        return color;
    };
    CHECK(judged_by(opened, painted_from(with, without, fog_in_alpha)) ==
          "wrong: alphas are multiplied by the factor of the fog, too");
}
