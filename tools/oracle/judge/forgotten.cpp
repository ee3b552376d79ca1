// tools/oracle/judge/forgotten.cpp - tries the options that a user may have forgotten (alpha, background, samples,
// camera) and decides whether one makes the picture right (forgotten.h).
#include "tools/oracle/judge/forgotten.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <optional>

#include "pipeline/device/profile.h"
#include "pipeline/vertices/polygon_mode.h"
#include "rasterizer/base/enum_values.h"
#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/judge/samples_verdict.h"
#include "tools/oracle/judge/seen_alpha.h"
#include "tools/oracle/verdict/other_profile.h"
#include "tools/oracle/verdict/picture_verdict.h"

namespace strata::oracle {

namespace {

using Color = std::array<double, 3>;
using verdict::Colors;
using verdict::OtherRules;
using verdict::PixelList;
using verdict::SceneFragments;
using verdict::TileLists;

// The scene's picture in real numbers, and where it is drawn.
struct Expected {
    std::vector<Color> color;
    std::vector<std::uint32_t> nearest;  // per pixel: 1 + the number of the nearest triangle; 0: none
    std::vector<bool> is_drawn;
};

Expected expected(const SceneFragments& scene) {
    const auto width = static_cast<std::size_t>(scene.width());
    const std::size_t pixels = width * static_cast<std::size_t>(scene.height());
    Expected all{std::vector<Color>(pixels), std::vector<std::uint32_t>(pixels), std::vector<bool>(pixels)};
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        const std::scoped_lock lock{mutex};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            const std::size_t i = static_cast<std::size_t>(list.y) * width + static_cast<std::size_t>(list.x);
            double through = 1;
            for (const verdict::Fragment& f : list.visible) {
                for (std::size_t c = 0; c < 3; ++c)
                    all.color[i][c] += through * double{f.color[3]} * double{f.color[c]};
                through *= 1 - double{f.color[3]};
            }
            for (std::size_t c = 0; c < 3; ++c) all.color[i][c] += through * double{list.behind[c]};
            all.nearest[i] =
                list.visible.empty() ? (list.has_opaque ? 1 + list.opaque : 0) : 1 + list.visible[0].primitive;
            all.is_drawn[i] = !list.visible.empty() || list.has_opaque;
        }
    });
    return all;
}

Color color_at(const Colors& picture, std::size_t pixel) {
    const auto width = static_cast<std::size_t>(picture.width());
    const auto value = picture.at(static_cast<int>(pixel % width), static_cast<int>(pixel / width));
    return {value[0], value[1], value[2]};
}

double distance(const Color& a, const Color& b) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(a[c] - b[c]));
    return worst;
}

constexpr double two_codes = 2.5 / 255;

// The colour that most of the pixels have where nothing is drawn, if it is not the background's.
struct SeenBackground {
    Color color{};
    std::size_t pixels = 0, of = 0;
};

std::optional<SeenBackground> seen_background(const Expected& right, const Colors& picture, const Color& given) {
    std::map<Color, std::size_t> count;
    SeenBackground seen;
    for (std::size_t i = 0; i < right.color.size(); ++i)
        if (!right.is_drawn[i]) ++count[color_at(picture, i)], ++seen.of;
    if (count.empty()) return std::nullopt;
    const auto most = std::ranges::max_element(count, {}, [](const auto& one) { return one.second; });
    seen.color = most->first;
    seen.pixels = most->second;
    const bool are_many = seen.of >= 16 && 10 * seen.pixels >= 6 * seen.of;
    return are_many && distance(seen.color, given) > two_codes ? std::optional{seen} : std::nullopt;
}

Color in_srgb(const Color& color, pipeline::ColorSpace space) {
    if (space == pipeline::ColorSpace::encoded) return color;
    Color encoded;
    for (std::size_t c = 0; c < 3; ++c) encoded[c] = double{scenes::encode_srgb(static_cast<float>(color[c]))};
    return encoded;
}

// True if a picture of linear light has the codes of the stated background: it was not encoded, or it is read so.
bool is_given_in_codes(const SeenBackground& seen, const Color& given, pipeline::ColorSpace space) {
    return distance(seen.color, in_srgb(given, space)) <= two_codes;
}

std::string number_of(double v) {
    std::string text = fmt::format("{:.3f}", v);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

// As --background takes it.
std::string words_of(const Color& color) {
    return fmt::format("{},{},{}", number_of(color[0]), number_of(color[1]), number_of(color[2]));
}

Color given_background(const peeling::FrameRequest& input) {
    const auto& b = input.options.background;
    return {double{b[0]}, double{b[1]}, double{b[2]}};
}

// Options of a frame with one sample per pixel, which has no other position for colours.
peeling::RenderOptions options_of_one_sample(const peeling::FrameRequest& input) {
    peeling::RenderOptions options = input.options;
    options.raster.interpolation = rasterizer::Interpolation::sample;
    options.sampling = {};
    return options;
}

// Another way to draw the scene.
struct SceneVariant {
    std::string words{};  // "--samples 4"
    std::optional<Color> background{};
    std::optional<float> alpha{};  // --alpha
    int samples = 1;
    double right = 0, up = 0;  // moved by pixels
    std::optional<pipeline::PolygonMode> polygon_mode{};
    std::string_view without{};                             // an option that is given and left out: "--line-stipple"
    std::function<void(peeling::RenderOptions&)> change{};  // of other options
};

bool is_drawn_with(const pipeline::DrawList& list, std::initializer_list<pipeline::Primitive> any) {
    return std::ranges::any_of(
        list.meshes, [&](const pipeline::Mesh& mesh) { return std::ranges::find(any, mesh.primitive) != any.end(); });
}

// Other shapes of primitives, and other depths.
std::vector<SceneVariant> with_other_shapes(const peeling::FrameRequest& input) {
    using peeling::RenderOptions;
    using pipeline::Primitive;
    std::vector<SceneVariant> all;
    const auto& raster = input.options.raster;
    if (is_drawn_with(input.list, {Primitive::triangles}))
        for (const auto& [word, mode] :
             {std::pair{"line", pipeline::PolygonMode::line}, {"point", pipeline::PolygonMode::point}})
            all.push_back({.words = fmt::format("--polygon-mode {}", word), .polygon_mode = mode});
    constexpr std::array sizes{1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 8.0f, 10.0f};
    if (is_drawn_with(input.list, {Primitive::lines, Primitive::line_strips, Primitive::polygon_lines}))
        for (const float px : sizes)
            if (px != raster.line_width_px)
                all.push_back({.words = fmt::format("--line-width {}", px),
                               .change = [px](RenderOptions& o) { o.raster.line_width_px = px; }});
    if (is_drawn_with(input.list, {Primitive::points, Primitive::polygon_points}))
        for (const float px : sizes)
            if (px != raster.point_size_px)
                all.push_back({.words = fmt::format("--point-size {}", px),
                               .change = [px](RenderOptions& o) { o.raster.point_size_px = px; }});
    if (raster.line_stipple)
        all.push_back({.without = "--line-stipple", .change = [](RenderOptions& o) { o.raster.line_stipple.reset(); }});
    if (input.options.lights)
        all.push_back({.without = "--lights", .change = [](RenderOptions& o) { o.lights.reset(); }});
    else if (!input.list.lights.empty())
        all.push_back({.words = "--lights none", .change = [](RenderOptions& o) { o.lights.emplace(); }});
    for (const auto path : enum_values<rasterizer::DepthPath>)
        if (path != input.options.depth_path.value_or(input.profile.raster.depth_path))
            all.push_back({.words = fmt::format("--depth-path {}", enum_name(path)),
                           .change = [path](RenderOptions& o) { o.depth_path = path; }});
    for (SceneVariant& way : all) way.alpha = input.options.alpha;
    return all;
}

// Without the --alpha given, and with each that the picture shows.
std::vector<SceneVariant> with_other_alphas(const peeling::FrameRequest& input, const Colors& picture,
                                            const std::vector<std::uint32_t>& wrong,
                                            const std::optional<Color>& background) {
    std::vector<SceneVariant> all;
    if (input.options.sampling.samples > 1) return all;
    if (input.options.alpha) all.push_back({.background = background, .samples = 1});
    const Color behind = background.value_or(given_background(input));
    const rasterizer::Rect part = verdict::most_wrong(wrong, picture.width());
    for (const float alpha : seen_alphas(input, picture, behind, part))
        all.push_back(
            {.words = "--alpha " + number_of(double{alpha}), .background = background, .alpha = alpha, .samples = 1});
    return all;
}

std::vector<SceneVariant> ways(const peeling::FrameRequest& input, const Colors& picture,
                               const std::vector<std::uint32_t>& wrong, const std::optional<SeenBackground>& seen) {
    std::vector<SceneVariant> all;
    for (const bool is_seen : {false, true}) {
        if (is_seen && !seen) continue;
        const std::string words = is_seen ? "--background " + words_of(in_srgb(seen->color, input.space)) : "";
        const auto add = [&](const std::string& more, int samples, double right, double up) {
            SceneVariant way{
                words + (words.empty() || more.empty() ? "" : " ") + more, {}, input.options.alpha, samples, right, up};
            if (is_seen) way.background = seen->color;
            all.push_back(std::move(way));
        };
        if (is_seen) add("", input.options.sampling.samples, 0, 0);
        const std::optional<Color> background = is_seen ? std::optional{seen->color} : std::nullopt;
        for (SceneVariant& way : with_other_alphas(input, picture, wrong, background)) {
            if (is_seen) way.words = words + (way.words.empty() ? "" : " ") + way.words;
            all.push_back(std::move(way));
        }
        for (const int samples : {4, 2, 8, 1})
            if (samples != input.options.sampling.samples) add(fmt::format("--samples {}", samples), samples, 0, 0);
        if (input.options.sampling.samples > 1) continue;
        for (SceneVariant way : with_other_shapes(input)) {
            way.words = words + (words.empty() || way.words.empty() ? "" : " ") + way.words;
            way.background = background;
            all.push_back(std::move(way));
        }
        for (const double right : {-0.5, 0.0, 0.5})
            for (const double up : {-0.5, 0.0, 0.5})
                if (right != 0 || up != 0) add("", 1, right, up);
    }
    return all;
}

std::string moved(const SceneVariant& way) {
    std::string text;
    if (way.right != 0) text += way.right < 0 ? "left" : "right";
    if (way.up != 0) text += fmt::format("{}{}", text.empty() ? "" : " and ", way.up < 0 ? "down" : "up");
    return text.empty() ? "" : fmt::format("everything is half a pixel further {}", text);
}

pipeline::View moved_view(const peeling::FrameRequest& input, const SceneVariant& way) {
    pipeline::View view = input.view;
    const double x = 2 * way.right / input.options.width, y = 2 * way.up / input.options.height;
    for (int c = 0; c < 4; ++c) {
        view.projection[c][0] += x * view.projection[c][3];
        view.projection[c][1] += y * view.projection[c][3];
    }
    return view;
}

bool is_right_so(const peeling::FrameRequest& input, const SceneVariant& way, const Colors& picture,
                 const std::vector<std::uint32_t>& wrong, const IsDrawnBy& is_drawn) {
    const pipeline::View view = moved_view(input, way);
    std::optional<pipeline::DrawList> list;
    if (way.polygon_mode) list = with_polygon_mode(input.list, *way.polygon_mode);
    peeling::FrameRequest so{list ? *list : input.list, view, input.profile, input.options, input.space};
    so.options.sampling.samples = way.samples;
    if (way.samples == 1) so.options = options_of_one_sample(input);
    so.options.alpha = way.alpha;
    if (way.change) way.change(so.options);
    if (way.background)
        for (std::size_t c = 0; c < 3; ++c) so.options.background[c] = static_cast<float>((*way.background)[c]);
    if (is_drawn(so)) return true;
    if (way.samples == 1) return verdict::right_by_rules(so, {"", input.profile}, picture, wrong).has_value();
    for (const auto origin : {pipeline::Origin::upper_left, pipeline::Origin::lower_left}) {
        const OtherRules rules{"", with_origin(input.profile, origin), input.options.raster.interpolation};
        if (right_samples_by(rules, so, picture, wrong)) return true;
    }
    return false;
}

std::vector<std::size_t> neighbours(std::size_t pixel, std::size_t width, std::size_t pixels) {
    std::vector<std::size_t> all;
    const auto x = static_cast<std::ptrdiff_t>(pixel % width), y = static_cast<std::ptrdiff_t>(pixel / width);
    for (std::ptrdiff_t dy = -1; dy <= 1; ++dy)
        for (std::ptrdiff_t dx = -1; dx <= 1; ++dx) {
            const std::ptrdiff_t nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= static_cast<std::ptrdiff_t>(width)) continue;
            const auto n = static_cast<std::size_t>(ny) * width + static_cast<std::size_t>(nx);
            if (n < pixels) all.push_back(n);
        }
    return all;
}

// The number of wrong pixels at edges whose colour lies between those of their neighbours.
std::size_t smoothed(const Expected& right, const Colors& picture, const std::vector<std::uint32_t>& wrong) {
    const auto width = static_cast<std::size_t>(picture.width());
    return static_cast<std::size_t>(std::ranges::count_if(wrong, [&](std::uint32_t pixel) {
        Color low{1, 1, 1}, high{};
        bool is_edge = false;
        for (const std::size_t n : neighbours(pixel, width, right.color.size())) {
            is_edge = is_edge || right.nearest[n] != right.nearest[pixel];
            for (std::size_t c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], right.color[n][c]);
                high[c] = std::max(high[c], right.color[n][c]);
            }
        }
        const Color found = color_at(picture, pixel);
        for (std::size_t c = 0; c < 3; ++c)
            is_edge = is_edge && found[c] > low[c] - two_codes && found[c] < high[c] + two_codes;
        return is_edge;
    }));
}

// Of the pixels that are drawn here or there, those with the same colour.
struct Agreeing {
    std::size_t pixels = 0, of = 0;
};

Agreeing agreeing(const Expected& right, const Colors& picture, const Color& background) {
    Agreeing found;
    for (std::size_t i = 0; i < right.color.size(); ++i) {
        const Color value = color_at(picture, i);
        if (!right.is_drawn[i] && distance(value, background) <= two_codes) continue;
        ++found.of;
        found.pixels += distance(value, right.color[i]) <= two_codes ? 1 : 0;
    }
    return found;
}

// Of a variant with which the picture is right.
std::string sentence_of(const SceneVariant& way, const peeling::FrameRequest& input) {
    const std::string where = moved(way);
    const std::string_view without = input.options.alpha && !way.alpha ? "--alpha" : way.without;
    if (!without.empty())
        return fmt::format("without {}{} the picture is right", without,
                           way.words.empty() ? "" : " and with " + way.words);
    if (where.empty()) return fmt::format("looks forgotten: {}; with it the picture is right", way.words);
    if (way.words.empty()) return where + "; apart from that the picture is right";
    return fmt::format("looks forgotten: {}; and {}", way.words, where);
}

}  // namespace

Forgotten forgotten_alpha(const peeling::FrameRequest& input, const Colors& picture,
                          const std::vector<std::uint32_t>& wrong_pixels, const IsDrawnBy& is_drawn) {
    for (const SceneVariant& way : with_other_alphas(input, picture, wrong_pixels, std::nullopt))
        if (is_right_so(input, way, picture, wrong_pixels, is_drawn))
            return {.sentences = {sentence_of(way, input)}, .makes_right = true};
    return {};
}

Forgotten forgotten_options(const peeling::FrameRequest& input, const Colors& picture,
                            const std::vector<std::uint32_t>& wrong_pixels, const IsDrawnBy& is_drawn,
                            const std::string& camera, const ShowProgress& progress) {
    Forgotten found;
    std::vector<std::string>& sentences = found.sentences;
    const SceneFragments scene{input.with(options_of_one_sample(input)), input.options.fragment_memory};
    const Expected right = expected(scene);
    const Color given = given_background(input);
    auto seen = seen_background(right, picture, given);
    const bool is_in_codes = seen && is_given_in_codes(*seen, given, input.space);
    if (is_in_codes) seen.reset();
    const std::vector<SceneVariant> tried = ways(input, picture, wrong_pixels, seen);
    for (const SceneVariant& way : tried) {
        if (progress) progress(static_cast<double>(&way - tried.data()) / static_cast<double>(tried.size()));
        if (!is_right_so(input, way, picture, wrong_pixels, is_drawn)) continue;
        sentences.push_back(sentence_of(way, input));
        found.makes_right = true;
        return found;
    }
    if (is_in_codes) return found;  // values of another space: what they hint at would be false
    if (seen)
        sentences.push_back(
            fmt::format("looks forgotten: --background {}, the colour of {} of the {} pixels where nothing is drawn",
                        words_of(in_srgb(seen->color, input.space)), seen->pixels, seen->of));
    const Agreeing agree = agreeing(right, picture, seen ? seen->color : given);
    constexpr std::size_t few = 64;
    if (agree.of >= few && 10 * agree.pixels < agree.of)
        sentences.push_back(fmt::format(
            "another camera, size or scene? {} of the {} drawn pixels agree; compared with: {}, background {}",
            agree.pixels, agree.of, camera, words_of(in_srgb(given, input.space))));
    const std::size_t at_edges = smoothed(right, picture, wrong_pixels);
    if (input.options.sampling.samples == 1 && !seen && wrong_pixels.size() >= few / 4 &&
        10 * at_edges >= 9 * wrong_pixels.size())
        sentences.push_back(fmt::format(
            "{} of {} wrong pixels are at edges, between the colours of their neighbours: smoothed? --samples 2, 4 and "
            "8 were tried, and do not make the picture right",
            at_edges, wrong_pixels.size()));
    return found;
}

}  // namespace strata::oracle
