#include "tools/oracle/verdict/structure.h"

#include <algorithm>

namespace strata::oracle::verdict {

Ties ties_number(std::size_t number) noexcept {
    return {static_cast<TieRule>(number % 6), number < 6 ? DepthKey::code : DepthKey::shader_z};
}

std::string_view describe(const Ties& ties) noexcept {
    switch (ties.rule) {
        case TieRule::first: return "all composited, the first submitted in front";
        case TieRule::last: return "all composited, the last submitted in front";
        case TieRule::unique: return "the first submitted kept";
        case TieRule::unique_last: return "the last submitted kept";
        case TieRule::merged: return "merged by MAX";
        case TieRule::first_then_last:
            return "all composited, the first submitted in front at the near end and behind at the far end";
    }
    return "";  // unreachable: the enum is closed
}

bool has_ties(std::span<const Fragment> visible) noexcept {
    for (std::size_t i = 1; i < visible.size(); ++i)
        if (visible[i].code == visible[i - 1].code || visible[i].shader_z <= visible[i - 1].shader_z) return true;
    return false;
}

namespace {

bool is_one_depth(const Fragment& a, const Fragment& b, DepthKey key) noexcept {
    return key == DepthKey::code ? a.code == b.code : a.shader_z == b.shader_z;
}

// MAX of each channel of straight colours, or of those times alpha.
Layer merged(const Rgba& a, const Rgba& b, bool is_near) {
    Rgba most;
    for (std::size_t c = 0; c < 4; ++c) {
        const bool is_weighted = is_near && c < 3;
        most[c] = std::max(is_weighted ? a[c] * a[3] : a[c], is_weighted ? b[c] * b[3] : b[c]);
    }
    if (is_near && most[3] > 0)
        for (std::size_t c = 0; c < 3; ++c) most[c] /= most[3];
    return {most};
}

}  // namespace

void StackMaker::add_group(std::span<const Fragment* const> group, TieRule rule, bool is_near, std::size_t depth) {
    const auto add = [&](const Fragment* f) { items_.push_back({{f->color}, f, depth}); };
    const bool is_last_first = rule == TieRule::last || (rule == TieRule::first_then_last && !is_near);
    switch (rule) {
        case TieRule::first:
        case TieRule::last:
        case TieRule::first_then_last:
            for (std::size_t i = 0; i < group.size(); ++i) add(group[is_last_first ? group.size() - 1 - i : i]);
            break;
        case TieRule::unique: add(group.front()); break;
        case TieRule::unique_last: add(group.back()); break;
        case TieRule::merged: {
            add(group.front());
            for (std::size_t i = 1; i < group.size(); ++i)
                items_.back().layer = merged(items_.back().layer.color, group[i]->color, is_near);
            break;
        }
    }
}

// Fragments that a rule lets take part, by depth.
void StackMaker::list(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties) {
    items_.clear();
    order_.clear();
    for (const Fragment& f : pixel.visible) order_.push_back(&f);
    const auto shows = [&](const Fragment& f) {
        return std::ranges::any_of(rules, [&](const Rule& rule) {
            return rule.kind == RuleKind::hidden_shown || rule.kind == RuleKind::opaque_ignored ||
                   (rule.kind == RuleKind::at_opaque_shown && f.code - pixel.opaque <= rule.n);
        });
    };
    if (!rules.empty())
        for (const Fragment& f : pixel.hidden)
            if (shows(f)) order_.push_back(&f);
    if (ties.key == DepthKey::shader_z)
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
        add_group({order_.data() + begin, end - begin}, ties.rule, depth < (depths_ + 1) / 2, depth);
    }
}

void StackMaker::keep(std::size_t first, std::size_t last) {
    last = std::min(last, items_.size());
    first = std::min(first, last);
    items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(last), items_.end());
    items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first));
}

// Which layers take part, by number or by what they are.
void StackMaker::choose(const Rule& rule, const PixelList& pixel) {
    const std::size_t n = rule.n, all = items_.size();
    const auto rest = [&](std::size_t of) { return all - std::min(all, of); };
    const auto lose = [&](auto is_lost) { std::erase_if(items_, [&](const Item& i) { return is_lost(*i.fragment); }); };
    // A number among those that were submitted.
    const auto by_submission = [&](auto is_kept) {
        std::vector<std::uint32_t> numbers;
        for (const Item& i : items_) numbers.push_back(i.fragment->primitive);
        std::ranges::sort(numbers);
        lose([&](const Fragment& f) {
            return !is_kept(static_cast<std::size_t>(std::ranges::lower_bound(numbers, f.primitive) - numbers.begin()));
        });
    };
    // Fragments as a depth test in the order of submission leaves them; `passes` compares with what was kept.
    const auto test = [&](auto passes) {
        std::vector<const Fragment*> submitted;
        for (const Item& i : items_) submitted.push_back(i.fragment);
        std::ranges::sort(submitted, {}, &Fragment::primitive);
        std::vector<const Fragment*> kept;
        for (const Fragment* f : submitted)
            if (kept.empty() || passes(f->code, kept.back()->code)) kept.push_back(f);
        lose([&](const Fragment& f) { return std::ranges::find(kept, &f) == kept.end(); });
    };
    switch (rule.kind) {
        case RuleKind::nearest_alone: return keep(0, n);
        case RuleKind::farthest_alone: return keep(rest(n), all);
        case RuleKind::nearest_lost: return keep(n, all);
        case RuleKind::farthest_lost: return keep(0, rest(n));
        case RuleKind::ends_alone:
            if (all > 2 * n)
                items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(n),
                             items_.end() - static_cast<std::ptrdiff_t>(n));
            return;
        case RuleKind::first_submitted: return by_submission([&](std::size_t at) { return at < n; });
        case RuleKind::last_submitted: return by_submission([&](std::size_t at) { return at >= rest(n); });
        case RuleKind::nearest_of_instance: {
            std::vector<std::uint32_t> seen;
            return lose([&](const Fragment& f) {
                const bool is_there = std::ranges::find(seen, f.instance) != seen.end();
                if (!is_there) seen.push_back(f.instance);
                return is_there;
            });
        }
        case RuleKind::instance_lost: return lose([&](const Fragment& f) { return f.instance == n; });
        case RuleKind::material_lost: return lose([&](const Fragment& f) { return f.material == n; });
        case RuleKind::back_faces_lost: return lose([](const Fragment& f) { return !f.is_front_facing; });
        case RuleKind::front_faces_lost: return lose([](const Fragment& f) { return f.is_front_facing; });
        case RuleKind::alpha_below_lost: return lose([&](const Fragment& f) { return f.color[3] < rule.value; });
        case RuleKind::alpha_below_kept: return lose([&](const Fragment& f) { return !(f.color[3] < rule.value); });
        case RuleKind::behind_submitted: return test([](std::uint32_t own, std::uint32_t kept) { return own < kept; });
        case RuleKind::before_submitted: return test([](std::uint32_t own, std::uint32_t kept) { return own > kept; });
        case RuleKind::near_opaque_lost:
            return lose([&](const Fragment& f) { return pixel.has_opaque && pixel.opaque - f.code <= n; });
        case RuleKind::opaque_in_front:
            if (pixel.has_opaque) items_.clear();
            return;
        default: return;
    }
}

void StackMaker::order(const Rule& rule) {
    const auto by = [&](auto key) {
        std::ranges::stable_sort(items_, {}, [&](const Item& i) { return key(*i.fragment); });
    };
    switch (rule.kind) {
        case RuleKind::reversed: std::ranges::reverse(items_); return;
        case RuleKind::as_submitted: return by([](const Fragment& f) { return ~f.primitive; });
        case RuleKind::as_submitted_reversed: return by([](const Fragment& f) { return f.primitive; });
        case RuleKind::by_instance: return by([](const Fragment& f) { return ~f.instance; });
        case RuleKind::by_instance_reversed: return by([](const Fragment& f) { return f.instance; });
        case RuleKind::back_faces_behind: return by([](const Fragment& f) { return !f.is_front_facing; });
        case RuleKind::back_faces_behind_as_submitted:
            by([](const Fragment& f) { return ~f.primitive; });
            return by([](const Fragment& f) { return !f.is_front_facing; });
        case RuleKind::rest_as_submitted: {
            const auto begin =
                items_.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(rule.n, items_.size()));
            std::stable_sort(begin, items_.end(), [](const Item& a, const Item& b) {
                return a.fragment->primitive > b.fragment->primitive;
            });
            return;
        }
        default: return;
    }
}

void StackMaker::edit_one(const Rule& rule) {
    const std::size_t n = rule.n, all = items_.size();
    const auto at = [&](std::size_t number) { return items_.begin() + static_cast<std::ptrdiff_t>(number); };
    const auto doubles = [&](auto is_doubled) {
        std::vector<Item> twice;
        for (const Item& i : items_) {
            twice.push_back(i);
            if (is_doubled(*i.fragment)) twice.push_back(i);
        }
        items_ = std::move(twice);
    };
    const std::size_t from_far = n < all ? all - 1 - n : all;
    switch (rule.kind) {
        case RuleKind::lost:
            if (n < all) items_.erase(at(n));
            return;
        case RuleKind::lost_from_far:
            if (n < all) items_.erase(at(from_far));
            return;
        case RuleKind::doubled:
            if (n < all) items_.insert(at(n), Item{items_[n]});
            return;
        case RuleKind::doubled_from_far:
            if (n < all) items_.insert(at(from_far), Item{items_[from_far]});
            return;
        case RuleKind::swapped:
            if (n + 1 < all) std::swap(items_[n], items_[n + 1]);
            return;
        case RuleKind::swapped_from_far:
            if (n + 1 < all) std::swap(items_[from_far], items_[from_far - 1]);
            return;
        case RuleKind::merged:
            if (n + 1 >= all) return;
            items_[n].layer = merged(items_[n].layer.color, items_[n + 1].layer.color, n < all / 2);
            items_.erase(at(n + 1));
            return;
        case RuleKind::mixed:
            if (n + 1 >= all) return;
            for (std::size_t c = 0; c < 4; ++c)
                items_[n].layer.color[c] = (items_[n].layer.color[c] + items_[n + 1].layer.color[c]) / 2;
            items_.erase(at(n + 1));
            return;
        case RuleKind::color_of_next:
        case RuleKind::color_of_previous: {
            const std::size_t from = rule.kind == RuleKind::color_of_next ? n + 1 : n - 1;
            if (n >= all || from >= all) return;
            for (std::size_t c = 0; c < 3; ++c) items_[n].layer.color[c] = items_[from].layer.color[c];
            return;
        }
        case RuleKind::all_doubled: return doubles([](const Fragment&) { return true; });
        case RuleKind::instance_doubled: return doubles([&](const Fragment& f) { return f.instance == n; });
        case RuleKind::material_doubled: return doubles([&](const Fragment& f) { return f.material == n; });
        default: return;
    }
}

// Fragments that lie close behind the one before them, which is the last that was kept.
void StackMaker::edit_close(const Rule& rule) {
    const bool loses = rule.kind == RuleKind::close_lost || rule.kind == RuleKind::within_lost;
    if (!loses && rule.kind != RuleKind::close_merged && rule.kind != RuleKind::close_swapped) return;
    std::vector<Item> kept;
    std::size_t begin = 0;  // of the fragments that are close to one another
    const Fragment* first = nullptr;
    for (const Item& item : items_) {
        const bool is_close = first != nullptr && (rule.kind == RuleKind::within_lost
                                                       ? item.fragment->shader_z - first->shader_z <= rule.value
                                                       : item.fragment->code - first->code <= rule.n);
        if (!is_close) {
            first = item.fragment;
            begin = kept.size();
            kept.push_back(item);
        } else if (rule.kind == RuleKind::close_merged) {
            kept.back().layer = merged(kept.back().layer.color, item.layer.color, item.depth < (depths_ + 1) / 2);
        } else if (rule.kind == RuleKind::close_swapped) {
            kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(begin), item);
        }
    }
    items_ = std::move(kept);
}

void StackMaker::combine(const Rule& rule, std::size_t from) {
    if (from >= items_.size()) return;
    Rgba sum{0, 0, 0, 0};
    for (std::size_t i = from; i < items_.size(); ++i) {
        const Rgba& color = items_[i].layer.color;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c] * color[3];
        sum[3] += color[3];
    }
    const auto count = static_cast<float>(items_.size() - from);
    Layer all{sum, true};
    if (rule.kind == RuleKind::added) all.color[3] = 0;
    if (rule.kind == RuleKind::averaged || rule.kind == RuleKind::rest_averaged) {
        all.is_premultiplied = false;
        for (std::size_t c = 0; c < 3; ++c) all.color[c] = sum[3] > 0 ? sum[c] / sum[3] : 0;
        float through = 1;
        for (float i = 0; i < count; ++i) through *= 1 - sum[3] / count;
        all.color[3] = 1 - through;
    }
    all.slack = count * 0x1p-11f;  // sums are often kept in binary16
    items_[from].layer = all;
    keep(0, from + 1);
}

void StackMaker::recolor(const Rule& rule) {
    for (Item& item : items_) {
        Rgba& color = item.layer.color;
        switch (rule.kind) {
            case RuleKind::alpha_squared: color[3] *= color[3]; break;
            case RuleKind::alpha_inverted: color[3] = 1 - color[3]; break;
            case RuleKind::alpha_ignored: color[3] = 1; break;
            case RuleKind::premultiplied_twice:
                for (std::size_t c = 0; c < 3; ++c) color[c] *= color[3];
                break;
            case RuleKind::not_premultiplied: item.layer.is_premultiplied = true; break;
            default: return;
        }
    }
}

void StackMaker::set_background(const Rule& rule, const PixelList& pixel) {
    const Rgba nothing{0, 0, 0, 0};
    switch (rule.kind) {
        case RuleKind::opaque_lost:
        case RuleKind::opaque_ignored: stack_.background = cleared_; break;
        case RuleKind::background_lost:
            if (!pixel.has_opaque) stack_.background = nothing;
            break;
        case RuleKind::surface_lost: stack_.background = nothing; break;
        case RuleKind::background_twice: {
            Rgba again = pixel.behind;
            again[3] = 0;
            stack_.layers.push_back({again, true});
            break;
        }
        default: break;
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
    // A port divides what it finds: the layers of a wrong list, not those of the right one.
    if (std::ranges::all_of(rules, [](const Rule& r) { return r.kind == RuleKind::ends_alone; })) return;
    stack_.near = (items_.size() + 1) / 2;
    stack_.near_without_middle = items_.size() / 2;
}

void StackMaker::apply(const Rule& rule, const PixelList& pixel) {
    choose(rule, pixel);
    order(rule);
    edit_one(rule);
    edit_close(rule);
    if (rule.kind == RuleKind::averaged || rule.kind == RuleKind::added || rule.kind == RuleKind::weighted_sum)
        combine(rule, 0);
    if (rule.kind == RuleKind::rest_averaged) combine(rule, rule.n);
    recolor(rule);
}

const Stack& StackMaker::with(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties) {
    list(rules, pixel, ties);
    for (const Rule& rule : rules) apply(rule, pixel);
    finish(rules);
    stack_.background = pixel.behind;
    for (const Rule& rule : rules) set_background(rule, pixel);
    return stack_;
}

}  // namespace strata::oracle::verdict
