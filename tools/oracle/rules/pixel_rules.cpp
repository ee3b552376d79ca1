// tools/oracle/rules/pixel_rules.cpp - the rules (rule.h) that read layers of another pixel, and those of blending.
#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

// Replaces layers by those of another pixel; a layer that the other pixel lacks is dropped.
void StackMaker::read_elsewhere(const Rule& rule, const PixelList& pixel) {
    if (pixel.scene == nullptr) return;
    int x = pixel.x, y = pixel.y;
    switch (rule.kind) {
        case RuleKind::shifted:
            x += rule.dx;
            y += rule.dy;
            break;
        case RuleKind::halved:
            x = x / 2 * 2 + rule.dx;
            y = y / 2 * 2 + rule.dy;
            break;
        default: return;
    }
    const std::span<const Fragment> there = pixel.scene->visible_at(x, y);
    const auto item = [&](std::size_t i) {
        const Fragment& f = there[i];
        return Item{{.color = f.color, .slack = f.slack, .spread = f.spread}, &f, i};
    };
    const bool is_one = rule.n > 0 && rule.kind != RuleKind::halved;
    const std::size_t first = rule.n == 0 ? 0 : is_one ? rule.n - 1 : rule.n;
    if (!is_one) {
        if (items_.size() > first) items_.resize(first);
        for (std::size_t i = items_.size(); i < there.size(); ++i) items_.push_back(item(i));
    } else if (first < there.size()) {
        if (first < items_.size())
            items_[first] = item(first);
        else
            items_.push_back(item(first));
    } else if (first < items_.size()) {
        items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(first));
    }
    depths_ = items_.size();
}

void StackMaker::mix(const Rule& rule) {
    Mixing& mixing = stack_.mixing;
    switch (rule.kind) {
        case RuleKind::through_squared: mixing.through = Mixing::Through::squared; break;
        case RuleKind::through_summed: mixing.through = Mixing::Through::summed; break;
        case RuleKind::not_attenuated: mixing.attenuates = false; break;
        case RuleKind::behind_squared: mixing.behind = Mixing::Behind::twice; break;
        case RuleKind::behind_inverted: mixing.behind = Mixing::Behind::inverted; break;
        case RuleKind::few_bits:
            mixing.color_bits = static_cast<std::uint8_t>(rule.n & 0xff);
            mixing.weight_bits = static_cast<std::uint8_t>(rule.n >> 8 & 0xff);
            mixing.picture_too = rule.n >> 16 != 0;
            break;
        default: break;
    }
}

}  // namespace strata::oracle::verdict
