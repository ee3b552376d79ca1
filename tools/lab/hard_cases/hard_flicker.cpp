#include "tools/lab/hard_cases/hard_flicker.h"

#include <algorithm>

#include "tools/lab/hard_cases/hard_exact.h"

namespace strata::tools {

struct PathCase::Frame {
    ExactCase exact;
    Seen seen;
    std::vector<bool> open;
};

namespace {

bool sees_alike(const SeenPixel& a, const SeenPixel& b) {
    return std::ranges::equal(a.fragments, b.fragments, {}, &SeenFragment::primitive, &SeenFragment::primitive);
}

// Numbers layers by exact depth; equal depths share a layer, as in ExactCase::seen.
void order_by_depth(const ExactCase& exact, std::size_t number, SeenPixel& pixel) {
    for (SeenFragment& f : pixel.fragments) f.depth = exact.depth_at(f.primitive, number);
    std::vector<SeenFragment*> order;
    for (SeenFragment& f : pixel.fragments) order.push_back(&f);
    std::ranges::stable_sort(order, {}, &SeenFragment::depth);
    int place = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && order[i]->depth - order[i - 1]->depth > 0x1p-48) ++place;
        order[i]->place = place;
    }
    pixel.layers = static_cast<int>(order.size());
}

}  // namespace

PathCase::PathCase(const scenes::HardCase& hard) : scene_{make_hard_case({}, hard)} {
    for (int i = 0; i < path_frames; ++i) {
        ExactCase exact{hard, scene_, view_on_path(scene_, i)};
        Seen seen = exact.seen();
        std::vector<bool> open = exact.open_pixels({});
        frames_.push_back({std::move(exact), std::move(seen), std::move(open)});
    }
}

PathCase::~PathCase() = default;

Flicker PathCase::flicker(const std::function<Seen(std::size_t frame)>& seen_at) const {
    Flicker flicker;
    Seen before = seen_at(0);
    for (std::size_t i = 1; i < frames_.size() && !before.empty(); ++i) {
        Seen after = seen_at(i);
        const Frame &first = frames_[i - 1], &second = frames_[i];
        for (std::size_t p = 0; p < after.size(); ++p) {
            if (first.open[p] || second.open[p] || changes(first.seen[p], second.seen[p]).is_any()) continue;
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

Flicker PathCase::flicker(const Look& look) const {
    return flicker([&](std::size_t frame) { return look(scene_, view_on_path(scene_, static_cast<int>(frame))).seen; });
}

Flicker PathCase::flicker_of_exact_depths(const Look& look) const {
    return flicker([&](std::size_t frame) {
        Seen seen = look(scene_, view_on_path(scene_, static_cast<int>(frame))).seen;
        for (std::size_t p = 0; p < seen.size(); ++p) order_by_depth(frames_[frame].exact, p, seen[p]);
        return seen;
    });
}

nlohmann::ordered_json to_json(const Flicker& flicker) {
    return {{"compared", flicker.compared}, {"order", flicker.order}, {"coverage", flicker.coverage}};
}

}  // namespace strata::tools
