// pipeline/region/region_control.cpp - how a region iterates, asks, stops and reports. The frame's side of it is executor.cpp.
#include <algorithm>
#include <cassert>

#include "pipeline/frame/verdict.h"
#include "pipeline/region/region.h"

namespace strata::pipeline {

void Region::begin_loop() {
    if (const std::size_t number = books_.loops.size(); number < books_.passes_before.size())
        books_.geometry_passes = books_.passes_before[number];
    books_.loops.emplace_back();
}

void Region::begin_iteration() {
    ++books_.iterations;
    ++books_.loops.back().iterations;
}

PassState Region::altered(const PassState& state, PassKind kind) {
    PassState changed = state;
    if (instruments_.alteration->pass) instruments_.alteration->pass(*this, changed, kind);
    return changed;
}

void Region::tell_alteration(PassKind kind, const Drawn& drawn) const {
    if (const Alteration* a = alteration(); a != nullptr && a->drawn) a->drawn(kind, drawn.passed.own_);
}

// A tile that counts nothing and has promised to be idle stops on its own word.
bool Region::any(Count count, Idle idle) {
    if (frame_.termination.rule == TerminationRule::fixed) return true;  // no query at all
    if (instruments_.log_passes) ++books_.pass_log.queries;
    if (!instruments_.trust_idle) idle = Idle::no;
    LoopBooks& loop = books_.loops.back();
    const std::size_t index = loop.decisions.size(), number = books_.loops.size() - 1;
    const bool is_known = number < books_.script.size() && index < books_.script[number].size();
    const bool finished = extent_ == Extent::tile && count.own_ == 0 && idle != Idle::no;
    bool answer = false;
    if (is_known) {
        answer = books_.script[number][index];
    } else if (extent_ == Extent::frame) {
        answer = continues(frame_.termination, frame_.rect(), count.own_);
    } else {
        answer = count.own_ > 0;
    }
    if (finished && !is_known) answer = false;
    if (const Alteration* a = alteration(); a != nullptr && a->query) answer = a->query(count.own_, answer);
    loop.decisions.push_back({count.own_, idle, answer});
    show({.step = Step::query, .passed = count.own_, .answer = answer});
    return answer;
}

// Both limits count geometry passes of the whole algorithm (keys-and-counts.md 3.2). Every region has made as many at
// this place, so all of them stop together.
bool Region::limit_reached(int passes) {
    const int fixed = frame_.termination.rule == TerminationRule::fixed ? frame_.termination.passes : 0;
    const int after = books_.geometry_passes + passes;
    return (frame_.max_passes > 0 && after > frame_.max_passes) || (fixed > 0 && after > fixed);
}

void Region::keep_layer(Target color, Target depth, Side side) {
    if (!frame_.keep_layers) return;
    books_.layers.push_back({image(color), image(depth), side});
}

void Region::keep_no_layer(Target color, Target depth) {
    if (!frame_.keep_layers) return;
    books_.layers.push_back({image(color), image(depth), Side::front});
    ++books_.idle_layers;
}

// Diagnostics name pixels of the window, not of the region.
void Region::report(Fault fault, std::uint64_t pixels, std::uint32_t first_pixel, std::string detail) {
    if (pixels == 0) return;
    const auto width = static_cast<std::uint32_t>(rect_.width());
    merge(books_.diagnostics, {fault, pixels, rect_.x0 + static_cast<int>(first_pixel % width),
                               rect_.y0 + static_cast<int>(first_pixel / width), std::move(detail)});
}

void Region::report(Fault fault, std::string detail) {
    merge(books_.diagnostics, {fault, 0, -1, -1, std::move(detail)});
}

namespace {

// Whether a word holds a channel whose exponent is all ones.
bool holds_non_finite(Word word, ChannelType type) noexcept {
    constexpr Word single = 0x7f800000u, half = 0x7c00u;
    if (type == ChannelType::single) return (word & single) == single;
    return (word & half) == half || (word >> 16 & half) == half;
}

struct FoundPixels {
    std::uint64_t pixels = 0;
    std::uint32_t first = 0;
};

FoundPixels non_finite_pixels(const TargetStorage& storage, ChannelType type) {
    FoundPixels found;
    for (std::uint32_t pixel = 0; pixel < storage.pixels(); ++pixel) {
        bool is_found = false;
        for (int sample = 0; sample < storage.samples(); ++sample) {
            const Texels texels = storage.texels(sample);
            for (std::size_t word = 0; word < texels.words(); ++word)
                is_found |= holds_non_finite(texels.plane(word).words[pixel], type);
        }
        if (is_found && found.pixels++ == 0) found.first = pixel;
    }
    return found;
}

}  // namespace

void Region::report_non_finite(Target published) {
    for (int id = 0; id < target_count(); ++id) {
        const bool is_opaque = id == opaque_depth_.id || id == opaque_color_.id;
        if (frame_.checks_targets ? is_opaque : id != published.id) continue;
        const TargetStorage& storage = storages_[static_cast<std::size_t>(id)];
        const ChannelType type = info(storage.format()).type;
        if (type != ChannelType::half && type != ChannelType::single) continue;
        if (std::ranges::find(cleared_non_finite_, id) != cleared_non_finite_.end()) continue;
        const FoundPixels found = non_finite_pixels(storage, type);
        const auto named = std::ranges::find(names_, id, &std::pair<int, std::string>::first);
        const std::string name = named != names_.end() ? named->second
                                 : id == published.id  ? "result"
                                                       : std::to_string(id);
        report(Fault::non_finite_target, found.pixels, found.first, "target " + name + " holds infinity or NaN");
    }
}

}  // namespace strata::pipeline
