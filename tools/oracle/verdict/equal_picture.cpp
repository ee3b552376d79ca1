// tools/oracle/verdict/equal_picture.cpp - finds the algorithm whose own picture the candidate equals: the stated one
// first, then the exact ones, in the formats of the file (equal_picture.h).
#include "tools/oracle/verdict/equal_picture.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "tools/oracle/picture/stored_like.h"
#include "tools/oracle/verdict/other_rules.h"
#include "tools/oracle/verdict/picture_verdict.h"

namespace strata::oracle::verdict {

namespace {

using pipeline::Format;

pipeline::Image within(const pipeline::Image& image, const rasterizer::Rect& rect) {
    pipeline::Image some{image.format, rect.x1 - rect.x0, rect.y1 - rect.y0};
    const auto channels = static_cast<std::size_t>(image.channels());
    const auto length = static_cast<std::size_t>(some.width) * channels;
    for (int y = 0; y < some.height; ++y) {
        const std::size_t from = static_cast<std::size_t>(y + rect.y0) * static_cast<std::size_t>(image.width) +
                                 static_cast<std::size_t>(rect.x0);
        std::copy_n(image.codes.begin() + static_cast<std::ptrdiff_t>(from * channels), length,
                    some.codes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * length));
    }
    return some;
}

// A finished picture as the candidate's file has it; empty if its codes are of another type.
std::optional<TargetImage> as_stored(const pipeline::Image& image, const PictureQuestion& question) {
    TargetImage own = as_target(image, "color");
    own.alpha_form = AlphaForm::premultiplied;
    const auto space = question.is_frame_linear ? pipeline::ColorSpace::linear : pipeline::ColorSpace::encoded;
    if (auto stored = stored_like(own, question.colors, space)) own = *std::move(stored);
    if (own.code != question.colors.code) return std::nullopt;
    return own;
}

// `own`: the picture within `rect`.
bool is_equal(const TargetImage& own, const PictureQuestion& question, const rasterizer::Rect& rect) {
    const TargetImage& candidate = question.colors;
    const int channels = candidate.is_grey    ? 3
                         : question.has_alpha ? candidate.channels
                                              : std::min(candidate.channels, 3);
    std::size_t part = 0;  // the pixel's number in `own`
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x, ++part) {
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(candidate.width) + static_cast<std::size_t>(x);
            for (int c = 0; c < std::min(channels, own.channels); ++c)
                if (own.at(part, c).word != candidate.at(pixel, candidate.is_grey ? 0 : c).word) return false;
        }
    return true;
}

bool keeps_ties(const peeling::Algorithm& algorithm) {
    return algorithm.ties != peeling::TiePolicy::unique && algorithm.ties != peeling::TiePolicy::merged;
}

// The stated algorithm first, else the usual ones; then every other exact one, but for several samples per pixel, where
// each picture is drawn once per sample.
std::vector<const peeling::Algorithm*> tried(const peeling::Algorithm* stated, int samples) {
    std::vector<const peeling::Algorithm*> all;
    if (stated != nullptr) all.push_back(stated);
    for (const char* usual : {"dual", "front_to_back", "a_buffer"})
        if (stated == nullptr) all.push_back(peeling::find_algorithm(usual));
    for (const peeling::Algorithm& a : peeling::algorithms())
        if (samples == 1 && a.exact && std::ranges::find(all, &a) == all.end() &&
            (stated == nullptr || keeps_ties(a) == keeps_ties(*stated)))
            all.push_back(&a);
    return all;
}

std::vector<std::optional<Format>> formats_of(const peeling::FrameRequest& input, Code code) {
    std::vector<std::optional<Format>> formats{input.options.color_format};
    if (code == Code::unorm8) formats.insert(formats.end(), {Format::rgba8, Format::rgba16f, Format::rgba32f});
    if (code == Code::half) formats.emplace_back(Format::rgba16f);
    if (code == Code::single) formats.emplace_back(Format::rgba32f);
    return formats;
}

}  // namespace

rasterizer::Rect fullest(const SceneFragments& scene) {
    constexpr int side = 32;
    const int columns = (scene.width() + side - 1) / side;
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(columns) *
                                      static_cast<std::size_t>((scene.height() + side - 1) / side));
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        const std::scoped_lock lock{mutex};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            counts[static_cast<std::size_t>(list.y / side * columns + list.x / side)] += list.visible.size();
        }
    });
    const int most = static_cast<int>(std::ranges::max_element(counts) - counts.begin());
    const int x = most % columns * side, y = most / columns * side;
    return {x, y, std::min(x + side, scene.width()), std::min(y + side, scene.height())};
}

std::string equal_algorithm(const peeling::FrameRequest& input, const PictureQuestion& question,
                            const rasterizer::Rect& part) {
    const rasterizer::Rect whole{0, 0, question.colors.width, question.colors.height};
    for (const std::optional<Format> format : formats_of(input, question.colors.code))
        for (const peeling::Algorithm* const algorithm : tried(question.algorithm, input.options.sampling.samples)) {
            const auto equals = [&](const rasterizer::Rect& rect) {
                peeling::RenderOptions options = rect == whole ? input.options : scissored(input.options, rect);
                options.audit = false;
                options.color_format = format;
                peeling::Renderer renderer{input.with(options)};
                const peeling::RenderResult drawn = renderer.render(*algorithm);
                const auto own = drawn.refusal ? std::nullopt : as_stored(within(drawn.frame.color, rect), question);
                return own && is_equal(*own, question, rect);
            };
            try {
                if (equals(part) && equals(whole)) return algorithm->name;
            } catch (const pipeline::Refused&) {
            }
        }
    return "";
}

}  // namespace strata::oracle::verdict
