// tools/lab/hard_cases/hard_truth.cpp - composites the device's own fragments exactly, and compares a picture with that
// (hard_truth.h). hard_exact.h computes the fragments themselves exactly.
#include "tools/lab/hard_cases/hard_truth.h"

#include <algorithm>
#include <cmath>

#include "peeling/audit/image_error.h"
#include "peeling/registry.h"
#include "peeling/render.h"
#include "tools/lab/hard_cases/composited.h"

namespace strata::tools {

using namespace pipeline;

namespace {

peeling::RenderResult opaque_picture(const scenes::Scene& scene, const DeviceProfile& profile,
                                     const peeling::RenderOptions& options) {
    DrawList opaque = scene.list;
    std::erase_if(opaque.instances, [](const Instance& instance) { return instance.material == 0; });
    return peeling::Renderer{opaque, *scene.own_view, profile, options}.render(*peeling::find_algorithm("unsorted"));
}

}  // namespace

HardTruth::HardTruth(const scenes::Scene& scene, const DeviceProfile& profile, const peeling::RenderOptions& options)
    : background_{opaque_picture(scene, profile, options).frame.color} {
    DeviceProfile exact = profile;
    exact.has_d32f = true;
    peeling::RenderOptions with_floats = options;
    with_floats.depth = DepthFormat::d32f;
    with_floats.depth_path = rasterizer::DepthPath::exact;
    peeling::Renderer renderer{scene.list, *scene.own_view, exact, with_floats};
    const peeling::Algorithm& oracle = *peeling::find_algorithm("a_buffer");
    // If the device refuses the frame there are no fragments.
    if (background_.codes.empty()) return;
    for (const CapturedFragment& f : renderer.fragments(oracle).all)
        depths_.push_back({f.pixel, f.primitive, f.exact_code});
    std::sort(depths_.begin(), depths_.end());
}

HardTruth::Order HardTruth::order(std::size_t pixel, const std::vector<VisibleFragment>& visible,
                                  bool keeps_numbers) const {
    Order order;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const CapturedFragment& f = *visible[i].fragment;
        const auto found = std::lower_bound(depths_.begin(), depths_.end(), KnownDepth{pixel, f.primitive, 0});
        const bool is_known =
            keeps_numbers && found != depths_.end() && found->pixel == pixel && found->primitive == f.primitive;
        order.emplace_back(is_known ? found->code : f.exact_code, i);
    }
    std::sort(order.begin(), order.end());
    return order;
}

std::array<double, 3> HardTruth::color(std::size_t pixel, const std::vector<VisibleFragment>& visible,
                                       const Order& near_to_far) const {
    const auto x = static_cast<int>(pixel % static_cast<std::size_t>(background_.width));
    const auto y = static_cast<int>(pixel / static_cast<std::size_t>(background_.width));
    std::array<double, 3> sum{};
    for (std::size_t c = 0; c < 3; ++c) {
        sum[c] = peeling::channel_value(background_, x, y, static_cast<int>(c));
        for (std::size_t i = near_to_far.size(); i-- > 0;) {
            const Rgba& source = visible[near_to_far[i].second].fragment->color;
            const double alpha = source[3], value = source[static_cast<int>(c)];
            sum[c] = alpha * value + (1 - alpha) * sum[c];
        }
        if (background_.format == Format::rgba8) sum[c] = std::clamp(sum[c], 0.0, 1.0);
    }
    return sum;
}

bool HardTruth::is_background(std::size_t pixel, const Image& picture) const {
    const auto channels = static_cast<std::ptrdiff_t>(picture.channels());
    const auto first = static_cast<std::ptrdiff_t>(pixel) * channels;
    const auto begin = picture.codes.begin() + first;
    return std::equal(begin, begin + channels, background_.codes.begin() + first);
}

HardTruth::Difference HardTruth::difference(const ComposedFrame& frame, const Image& picture) const {
    Difference worst;
    const auto pixels = composed_pixels(frame);
    const ComposedPixel nothing{};
    auto next = pixels.begin();
    // An algorithm that sorts triangles renumbers them.
    const bool keeps_numbers = frame.algorithm.order == peeling::ListOrder::given;
    for (std::size_t p = 0; p < frame.fragments.opaque.size(); ++p) {
        const bool is_composed = next != pixels.end() && next->pixel == p;
        if (!is_composed && is_background(p, picture)) continue;
        const auto& visible = (is_composed ? *next++ : nothing).visible;
        const Order near_to_far = order(p, visible, keeps_numbers);
        const bool is_tied =
            std::adjacent_find(near_to_far.begin(), near_to_far.end(),
                               [](const auto& a, const auto& b) { return a.first == b.first; }) != near_to_far.end();
        const std::array<double, 3> truth = color(p, visible, near_to_far);
        double& place = is_tied || has_tie(visible) ? worst.at_ties : worst.elsewhere;
        for (int c = 0; c < 3; ++c) {
            const auto width = static_cast<std::size_t>(picture.width);
            const double shown =
                peeling::channel_value(picture, static_cast<int>(p % width), static_cast<int>(p / width), c);
            const double off = std::fabs(shown - truth[static_cast<std::size_t>(c)]) * 255;
            // NaN is counted elsewhere and is not a maximum here.
            if (off > place) place = off;
        }
    }
    return worst;
}

}  // namespace strata::tools
