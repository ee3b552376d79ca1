// tools/lab/hard_cases/moves/hard_flicker.cpp - renders a case along a camera path and counts pixels that change and
// change back while the exact answer stays (hard_flicker.h).
#include "tools/lab/hard_cases/moves/hard_flicker.h"

#include <algorithm>

#include "tools/lab/hard_cases/hard_exact.h"

namespace strata::tools {

struct PathCase::Frame {
    ExactCase exact;
    ResultPixels pixels;
    std::vector<bool> open;
};

namespace {

bool sees_alike(const ResultPixel& a, const ResultPixel& b) {
    return std::ranges::equal(a.fragments, b.fragments, {}, &ResultFragment::primitive, &ResultFragment::primitive);
}

// Numbers layers by exact depth; equal depths share a layer, as in ExactCase::visible_pixels.
void order_by_depth(const ExactCase& exact, std::size_t number, ResultPixel& pixel) {
    for (ResultFragment& f : pixel.fragments) f.depth = exact.depth_at(f.primitive, number);
    std::vector<ResultFragment*> order;
    for (ResultFragment& f : pixel.fragments) order.push_back(&f);
    std::ranges::stable_sort(order, {}, &ResultFragment::depth);
    int layer = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && order[i]->depth - order[i - 1]->depth > 0x1p-48) ++layer;
        order[i]->layer = layer;
    }
    pixel.layers = static_cast<int>(order.size());
}

}  // namespace

PathCase::PathCase(const scenes::HardCase& hard) : scene_{make_hard_case({}, hard)} {
    for (int i = 0; i < path_frames; ++i) {
        ExactCase exact{hard, scene_, view_on_path(scene_, i)};
        ResultPixels pixels = exact.visible_pixels();
        std::vector<bool> open = exact.open_pixels({});
        frames_.push_back({std::move(exact), std::move(pixels), std::move(open)});
    }
}

PathCase::~PathCase() = default;

Flicker PathCase::flicker(const std::function<ResultPixels(std::size_t frame)>& pixels_of) const {
    Flicker flicker;
    ResultPixels before = pixels_of(0);
    for (std::size_t i = 1; i < frames_.size() && !before.empty(); ++i) {
        ResultPixels after = pixels_of(i);
        const Frame &first = frames_[i - 1], &second = frames_[i];
        for (std::size_t p = 0; p < after.size(); ++p) {
            if (first.open[p] || second.open[p] || changes(first.pixels[p], second.pixels[p]).is_any()) continue;
            ++flicker.compared;
            if (!sees_alike(before[p], after[p]))
                ++flicker.coverage;
            else if (before[p].layers != after[p].layers || changes(before[p], after[p]).is_any())
                ++flicker.order;
        }
        before = std::move(after);
    }
    return flicker;
}

Flicker PathCase::flicker(const RenderFunction& render) const {
    return flicker(
        [&](std::size_t frame) { return render(scene_, view_on_path(scene_, static_cast<int>(frame))).pixels; });
}

Flicker PathCase::flicker_of_exact_depths(const RenderFunction& render) const {
    return flicker([&](std::size_t frame) {
        ResultPixels pixels = render(scene_, view_on_path(scene_, static_cast<int>(frame))).pixels;
        for (std::size_t p = 0; p < pixels.size(); ++p) order_by_depth(frames_[frame].exact, p, pixels[p]);
        return pixels;
    });
}

nlohmann::ordered_json to_json(const Flicker& flicker) {
    return {{"compared", flicker.compared}, {"order", flicker.order}, {"coverage", flicker.coverage}};
}

}  // namespace strata::tools
