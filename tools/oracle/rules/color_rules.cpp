// tools/oracle/rules/color_rules.cpp - the parts of StackMaker that apply rules (rule.h: the possible mistakes of a
// port) to the colours of layers, to sums of layers and to the background.
#include <algorithm>
#include <cmath>

#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/rounding/remembered.h"
#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

namespace {

float within(float weight) noexcept { return std::min(std::max(weight, 0.01f), 3000.0f); }
float power(float x, int n) noexcept { return n == 1 ? x : x * power(x, n - 1); }
// The weight of a fragment's colour (not premultiplied) in RuleKind::averaged, by rule.n. 0 and 1: alpha, as Bavoil and
// Myers 2008; 2: Mol* 5.6, wboit-write.glsl.js; 3 and 4: McGuire and Bavoil 2013, equation 10, with alpha once more and
// without; 5: their equation 9 with window depths; 6: LearnOpenGL's chapter "Weighted, Blended".
float weight_of(const Fragment& f, float alpha, std::uint32_t n) noexcept {
    const float near = 1 - f.shader_z;
    switch (n) {
        case 2: return alpha * alpha * std::min(std::max(near * near, 0.01f), 1.0f);
        case 3: return alpha * alpha * std::max(0.01f, 3000 * near * near * near);
        case 4: return alpha * std::max(0.01f, 3000 * near * near * near);
        case 5: return alpha * within(0.03f / (1e-5f + power(0.8f * f.shader_z, 4)));
        case 6:
            return alpha *
                   within(power(std::min(1.0f, alpha * 10) + 0.01f, 3) * 1e8f * power(1 - 0.9f * f.shader_z, 3));
        default: return alpha;
    }
}

template <auto change>
Rgba with_each(const Rgba& color) {
    return {remembered<change>(color[0]), remembered<change>(color[1]), remembered<change>(color[2]), color[3]};
}

}  // namespace

// composed_twice: replaces the layers by their composite over transparent black, as one layer that is not
// premultiplied. Blending it over the background applies its alpha a second time.
void StackMaker::combine_with_background(const Rule& rule) {
    if (items_.empty()) return;
    if (rule.kind == RuleKind::composed_twice) {
        Rgba sum{0, 0, 0, 1};  // alpha: the transmittance
        for (const Item& item : items_) {
            const Rgba& color = item.layer.color;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += sum[3] * color[3] * color[c];
            sum[3] *= 1 - color[3];
        }
        sum[3] = 1 - sum[3];
        // The port may have stored this sum in an rgba8 target: one code of error is allowed.
        items_[0].layer = {.color = sum, .slack = 1.0f / 255};
        return keep(0, 1);
    }
}

// Replaces all layers (rest_averaged: all but the nearest n) by their average or sum. Other kinds of rules are ignored.
void StackMaker::combine(const Rule& rule) {
    combine_with_background(rule);
    const bool averages = rule.kind == RuleKind::averaged || rule.kind == RuleKind::rest_averaged;
    if (!averages && rule.kind != RuleKind::added && rule.kind != RuleKind::weighted_sum) return;
    const std::size_t from = rule.kind == RuleKind::rest_averaged ? rule.n : 0;
    if (from >= items_.size()) return;
    // The average of one layer is that layer.
    if (averages && items_.size() - from == 1) return;
    const std::uint32_t weights = rule.kind == RuleKind::averaged ? rule.n : rule.value == 0 ? 1 : 0;
    Rgba sum{0, 0, 0, 0};
    float all_weights = 0, through = 1;
    for (std::size_t i = from; i < items_.size(); ++i) {
        const Rgba& color = items_[i].layer.color;
        const float weight = averages ? weight_of(*items_[i].fragment, color[3], weights) : color[3];
        for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c] * weight;
        sum[3] += color[3];
        all_weights += weight;
        through *= 1 - color[3];
    }
    const auto count = static_cast<float>(items_.size() - from);
    Layer one{.color = sum, .is_premultiplied = true};
    for (std::size_t i = from; i < items_.size(); ++i) one.spread = std::max(one.spread, items_[i].layer.spread);
    if (rule.kind == RuleKind::added) one.color[3] = 0;
    if (averages) {
        one.is_premultiplied = false;
        for (std::size_t c = 0; c < 3; ++c) one.color[c] = all_weights > 0 ? sum[c] / all_weights : 0;
        float same = 1;  // (1 - mean alpha)^count
        for (float i = 0; i < count; ++i) same *= 1 - sum[3] / count;
        one.color[3] = 1 - (weights == 0 ? same : through);
    }
    items_[from].layer = one;
    keep(0, from + 1);
}

void StackMaker::recolor(const Rule& rule) {
    for (std::size_t i = 0; i < items_.size(); ++i) {
        Item& item = items_[i];
        if (rule.scope == Scope::layer && i != rule.of) continue;
        if (rule.scope == Scope::layer_from_far && items_.size() - 1 - i != rule.of) continue;
        if (!is_in(rule, *item.fragment)) continue;
        Rgba& color = item.layer.color;
        switch (rule.kind) {
            case RuleKind::alpha_squared: color[3] *= color[3]; break;
            case RuleKind::alpha_inverted: color[3] = 1 - color[3]; break;
            case RuleKind::alpha_ignored: color[3] = 1; break;
            case RuleKind::alpha_times: color[3] = std::min(color[3] * rule.value, 1.0f); break;
            case RuleKind::premultiplied_twice:
                for (std::size_t c = 0; c < 3; ++c) color[c] *= color[3];
                break;
            case RuleKind::not_premultiplied: item.layer.is_premultiplied = true; break;
            case RuleKind::red_for_blue: std::swap(color[0], color[2]); break;
            case RuleKind::solid:
                for (std::size_t c = 0; c < 3; ++c) color[c] *= color[3];
                color[3] = 1;
                break;
            case RuleKind::channel_lost: color[static_cast<int>(rule.n)] = 0; break;
            case RuleKind::decoded:
            case RuleKind::blended_linear: color = with_each<scenes::decode_srgb>(color); break;
            case RuleKind::encoded: color = with_each<scenes::encode_srgb>(color); break;
            default: return;
        }
    }
}

void StackMaker::set_background(const Rule& rule, const PixelList& pixel) {
    const Rgba nothing{0, 0, 0, 0};
    switch (rule.kind) {
        case RuleKind::opaque_lost:
        case RuleKind::opaque_ignored: stack_.background = setting_->cleared; break;
        case RuleKind::background_lost:
            if (rule.n != 0 ? !pixel.visible.empty() : !pixel.has_opaque) stack_.background = nothing;
            break;
        case RuleKind::surface_lost: stack_.background = nothing; break;
        case RuleKind::surface_mixed:
            if (pixel.has_opaque)
                for (std::size_t c = 0; c < 4; ++c)
                    stack_.background[c] = rule.value * pixel.behind[c] + (1 - rule.value) * setting_->cleared[c];
            break;
        case RuleKind::background_other:
            if (!pixel.has_opaque && setting_->seen_background) stack_.background = *setting_->seen_background;
            break;
        case RuleKind::multiplied:
            for (const Layer& layer : stack_.layers)
                for (std::size_t c = 0; c < 3; ++c) stack_.background[c] *= layer.color[c];
            stack_.layers.clear();
            stack_.near = stack_.near_without_middle = 0;
            break;
        case RuleKind::decoded:
            if (rule.n == 2 || (rule.n == 1 && pixel.has_opaque))
                stack_.background = with_each<scenes::decode_srgb>(stack_.background);
            break;
        case RuleKind::picture_encoded: stack_.finish = Finish::encoded; break;
        case RuleKind::picture_decoded:
            stack_.finish = setting_->stored == ColorStorage::encoded ? Finish::as_is : Finish::decoded;
            break;
        case RuleKind::background_twice: {
            Rgba again = pixel.behind;
            again[3] = 0;
            stack_.layers.push_back({again, true});
            break;
        }
        case RuleKind::blended_linear:
            stack_.background = with_each<scenes::decode_srgb>(stack_.background);
            stack_.is_linear = true;
            break;
        default: break;
    }
}

}  // namespace strata::oracle::verdict
