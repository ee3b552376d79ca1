// tools/oracle/rules/structure.cpp - lists the layers of a pixel under a rule about depth, ties and order: what a right
// port, or one with a mistake, composites (structure.h).
#include "tools/oracle/rules/structure.h"

#include <algorithm>

#include "tools/oracle/fragments/coverages.h"

namespace strata::oracle::verdict {

Ties ties_number(std::size_t number) noexcept {
    return {static_cast<TieHandling>(number % tie_rule_count),
            number < tie_rule_count ? ComparedDepth::code : ComparedDepth::shader_z};
}

std::string_view describe(const Ties& ties) noexcept {
    switch (ties.rule) {
        case TieHandling::first: return "all composited, the first submitted in front";
        case TieHandling::last: return "all composited, the last submitted in front";
        case TieHandling::unique: return "the first submitted kept";
        case TieHandling::unique_last: return "the last submitted kept";
        case TieHandling::merged: return "merged by MAX";
        case TieHandling::merged_premultiplied: return "merged by MAX of premultiplied colours";
        case TieHandling::other: return "all composited, in an order that is not that of submission";
        case TieHandling::first_then_last: break;
    }
    return "all composited, the first submitted in front at the near end and behind at the far end";
}

bool has_ties(std::span<const Fragment> visible) noexcept {
    for (std::size_t i = 1; i < visible.size(); ++i)
        if (visible[i].code == visible[i - 1].code || visible[i].shader_z <= visible[i - 1].shader_z) return true;
    return false;
}

namespace {

// The size of the largest group of fragments at one depth.
std::size_t largest_group(std::span<const Fragment> sorted) noexcept {
    std::size_t largest = 0, size = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        size = i > 0 && sorted[i].code == sorted[i - 1].code ? size + 1 : 1;
        largest = std::max(largest, size);
    }
    return largest;
}

// True if both depths (code and binary32) have the same ties and the same order.
bool have_one_key(std::span<const Fragment> sorted) noexcept {
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const Fragment &a = sorted[i - 1], &b = sorted[i];
        const bool is_tie = a.code == b.code;
        if (is_tie ? a.shader_z != b.shader_z || a.primitive > b.primitive : a.shader_z >= b.shader_z) return false;
    }
    return true;
}

}  // namespace

TieChoices tie_choices(std::span<const Rule> rules, const PixelList& list) noexcept {
    TieChoices choices;
    const bool doubles = std::ranges::any_of(
        rules, [](const Rule& r) { return r.kind == RuleKind::edges_twice || r.kind == RuleKind::edges_never; });
    const std::span<const Fragment> hidden = rules.empty() ? std::span<const Fragment>{} : list.hidden;
    const std::size_t largest = doubles ? most_permuted : std::max(largest_group(list.visible), largest_group(hidden));
    // A hidden fragment is behind every visible one by its code, but may be in front of it by its binary32 depth.
    const bool is_one_key = !doubles && have_one_key(list.visible) && have_one_key(hidden) &&
                            (hidden.empty() || list.visible.empty() ||
                             std::ranges::max(list.visible, {}, &Fragment::shader_z).shader_z <
                                 std::ranges::min(hidden, {}, &Fragment::shader_z).shader_z);
    for (std::size_t n = 0; n < ties_count; ++n) {
        const bool is_by_code = n < tie_rule_count;
        choices.same_as[n] = static_cast<std::uint8_t>(n);
        if (is_by_code && largest <= 1) choices.same_as[n] = 0;
        if (!is_by_code && is_one_key) choices.same_as[n] = choices.same_as[n - tie_rule_count];
    }
    // The permutations of a group of g fragments repeat after g!; groups of more than four are not permuted.
    constexpr std::array<std::uint32_t, most_permuted + 1> factorials{0, 0, 2, 6, permutations};
    choices.permutations = factorials[std::min(largest, most_permuted)];
    return choices;
}

bool is_in(const Rule& rule, const Fragment& f) noexcept {
    switch (rule.scope) {
        case Scope::all: return true;
        case Scope::instance: return f.instance == rule.of;
        case Scope::material: return f.material == rule.of;
        case Scope::back_faces: return !f.is_front_facing;
        case Scope::front_faces: return f.is_front_facing;
        case Scope::layer:
        case Scope::layer_from_far: break;  // StackMaker::recolor selects by index
    }
    return true;
}

Layer merged(const Rgba& a, const Rgba& b, bool is_premultiplied) {
    Rgba most;
    for (std::size_t c = 0; c < 4; ++c) {
        const bool is_weighted = is_premultiplied && c < 3;
        most[c] = std::max(is_weighted ? a[c] * a[3] : a[c], is_weighted ? b[c] * b[3] : b[c]);
    }
    if (is_premultiplied && most[3] > 0)
        for (std::size_t c = 0; c < 3; ++c) most[c] /= most[3];
    return {most};
}

namespace {

bool is_one_depth(const Fragment& a, const Fragment& b, ComparedDepth key) noexcept {
    return key == ComparedDepth::code ? a.code == b.code : a.shader_z == b.shader_z;
}

}  // namespace

void StackMaker::add_group(std::span<const Fragment* const> group, const Ties& ties, bool is_near, std::size_t depth) {
    const TieHandling rule = ties.rule;
    const auto add = [&](const Fragment* f) {
        items_.push_back({{.color = f->color, .slack = f->slack, .spread = f->spread}, f, depth});
    };
    const bool is_last_first = rule == TieHandling::last || (rule == TieHandling::first_then_last && !is_near);
    switch (rule) {
        case TieHandling::first:
        case TieHandling::last:
        case TieHandling::first_then_last:
            for (std::size_t i = 0; i < group.size(); ++i) add(group[is_last_first ? group.size() - 1 - i : i]);
            break;
        case TieHandling::other: {
            std::vector<const Fragment*> left(group.begin(), group.end());
            std::uint32_t number = group.size() <= most_permuted ? ties.permutation : 0;
            while (!left.empty()) {
                const std::size_t next = number % left.size();
                number /= static_cast<std::uint32_t>(left.size());
                add(left[next]);
                left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
            }
            break;
        }
        case TieHandling::unique: add(group.front()); break;
        case TieHandling::unique_last: add(group.back()); break;
        case TieHandling::merged:
        case TieHandling::merged_premultiplied:
            add(group.front());
            for (std::size_t i = 1; i < group.size(); ++i)
                items_.back().layer = merged(items_.back().layer.color, group[i]->color,
                                             is_near || rule == TieHandling::merged_premultiplied);
            break;
    }
}

// Lists the fragments that the rules include, by depth.
void StackMaker::list(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties) {
    items_.clear();
    order_.clear();
    const auto is_here = [&](const Rule& rule) { return rule.region.has(pixel.x, pixel.y); };
    const auto loses = [&](const Rule& rule) {
        return rule.kind == RuleKind::hidden_alone && pixel.has_opaque && is_here(rule);
    };
    if (std::ranges::none_of(rules, loses))
        for (const Fragment& f : pixel.visible) order_.push_back(&f);
    const auto shows = [&](const Fragment& f) {
        return std::ranges::any_of(rules, [&](const Rule& rule) {
            return is_here(rule) && (rule.kind == RuleKind::hidden_shown || rule.kind == RuleKind::hidden_alone ||
                                     rule.kind == RuleKind::opaque_ignored ||
                                     (rule.kind == RuleKind::at_opaque_shown && f.code - pixel.opaque <= rule.n));
        });
    };
    if (!rules.empty())
        for (const Fragment& f : pixel.hidden)
            if (shows(f)) order_.push_back(&f);
    if (ties.key == ComparedDepth::shader_z)
        std::ranges::stable_sort(order_, [](const Fragment* a, const Fragment* b) {
            return a->shader_z != b->shader_z ? a->shader_z < b->shader_z : a->primitive < b->primitive;
        });
    depths_ = 0;
    for (std::size_t i = 0; i < order_.size(); ++i)
        depths_ += i == 0 || !is_one_depth(*order_[i], *order_[i - 1], ties.key) ? 1 : 0;
    std::size_t depth = 0;
    for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end, ++depth) {
        end = begin + 1;
        while (end < order_.size() && is_one_depth(*order_[begin], *order_[end], ties.key)) ++end;
        add_group({order_.data() + begin, end - begin}, ties, depth < (depths_ + 1) / 2, depth);
    }
}

void StackMaker::finish(std::span<const Rule> rules) {
    stack_.layers.clear();
    stack_.near = stack_.near_without_middle = 0;
    for (const Item& item : items_) {
        stack_.layers.push_back(item.layer);
        if (item.depth < (depths_ + 1) / 2) stack_.near = stack_.layers.size();
        if (item.depth < depths_ / 2) stack_.near_without_middle = stack_.layers.size();
    }
    // A port divides the layers that it finds, so a wrong list is divided by its own length.
    if (std::ranges::all_of(rules, [](const Rule& r) { return r.kind == RuleKind::ends_alone; })) return;
    stack_.near = (items_.size() + 1) / 2;
    stack_.near_without_middle = items_.size() / 2;
    for (const Rule& rule : rules)
        if (rule.kind == RuleKind::ends_rest_as_submitted) {
            stack_.near = std::min<std::size_t>(stack_.near, rule.n);
            stack_.near_without_middle = std::min<std::size_t>(stack_.near_without_middle, rule.n);
        }
}

void StackMaker::apply(const Rule& rule, const PixelList& pixel) {
    if (!rule.region.has(pixel.x, pixel.y)) return;
    read_elsewhere(rule, pixel);
    choose_by_number(rule);
    choose_by_nature(rule, pixel);
    order(rule);
    edit_one(rule);
    edit_close(rule);
    combine(rule);
    recolor(rule);
}

const Stack& StackMaker::with(std::span<const Rule> rules, const PixelList& given, const Ties& ties, bool is_moved) {
    PixelList pixel = given;
    for (const Rule& rule : rules)
        if (given.edge != nullptr && (rule.kind == RuleKind::edges_twice || rule.kind == RuleKind::edges_never))
            pixel = (rule.kind == RuleKind::edges_twice ? given.edge->twice : given.edge->never).at(given.x, given.y);
    list(rules, pixel, ties);
    for (const Rule& rule : rules) apply(rule, pixel);
    finish(rules);
    steps_.list(order_.size());
    stack_.background = pixel.behind;
    stack_.background_spread = pixel.behind_spread;
    stack_.is_linear = setting_->stored == ColorStorage::srgb_target;
    stack_.is_moved = is_moved;
    stack_.finish = setting_->stored == ColorStorage::encoded ? Finish::encoded : Finish::as_is;
    stack_.mixing = {};
    for (const Rule& rule : rules) {
        if (!rule.region.has(pixel.x, pixel.y)) continue;
        set_background(rule, pixel);
        mix(rule);
    }
    return stack_;
}

}  // namespace strata::oracle::verdict
