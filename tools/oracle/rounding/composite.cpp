// tools/oracle/rounding/composite.cpp - the values that a hypothesis allows a stack of layers to have: OVER and UNDER
// of intervals, their background and the published result (composite.h).
#include "tools/oracle/rounding/composite.h"

#include <algorithm>
#include <cmath>

#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/rounding/remembered.h"

namespace strata::oracle::verdict {

namespace {

constexpr double last_places = 0x1p-20;  // least error of interpolation from moved positions
constexpr double srgb_error = 0x1p-21;   // of sRGB encoding in binary32

[[gnu::always_inline]] inline Interval clamped(Interval x) noexcept {
    return {std::min(std::max(x.low, 0.0), 1.0), std::min(std::max(x.high, 0.0), 1.0)};
}

// The value of the code to which `exact` is rounded, ties up, as for SourceRounding::stored. The interval is a single
// code if both of its ends round to that code.
[[gnu::always_inline]] inline Interval stored_up(const StorageRounding& keeper, Interval exact) noexcept {
    const auto code = [&](double v) {
        return std::min(std::max(StorageRounding::floor_of(v * keeper.scale + 0.5), 0.0), keeper.scale) *
               keeper.inverse;
    };
    return {code(exact.low), code(exact.high)};
}

Interval encoded(Interval linear) noexcept {
    const auto at = [](double v) { return double{remembered<scenes::encode_srgb>(static_cast<float>(v))}; };
    return {at(linear.low) - srgb_error, at(linear.high) + srgb_error};
}
Interval decoded(Interval encoded) noexcept {
    const auto at = [](double v) { return double{remembered<scenes::decode_srgb>(static_cast<float>(v))}; };
    return {at(encoded.low) - srgb_error, at(encoded.high) + srgb_error};
}

// sRGB targets round the encoded colour to a code; float targets store linear values.
[[gnu::always_inline]] inline Interval kept_by(const StorageRounding& keeper, Interval exact, double magnitude,
                                               bool is_linear) noexcept {
    if (!is_linear || !keeper.has_codes) return keeper.kept(exact, magnitude);
    return decoded(keeper.kept(encoded(exact), magnitude));
}

}  // namespace

Compositor::Means Compositor::means_of(const End& end, double slack) {
    Means m{.end = end, .slack = slack};
    m.source = conversion(end);
    m.blend = keeper(end.storage, end.rounding, has_stored_source(end.source));
    m.weight = m.blend;
    // UNDER multiplies three codes if its sources are straight. Its transmittance may be stored as coverage, which
    // truncation rounds in the opposite direction.
    const bool has_three = end.source == SourceRounding::stored || end.source == SourceRounding::stored_either_way;
    m.under = keeper(end.storage, end.rounding, has_stored_source(end.source) && !has_three);
    if (m.weight.truncates) m.weight.truncates = false, m.weight.minus = m.weight.plus = 1;
    return m;
}

Compositor::Operand Compositor::operand(const Means& means, const Layer& layer, bool is_moved) noexcept {
    const bool has_codes = means.blend.has_codes;
    const SourceRounding source = means.end.source;
    Operand o;
    o.color[3] = Interval::of(1);
    const double slack = means.slack + layer.slack + (is_moved ? layer.spread + last_places : 0);
    const auto given = [&](float v) {
        Interval x = Interval::of(v);
        if (slack > 0) x = x.widened(slack * std::max(1.0, std::fabs(double{v})));
        return has_codes ? clamped(x) : x;
    };
    const auto stored = [&](Interval x) {
        if (source == SourceRounding::unrounded) return x;
        if (!has_codes) return means.source.kept(x, x.magnitude());
        if (source == SourceRounding::any) return clamped(means.source.kept(x, 1));
        const bool goes_up = source == SourceRounding::stored || source == SourceRounding::premultiplied;
        return goes_up ? stored_up(means.source, x) : means.source.kept(x, 1);
    };
    if (layer.is_premultiplied) {
        for (std::size_t c = 0; c < 3; ++c) o.color[c] = stored(given(layer.color[c]));
        o.alpha = stored(given(layer.color[3]));
        o.is_premultiplied = true;
        return o;
    }
    const Interval alpha = clamped(given(layer.color[3]));
    o.alpha = clamped(stored(alpha));
    o.is_premultiplied = source == SourceRounding::premultiplied ||
                         source == SourceRounding::premultiplied_either_way ||
                         source == SourceRounding::premultiplied_truncated ||
                         source == SourceRounding::premultiplied_half || source == SourceRounding::premultiplied_unorm8;
    const double excess = std::max(1.0, double{layer.color[3]});  // of alpha
    for (std::size_t c = 0; c < 3; ++c) {
        const Interval color = given(layer.color[c]);
        // A program multiplies before its result is clamped: interpolation beyond an edge may exceed 1.
        const bool is_beyond = has_codes && (excess > 1 || layer.color[c] > 1 || layer.color[c] < 0);
        const Interval unclamped = is_beyond ? Interval::of(double{layer.color[c]} * excess).widened(slack) : color;
        if (!o.is_premultiplied) {
            o.color[c] = source == SourceRounding::unrounded ? hull(color, unclamped) : stored(color);
            continue;
        }
        // The product is first rounded to binary32; without slack that product is known exactly.
        const float known_color = has_codes ? std::clamp(layer.color[c], 0.0f, 1.0f) : layer.color[c];
        const bool is_known = slack == 0 && source == SourceRounding::premultiplied;
        Interval product = color * alpha;
        product =
            is_known ? Interval::of(known_color * layer.color[3]) : product.widened(product.magnitude() * 0x1p-23);
        if (is_beyond) product = hull(product, unclamped * alpha);
        o.color[c] = stored(product);
    }
    return o;
}

Compositor::Channels Compositor::under(const Means& means, std::span<const Layer> near_to_far,
                                       const Stack& stack) noexcept {
    const bool is_linear = stack.is_linear;
    const Mixing& mixing = stack.mixing;
    const bool has_few_bits = mixing.color_bits > 0;
    const StorageRounding color = has_few_bits ? few_bits(mixing.color_bits, means.end.rounding) : means.under;
    const StorageRounding weight = has_few_bits ? few_bits(mixing.weight_bits, means.end.rounding) : means.weight;
    Channels sum{Interval{}, Interval{}, Interval{}, Interval::of(1)};
    const bool may_be_rounded = means.end.source == SourceRounding::any;
    for (const Layer& layer : near_to_far) {
        const Operand o = operand(means, layer, stack.is_moved);
        if (!color.has_codes && o.alpha.high == 0 && !o.is_premultiplied) continue;  // multiplications by 1 are exact
        const Interval through = mixing.attenuates ? sum[3] : Interval::of(1);
        for (std::size_t c = 0; c < 3; ++c) {
            Interval premultiplied = o.is_premultiplied ? o.color[c] : o.color[c] * o.alpha;
            // A port may store this product as a layer before it is blended.
            if (may_be_rounded) premultiplied = means.source.kept(premultiplied, premultiplied.magnitude());
            Interval added = through * premultiplied;
            if (means.end.rounding == Rounding::products) added = means.under.kept(added, added.magnitude());
            const double least = sum[c].low;
            sum[c] = kept_by(color, sum[c] + added, sum[c].magnitude() + added.magnitude(), is_linear);
            // Rounding is monotone, so a sum of floats does not decrease by adding.
            if (!color.has_codes && layer.color[c] >= 0) sum[c].low = std::max(sum[c].low, least);
        }
        // The transmittance may be stored as coverage, 1 - t, so its error is relative to 1. Halves that are cut have
        // so narrow an interval that coverage is left to Rounding::any.
        Interval left = sum[3] * rest_of(mixing.through == Mixing::Through::squared ? o.alpha * o.alpha : o.alpha);
        if (mixing.through == Mixing::Through::summed)
            left = {below(sum[3].low - o.alpha.high), above(sum[3].high - o.alpha.low)};
        const double terms = weight.half == StorageRounding::Half::none ? 1 : sum[3].magnitude();
        sum[3] = clamped(weight.kept(clamped(left), terms));
    }
    return sum;
}

void Compositor::over(const Means& means, std::span<const Layer> near_to_far, const Stack& stack,
                      Channels& onto) noexcept {
    const bool is_linear = stack.is_linear;
    const bool may_be_rounded = means.end.source == SourceRounding::any;
    for (std::size_t i = near_to_far.size(); i-- > 0;) {
        Operand o = operand(means, near_to_far[i], stack.is_moved);
        if (stack.mixing.through == Mixing::Through::squared) {
            for (std::size_t c = 0; c < 3 && !o.is_premultiplied; ++c) o.color[c] = o.color[c] * o.alpha;
            o.is_premultiplied = true;
            o.alpha = o.alpha * o.alpha;
        }
        for (std::size_t c = 0; c < 4; ++c) {
            const double magnitude = o.color[c].magnitude() + onto[c].magnitude();
            Interval exact;
            if (means.end.rounding == Rounding::products) {
                const Interval product = o.alpha * o.color[c], behind = rest_of(o.alpha) * onto[c];
                exact = (o.is_premultiplied && c < 3 ? o.color[c] : means.blend.kept(product, 1)) +
                        means.blend.kept(behind, 1);
            } else if (o.is_premultiplied && c < 3) {
                exact = o.color[c] + rest_of(o.alpha) * onto[c];
            } else {
                exact = mixed(o.alpha, o.color[c], onto[c]);
                if (may_be_rounded && c < 3) {
                    const Interval product = o.alpha * o.color[c];
                    const Interval layer = means.source.kept(product, product.magnitude());
                    exact = hull(exact, layer + rest_of(o.alpha) * onto[c]);
                }
            }
            onto[c] = kept_by(means.blend, exact, magnitude, is_linear && c < 3);
        }
    }
}

Compositor::Channels Compositor::background_of(const Means& means, const Stack& stack) noexcept {
    Channels channels;
    const SourceRounding source = means.end.source;
    const StorageRounding to_nearest = keeper(means.end.storage, Rounding::nearest, false);
    for (std::size_t c = 0; c < 4; ++c) {
        Interval x = Interval::of(stack.background[c]);
        const double slack = means.slack + (stack.is_moved ? stack.background_spread + last_places : 0);
        if (slack > 0) x = x.widened(slack * std::max(1.0, x.magnitude()));
        if (layer_storage(source)) {
            channels[c] = means.source.kept(x, x.magnitude());
        } else if (!means.blend.has_codes) {
            channels[c] = means.blend.kept(x, x.magnitude());
            if (means.blend.half != StorageRounding::Half::none)  // a clear value is rounded, a picture is cut
                channels[c].high = std::max(channels[c].high, to_nearest.kept(x, x.magnitude()).high);
        } else if (stack.is_linear && c < 3)
            channels[c] = kept_by(means.blend, clamped(x), 1, true);
        else if (source == SourceRounding::stored || source == SourceRounding::premultiplied)
            channels[c] = stored_up(means.source, clamped(x));
        else
            channels[c] = means.source.kept(clamped(x), 1);
        // A clear value is rounded, a picture is truncated.
        if (source == SourceRounding::premultiplied_truncated && means.blend.has_codes)
            channels[c].high = std::max(channels[c].high, stored_up(to_nearest, clamped(x)).high);
    }
    return channels;
}

Compositor::Compositor(const Hypothesis& h)
    : hypothesis_{h},
      front_{means_of(h.front, h.slack)},
      back_{means_of(h.back, h.slack)},
      result_{storing(h.result, h.is_divided)},
      converts_{h.result.storage != h.back.storage || h.back.rounding == Rounding::held ||
                h.back.rounding == Rounding::held_then_nearest || h.result.rounding == Rounding::any} {}

Sums Compositor::sums_of(const Stack& stack, const Channels& front, Interval weight,
                         const Channels& back) const noexcept {
    const Means& nearer = has_front(hypothesis_.order) ? front_ : back_;
    const bool is_plain = !stack.is_linear && stack.finish == Finish::as_is && stack.mixing == Mixing{};
    const auto ends_in_codes = [](const Means& means) {
        return means.blend.has_codes && (means.blend.snaps || means.end.rounding == Rounding::held_then_nearest);
    };
    // A sum that is rounded to binary16 again shows nothing of halves.
    const bool is_half =
        nearer.end.storage == Storage::half && hypothesis_.result.storage == Storage::single && !hypothesis_.is_divided;
    if (result_.has_codes || !is_plain || (!is_half && !ends_in_codes(nearer))) return {};
    const double rounded = hypothesis_.result.storage == Storage::half ? 0x1p-10 : 0x1p-24;
    Sums sums{.front_unit = is_half ? 0 : nearer.blend.inverse,
              .is_front_half = is_half,
              .weight = weight,
              .relative = rounded + 2 * single_error};
    if (ends_in_codes(back_)) sums.back_unit = back_.blend.inverse;
    sums.is_back_half = hypothesis_.back.storage == Storage::half;
    std::copy_n(front.begin(), 3, sums.front.begin());
    std::copy_n(back.begin(), 3, sums.back.begin());
    return sums;
}

bool Compositor::can_mix(const Stack& stack) const noexcept {
    Mixing mixing = stack.mixing;
    // `over` also supports alpha squared in both factors.
    if (hypothesis_.order == Order::over) mixing.through = Mixing::Through::product;
    return has_front(hypothesis_.order) || (mixing == Mixing{} && stack.mixing.through != Mixing::Through::summed);
}

std::size_t Compositor::near_of(const Stack& stack) const noexcept {
    switch (hypothesis_.order) {
        case Order::under: return stack.layers.size();
        case Order::both_ends:
        case Order::both_ends_apart: return stack.near;
        case Order::both_ends_far: return stack.near_without_middle;
        case Order::over:
        case Order::over_apart: break;
    }
    return 0;
}

ReachableColor Compositor::reach(const Stack& stack) const noexcept {
    return reach_of(stack,
                    [](KnownEnds::Part, const Means&, std::size_t, const auto& make) -> Channels { return make(); });
}

ReachableColor Compositor::reach(const Stack& stack, KnownEnds& known) const {
    constexpr std::size_t few = 4;  // layers that are composited as quickly as they are found
    if (stack.layers.size() < few) return reach(stack);
    return reach_of(stack,
                    [&](KnownEnds::Part part, const Means& means, std::size_t near, const auto& make) -> Channels {
                        return known.of(part, means.end, means.slack, near, make);
                    });
}

ReachableColor Compositor::reach_of(const Stack& stack, const auto& ends) const {
    const Order order = hypothesis_.order;
    if (!can_mix(stack)) {
        constexpr Interval none{1, 0};
        return {{none, none, none, none}, {}};
    }
    const std::span<const Layer> near_to_far = stack.layers;
    const std::size_t near = near_of(stack);
    const Channels behind = ends(KnownEnds::Part::background, back_, 0, [&] { return background_of(back_, stack); });
    const bool is_apart = order == Order::over_apart || order == Order::both_ends_apart;
    Channels back = ends(is_apart ? KnownEnds::Part::back_apart : KnownEnds::Part::back, back_, near, [&] {
        Channels onto = is_apart ? Channels{} : behind;
        over(back_, near_to_far.subspan(near), stack, onto);
        return onto;
    });
    const auto published = [&](std::size_t c, Interval exact, double magnitude) {
        if (c < 3 && stack.finish == Finish::encoded) return result_.kept(encoded(clamped(exact)), magnitude);
        if (c < 3 && stack.finish == Finish::decoded) return result_.kept(decoded(clamped(exact)), magnitude);
        return result_.kept(stack.is_linear && c < 3 ? encoded(exact) : exact, magnitude);
    };
    // A port may compute the transmittance as 1 - coverage, with an error of half a unit in the last place of 1 each
    // time.
    const auto read = [&](Interval through) { return result_.has_codes ? through : through.widened(0x1p-23); };
    const bool converts = converts_ || stack.finish != Finish::as_is;
    ReachableColor reach;
    if (is_apart) {
        const Interval through = read(clamped(rest_of(back[3])));
        if (!has_front(order)) reach.sums = sums_of(stack, back, through, behind);
        for (std::size_t c = 0; c < 4; ++c) {
            const Interval added = through * behind[c];
            back[c] = has_front(order) ? back[c] + added
                                       : published(c, back[c] + added, back[c].magnitude() + added.magnitude());
        }
        if (!has_front(order)) {
            reach.channels = back;
            return reach;
        }
    }
    if (!has_front(order)) {
        reach.sums = sums_of(stack, back, {}, {});
        for (std::size_t c = 0; c < 4; ++c) {
            const bool is_encoded = stack.is_linear && c < 3;
            reach[c] = converts ? published(c, back[c], back[c].magnitude()) : is_encoded ? encoded(back[c]) : back[c];
        }
        return reach;
    }
    const Channels front =
        ends(KnownEnds::Part::front, front_, near, [&] { return under(front_, near_to_far.first(near), stack); });
    const Mixing& mixing = stack.mixing;
    Interval weight = read(front[3]);
    if (!is_apart || front_.end.storage == Storage::half) reach.sums = sums_of(stack, front, weight, back);
    if (is_apart) reach.sums.back_unit = 0, reach.sums.is_back_half = false;  // a sum over the background
    if (mixing.behind == Mixing::Behind::twice) weight = weight * weight;
    if (mixing.behind == Mixing::Behind::inverted && near > 0) weight = rest_of(weight);
    for (std::size_t c = 0; c < 3; ++c) {
        const Interval added = weight * back[c];
        Interval exact = front[c] + added;
        if (mixing.picture_too) exact = few_bits(mixing.color_bits, front_.end.rounding).kept(exact, 1);
        reach[c] = published(c, exact, front[c].magnitude() + added.magnitude());
    }
    // Alpha is 1 - transmittance, plus the transmittance times the alpha behind it.
    const Interval alpha = mixed(front[3], back[3], Interval::of(1));
    reach[3] = published(3, alpha, 1);
    return reach;
}

}  // namespace strata::oracle::verdict
