// pipeline/region/region_control.cpp - how a region iterates, asks and stops. The frame's side of it is executor.cpp.
#include <cassert>
#include <utility>

#include "pipeline/frame/effects.h"
#include "pipeline/frame/verdict.h"
#include "pipeline/region/region.h"

namespace strata::pipeline {

void Region::begin_iteration() {
    join_tail();
    counted_record_ = records_.size();
    records_.emplace_back();
    ++iterations_;
}

// Whatever followed a "no" that did not end the loop belongs to the iteration in which it was said.
void Region::join_tail() {
    const auto last = static_cast<std::size_t>(iterations_);
    if (records_.size() <= last + 1) return;
    records_[last].counters += records_.back().counters;
    records_[last].passes += records_.back().passes;
    records_.pop_back();
}

bool Region::stop_iterating() {
    join_tail();
    counted_record_ = records_.size();  // what follows the last iteration
    records_.emplace_back();
    return false;
}

// A tile that counts nothing and has promised to be idle stops on its own word. With Idle::when_zero it first goes through one
// more iteration, the probe, because literal execution would: its counters are those of every iteration that the frame still runs.
bool Region::any(Count count, Idle idle) {
    if (frame_.termination.rule == TerminationRule::fixed) return true;  // no query at all
    if (frame_.pass_log != nullptr) ++frame_.pass_log->queries;
    if (!frame_.trust_idle) idle = Idle::no;
    const std::size_t index = decisions_.size();
    const bool finished = extent_ == Extent::tile && count.own_ == 0 && idle != Idle::no;
    bool answer = false;
    if (index < script_.size()) {
        answer = script_[index];
    } else if (extent_ == Extent::frame) {
        answer = continues(frame_.termination, frame_.rect(), count.own_);
    } else {
        answer = count.own_ > 0;
    }
    if (finished && index >= script_.size()) {
        if (idle_from_ < 0) idle_from_ = iterations_ + (idle == Idle::steady ? 0 : 1);
        probed_ = probing_;
        answer = idle == Idle::when_zero && !std::exchange(probing_, true);
    }
    decisions_.push_back({count.own_, idle, answer});
    return answer ? true : stop_iterating();
}

bool Region::limit_reached(int passes) {
    const int fixed = frame_.termination.rule == TerminationRule::fixed ? frame_.termination.passes : 0;
    const int after = geometry_passes_ + passes;
    const bool reached = (frame_.max_passes > 0 && after > frame_.max_passes) || (fixed > 0 && after > fixed);
    return reached ? !stop_iterating() : false;
}

void Region::keep_layer(Target color, Target depth) {
    if (!frame_.keep_layers) return;
    layers_.push_back({image(color), image(depth)});
    if (probing_) ++idle_layers_;
}

void Region::report(Fault fault, std::uint64_t pixels, std::uint32_t first_pixel, std::string detail) {
    if (pixels == 0) return;
    const auto width = static_cast<std::uint32_t>(rect_.width());
    merge(diagnostics_, {fault, pixels, rect_.x0 + static_cast<int>(first_pixel % width),
                         rect_.y0 + static_cast<int>(first_pixel / width), std::move(detail)});
}

}  // namespace strata::pipeline
