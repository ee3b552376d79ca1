// tools/strata/render/map.cpp - computes a number per pixel (layers, ties, error) and draws it from black to white
// (map.h).
#include "tools/strata/render/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peeling/audit/image_error.h"
#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "tools/strata/report/survey.h"

namespace strata::tools {

namespace {

// The sums over all samples of the numbers that `count(fragments)` returns for one.
template <class Count>
std::vector<double> sum_of_samples(const peeling::FrameFragments& found, const Count& count) {
    std::vector<double> sums = count(found.of_sample(0));
    for (std::size_t sample = 1; sample < found.samples; ++sample) {
        const std::vector<double> numbers = count(found.of_sample(sample));
        for (std::size_t pixel = 0; pixel < sums.size(); ++pixel) sums[pixel] += numbers[pixel];
    }
    return sums;
}

Columns columns(const peeling::FrameFragments& of_sample) { return columns_of(of_sample.all, of_sample.opaque.size()); }

std::vector<double> complexity(const Columns& columns) {
    std::vector<double> numbers;
    for (std::size_t pixel = 0; pixel + 1 < columns.first.size(); ++pixel)
        numbers.push_back(columns.first[pixel + 1] - columns.first[pixel]);
    return numbers;
}

// The number of tied fragments of each pixel. Codes are sorted and compared, because two different codes may have the
// same float depth.
std::vector<double> ties(const Columns& columns) {
    std::vector<double> numbers;
    std::vector<std::uint32_t> codes;
    for (std::size_t pixel = 0; pixel + 1 < columns.first.size(); ++pixel) {
        codes.clear();
        for (std::uint32_t f = columns.first[pixel]; f < columns.first[pixel + 1]; ++f)
            codes.push_back(columns.fragments[f].code);
        std::ranges::sort(codes);
        int tied = 0;
        for (std::size_t i = 0; i < codes.size(); ++i)
            tied += (i > 0 && codes[i] == codes[i - 1]) || (i + 1 < codes.size() && codes[i] == codes[i + 1]) ? 1 : 0;
        numbers.push_back(tied);
    }
    return numbers;
}

// The number of fragments of each pixel whose code is equal to that of the pixel's opaque surface.
std::vector<double> opaque_ties(const RunOptions& options, rasterizer::DepthFormat format,
                                const peeling::FrameFragments& found) {
    const bool is_reversed = options.render.raster.depth_order == rasterizer::DepthOrder::greater;
    const std::uint32_t far = is_reversed ? 0 : rasterizer::max_code(format);
    std::vector<double> numbers(found.opaque.size());
    for (const pipeline::CapturedFragment& f : found.all)
        if (f.code == found.opaque[f.pixel] && f.code != far) ++numbers[f.pixel];
    return numbers;
}

std::vector<double> errors(const RunOptions& options, const CompletedRun& finished) {
    const peeling::RenderResult exact = finished.renderer.render(*peeling::find_algorithm("a_buffer"));
    if (exact.refusal) throw pipeline::Refused{finished.session.profile, *exact.refusal};
    const pipeline::Image difference = peeling::difference(finished.result.frame.color, exact.frame.color);
    std::vector<double> numbers;
    for (int y = 0; y < options.render.height; ++y)
        for (int x = 0; x < options.render.width; ++x) {
            double most = 0;
            for (int c = 0; c < 3; ++c)
                most = std::max(most, std::fabs(double{peeling::channel_value(difference, x, y, c)}));
            numbers.push_back(255 * most);
        }
    return numbers;
}

std::vector<double> numbers_of(Map map, const RunOptions& options, const CompletedRun& finished) {
    using peeling::FrameFragments;
    peeling::Renderer& renderer = finished.renderer;
    const peeling::Algorithm& exact = *peeling::find_algorithm("a_buffer");
    switch (map) {
        case Map::depth_complexity:
            return sum_of_samples(renderer.fragments(exact),
                                  [](const FrameFragments& found) { return complexity(columns(found)); });
        case Map::ties:
            return sum_of_samples(renderer.fragments(exact),
                                  [](const FrameFragments& found) { return ties(columns(found)); });
        case Map::opaque_ties:
            return sum_of_samples(renderer.fragments(finished.algorithm), [&](const FrameFragments& found) {
                return opaque_ties(options, renderer.depth_format(), found);
            });
        case Map::error: break;
    }
    return errors(options, finished);
}

// The colour ramp black, red, yellow, white: in each third of the range one channel rises, first red, then green, then
// blue.
std::uint32_t heat(double share, int channel) {
    return static_cast<std::uint32_t>(std::clamp(3 * share - channel, 0.0, 1.0) * 255 + 0.5);
}

}  // namespace

MapPicture map_of(Map map, const RunOptions& options, const CompletedRun& finished) {
    const int width = options.render.width, height = options.render.height;
    MapPicture picture{numbers_of(map, options, finished), 0, {pipeline::Format::rgba8, width, height}};
    picture.most = *std::max_element(picture.numbers.begin(), picture.numbers.end());
    for (std::size_t pixel = 0; pixel < picture.numbers.size(); ++pixel) {
        const double share = picture.most > 0 ? picture.numbers[pixel] / picture.most : 0;
        for (int c = 0; c < 4; ++c)
            picture.image.codes[4 * pixel + static_cast<std::size_t>(c)] = c == 3 ? 255 : heat(share, c);
    }
    return picture;
}

std::string legend_of(Map map, const MapPicture& picture) {
    return fmt::format("{}: black is 0, white is {:.6g}{}\n", name_of(map_names(), map), picture.most,
                       map == Map::error ? " of 255" : "");
}

const std::vector<Choice<Map>>& map_names() {
    static const std::vector<Choice<Map>> names{{"depth-complexity", Map::depth_complexity},
                                                {"ties", Map::ties},
                                                {"opaque-ties", Map::opaque_ties},
                                                {"error", Map::error}};
    return names;
}

}  // namespace strata::tools
