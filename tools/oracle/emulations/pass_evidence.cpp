// tools/oracle/emulations/pass_evidence.cpp - counts targets that agree with a candidate's after each pass, and
// decides whether a mistake explains where they begin to differ (pass_evidence.h).
#include "tools/oracle/emulations/pass_evidence.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/oracle/pack/pack_pictures.h"
#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

namespace {

// The number of codes that rounding can explain.
std::uint32_t rounding_of(Code code) noexcept {
    switch (code) {
        case Code::single: return 64;
        case Code::unorm24: return 16;
        case Code::half: return 2;
        case Code::unorm8:
        case Code::unorm10:
        case Code::unorm16:
        case Code::integer: break;
    }
    return 1;
}

// One target, or one for each sample, with the names that pack_pictures.h gives them.
std::vector<TargetImage> targets_of(const NamedImage& named) {
    const pipeline::Image& image = named.image;
    std::vector<TargetImage> targets;
    for (int sample = 0; sample < image.samples; ++sample) {
        pipeline::Image one{image.format, image.width, image.height};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < image.channels(); ++c)
                    one.codes[one.index(x, y, c)] = image.codes[image.index(x, y, c, sample)];
        targets.push_back(as_target(one, name_of_sample(named.name, sample, image.samples)));
    }
    return targets;
}

bool has_one_shape(const TargetImage& a, const TargetImage& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

// The largest distance of two codes.
std::uint32_t greatest_distance(const TargetImage& a, const TargetImage& b) {
    if (a.code == b.code && a.codes == b.codes) return 0;
    std::uint32_t greatest = 0;
    for (std::size_t i = 0; i < a.codes.size(); ++i)
        greatest = std::max(greatest, distance({a.code, a.codes[i]}, {b.code, b.codes[i]}));
    return greatest;
}

// The number of pixels with a channel that differs by more than `forgiven`; for unequal shapes, all.
std::uint64_t far_pixels(const TargetImage& a, const TargetImage& b, std::uint32_t forgiven) {
    if (!has_one_shape(a, b)) return a.pixels();
    const auto channels = static_cast<std::size_t>(a.channels);
    std::uint64_t far = 0;
    for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) {
        std::uint32_t apart = 0;
        for (std::size_t i = pixel * channels; i < (pixel + 1) * channels; ++i)
            apart = std::max(apart, distance({a.code, a.codes[i]}, {b.code, b.codes[i]}));
        far += apart > forgiven ? 1 : 0;
    }
    return far;
}

// True if the first difference is in a later pass than that of the correct run, which has one.
bool is_later(const std::optional<int>& emulation, const std::optional<int>& right) {
    return right && (!emulation || *emulation > *right);
}

}  // namespace

bool explains_origin(const PassAgreement& emulation, const PassAgreement& right) {
    const bool starts_there = emulation.first_far && emulation.first_far == right.first_far;
    const auto pass = static_cast<std::size_t>(right.first_far.value_or(0));
    const bool is_nearly = starts_there && 20 * emulation.far[pass] <= right.far[pass];
    return emulation.is_whole() || is_nearly || is_later(emulation.first_unlike, right.first_unlike) ||
           is_later(emulation.first_far, right.first_far);
}

void PassEvidence::add(const PassReport& pass, std::span<const TargetImage> instead) {
    if (pass.kind == ReportedPassKind::published) return;
    const auto other = std::ranges::find(candidate_, pass.number, &PassPicture::number);
    if (other == candidate_.end()) return;
    std::vector<TargetImage> targets;
    for (const NamedImage& image : pass.targets) std::ranges::move(targets_of(image), std::back_inserter(targets));
    for (const TargetImage& ours : targets) {
        const auto& all = other->targets.targets;
        const auto theirs = std::ranges::find(all, ours.name, &TargetImage::name);
        if (theirs == all.end()) continue;
        ++found_.targets;
        const bool fits = has_one_shape(ours, *theirs);
        std::uint32_t apart = fits ? greatest_distance(ours, *theirs) : 0;
        const auto other_form = std::ranges::find(instead, ours.name, &TargetImage::name);
        if (fits && apart > 0 && other_form != instead.end())
            apart = std::min(apart, greatest_distance(*other_form, *theirs));
        if (fits && apart == 0) {
            ++found_.alike;
            continue;
        }
        if (!found_.first_unlike) found_.first_unlike = pass.number;
        if (fits && apart <= rounding_of(ours.code)) continue;
        if (!found_.first_far) found_.first_far = pass.number;
        const auto number = static_cast<std::size_t>(pass.number);
        if (found_.far.size() <= number) found_.far.resize(number + 1);
        found_.far[number] += far_pixels(ours, *theirs, rounding_of(ours.code));
    }
}

}  // namespace strata::oracle
