// tools/oracle/picture/pairs.cpp - finds each target's partner and converts one of the two where channels, grey or
// alpha forms differ (pairs.h).
#include "tools/oracle/picture/pairs.h"

#include <fmt/format.h>

#include "rasterizer/base/input_error.h"
#include "tools/oracle/picture/other_size.h"

namespace strata::oracle {

namespace {

std::string place(const TargetImage& target) {
    return target.part.empty() ? target.name : fmt::format("{} of {}", target.name, target.part);
}

std::vector<const TargetImage*> of_meaning(const Picture& picture, Meaning meaning) {
    std::vector<const TargetImage*> found;
    for (const TargetImage& target : picture.targets)
        if (target.meaning == meaning) found.push_back(&target);
    return found;
}

const TargetImage* partner(const TargetImage& wanted, const Picture& reference, const Picture& candidate) {
    for (const TargetImage& target : candidate.targets)
        if (target.part == wanted.part && target.name == wanted.name) return &target;
    // A file of one image has no name for it, or another name than ours.
    const auto here = of_meaning(reference, wanted.meaning), there = of_meaning(candidate, wanted.meaning);
    return here.size() == 1 && there.size() == 1 ? there[0] : nullptr;
}

bool has_alpha(const TargetImage& t) noexcept { return t.channels == (t.is_grey ? 2 : 4); }
bool is_color(const TargetImage& t) noexcept { return t.meaning == Meaning::color && (t.is_grey || t.channels >= 3); }

// A target whose channels are given by `from`: a channel's index, or -1 for the code of 1.
TargetImage with_channels(const TargetImage& target, const std::vector<int>& from) {
    TargetImage made = target;
    made.channels = static_cast<int>(from.size());
    made.is_grey = target.is_grey && from.size() < 3;
    made.codes.clear();
    made.codes.reserve(target.pixels() * from.size());
    const std::uint32_t one = nearest(target.code, 1.0);
    for (std::size_t pixel = 0; pixel < target.pixels(); ++pixel)
        for (const int c : from) made.codes.push_back(c < 0 ? one : target.at(pixel, c).word);
    return made;
}

std::uint32_t times_alpha(const TargetImage& target, std::uint32_t code, std::uint32_t alpha) {
    if (target.code == Code::half || target.code == Code::single)
        return nearest(target.code, value(target.code, code) * value(target.code, alpha));
    const std::uint64_t one = nearest(target.code, 1.0), product = std::uint64_t{code} * alpha;
    return static_cast<std::uint32_t>((2 * product + one) / (2 * one));
}

}  // namespace

std::optional<TargetImage> premultiplied(const TargetImage& target) {
    if (!has_alpha(target) || target.code == Code::integer) return std::nullopt;
    const auto channels = static_cast<std::size_t>(target.channels);
    const std::uint32_t one = nearest(target.code, 1.0);
    TargetImage made = target;
    bool changes = false;
    for (std::size_t i = 0; i < target.codes.size(); i += channels) {
        const std::uint32_t alpha = target.codes[i + channels - 1];
        if (alpha == one) continue;
        changes = true;
        for (std::size_t c = 0; c + 1 < channels; ++c)
            made.codes[i + c] = times_alpha(target, target.codes[i + c], alpha);
    }
    made.alpha_form = AlphaForm::premultiplied;
    return changes ? std::optional{std::move(made)} : std::nullopt;
}

namespace {

// One of the two colours that are compared: an image's target, or one converted from it.
struct ComparedColor {
    const TargetImage* target;
    const char* whose;  // "the reference"
};

class Matcher {
  public:
    Matcher(Pairing& found, const std::string& target) : found_{found}, target_{target} {}

    void match(ComparedColor& a, ComparedColor& b, ColorChannels channels) {
        if (!is_color(*a.target) || !is_color(*b.target)) return;
        multiply(a, b);
        multiply(b, a);
        if (channels == ColorChannels::rgb) {
            if (has_alpha(*a.target) || has_alpha(*b.target))
                found_.not_compared.push_back(target_ + ": alpha, as --channels rgb asks");
            for (ComparedColor* side : {&a, &b})
                if (has_alpha(*side->target)) replace(*side, side->target->is_grey ? Order{0} : Order{0, 1, 2});
        }
        add_alpha(a, b);
        add_alpha(b, a);
        spread(a, b);
        spread(b, a);
    }

  private:
    using Order = std::vector<int>;

    void replace(ComparedColor& side, const Order& from) { replace(side, with_channels(*side.target, from)); }
    void replace(ComparedColor& side, TargetImage&& made) { side.target = &found_.made.emplace_back(std::move(made)); }

    void multiply(ComparedColor& side, const ComparedColor& other) {
        if (side.target->alpha_form != AlphaForm::straight || other.target->alpha_form != AlphaForm::premultiplied)
            return;
        auto made = premultiplied(*side.target);
        if (!made) return;
        replace(side, *std::move(made));
        found_.notes.push_back(
            fmt::format("{}: straight colours of {} are multiplied by their alpha, as those of {} are", target_,
                        side.whose, other.whose));
    }

    void add_alpha(ComparedColor& side, const ComparedColor& other) {
        if (has_alpha(*side.target) || !has_alpha(*other.target)) return;
        replace(side, side.target->is_grey ? Order{0, -1} : Order{0, 1, 2, -1});
        found_.notes.push_back(fmt::format("{}: {} has no alpha, which counts as 1", target_, side.whose));
    }

    void spread(ComparedColor& side, const ComparedColor& other) {
        if (!side.target->is_grey || other.target->is_grey) return;
        replace(side, has_alpha(*side.target) ? Order{0, 0, 0, 1} : Order{0, 0, 0});
        found_.notes.push_back(
            fmt::format("{}: {} is grey, which counts as equal red, green and blue", target_, side.whose));
    }

    Pairing& found_;
    std::string target_;
};

}  // namespace

Pairing pair_targets(const Picture& reference, const Picture& candidate, ColorChannels channels) {
    Pairing found;
    std::vector<const TargetImage*> taken;
    for (const TargetImage& target : reference.targets) {
        const TargetImage* const other = partner(target, reference, candidate);
        if (other == nullptr) {
            found.not_compared.push_back(fmt::format("{}: in the reference alone", place(target)));
            continue;
        }
        if (other->width != target.width || other->height != target.height)
            throw InputError(candidate.file, "size",
                             fmt::format("{}x{}, the reference's size", target.width, target.height),
                             size_in_words(target, *other));
        ComparedColor ours{&target, "the reference"}, theirs{other, "the candidate"};
        Matcher{found, place(target)}.match(ours, theirs, channels);
        if (ours.target->channels != theirs.target->channels)
            throw InputError(candidate.file, place(target),
                             fmt::format("{} channels, as in the reference", target.channels),
                             std::to_string(other->channels));
        found.pairs.push_back({ours.target, theirs.target});
        taken.push_back(other);
    }
    for (const TargetImage& target : candidate.targets)
        if (std::ranges::find(taken, &target) == taken.end())
            found.not_compared.push_back(fmt::format("{}: in the candidate alone", place(target)));
    if (found.pairs.empty())
        throw InputError(candidate.file, "targets", "a target that the reference has", place(candidate.targets.at(0)));
    return found;
}

}  // namespace strata::oracle
