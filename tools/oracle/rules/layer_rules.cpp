// tools/oracle/rules/layer_rules.cpp - the rules (rule.h) that select, order, duplicate, drop and merge a pixel's
// layers.
#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

namespace {

// The depth as stored in a buffer of that many bits.
std::int64_t in_bits(const Fragment& f, std::uint32_t bits) {
    return static_cast<std::int64_t>(std::floor(double{f.shader_z} * std::exp2(bits)));
}

}  // namespace

void StackMaker::keep(std::size_t first, std::size_t last) {
    last = std::min(last, items_.size());
    first = std::min(first, last);
    items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(last), items_.end());
    items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first));
}

// A number that increases in drawing order.
std::uint64_t StackMaker::drawn(const Fragment& f, std::uint32_t number) const {
    const DrawingOrder order = drawing_order(number);
    const auto& rank = setting_->rank[static_cast<std::size_t>(order.instances)];
    const std::uint64_t instance = rank.empty() ? f.instance : rank[f.instance];
    const std::uint64_t is_front = f.is_front_facing ? 1 : 0;
    switch (order.faces) {
        case FaceOrder::listed: return instance << 33 | f.primitive;
        case FaceOrder::back_first_in_instance: return instance << 33 | is_front << 32 | f.primitive;
        case FaceOrder::back_first: return is_front << 62 | instance << 33 | f.primitive;
        case FaceOrder::front_first: break;
    }
    return (1 - is_front) << 62 | instance << 33 | f.primitive;
}

void StackMaker::choose_by_number(const Rule& rule) {
    const std::size_t n = rule.n, all = items_.size();
    const std::size_t rest = all - std::min(all, n);
    // Drops the layers by their index in submission order.
    const auto by_submission = [&](auto is_kept) {
        std::vector<std::uint32_t> numbers;
        for (const Item& i : items_) numbers.push_back(i.fragment->primitive);
        std::ranges::sort(numbers);
        std::erase_if(items_, [&](const Item& i) {
            const auto at = std::ranges::lower_bound(numbers, i.fragment->primitive) - numbers.begin();
            return !is_kept(static_cast<std::size_t>(at));
        });
    };
    switch (rule.kind) {
        case RuleKind::nearest_alone: return keep(0, n);
        case RuleKind::farthest_alone: return keep(rest, all);
        case RuleKind::nearest_lost: return keep(n, all);
        case RuleKind::farthest_lost: return keep(0, rest);
        case RuleKind::ends_alone:
            if (all > 2 * n)
                items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(n),
                             items_.end() - static_cast<std::ptrdiff_t>(n));
            return;
        case RuleKind::first_submitted: return by_submission([&](std::size_t at) { return at < n; });
        case RuleKind::last_submitted: return by_submission([&](std::size_t at) { return at >= rest; });
        case RuleKind::ended_early: {
            float through = 1;
            std::size_t kept = 0;
            while (kept < all && through >= rule.value) through *= 1 - items_[kept++].layer.color[3];
            return keep(0, kept);
        }
        default: return;
    }
}

void StackMaker::choose_by_nature(const Rule& rule, const PixelList& pixel) {
    const auto lose = [&](auto is_lost) { std::erase_if(items_, [&](const Item& i) { return is_lost(*i.fragment); }); };
    // Keeps the fragments that pass a depth test in drawing order; `passes` compares a depth with the last kept one.
    const auto test = [&](auto passes) {
        std::vector<const Fragment*> all, kept;
        for (const Item& i : items_) all.push_back(i.fragment);
        std::ranges::sort(all, {}, [&](const Fragment* f) { return drawn(*f, rule.n); });
        for (const Fragment* f : all)
            if (kept.empty() || passes(f->code, kept.back()->code)) kept.push_back(f);
        lose([&](const Fragment& f) { return std::ranges::find(kept, &f) == kept.end(); });
    };
    switch (rule.kind) {
        case RuleKind::nearest_of_instance: {
            std::vector<std::uint32_t> seen;
            return lose([&](const Fragment& f) {
                const bool is_there = std::ranges::find(seen, f.instance) != seen.end();
                if (!is_there) seen.push_back(f.instance);
                return is_there;
            });
        }
        case RuleKind::some_lost: return lose([&](const Fragment& f) { return is_in(rule, f); });
        case RuleKind::behind_drawn: return test([](std::uint32_t own, std::uint32_t kept) { return own < kept; });
        case RuleKind::before_drawn: return test([](std::uint32_t own, std::uint32_t kept) { return own > kept; });
        case RuleKind::near_opaque_lost:
            return lose([&](const Fragment& f) { return pixel.has_opaque && pixel.opaque - f.code <= rule.n; });
        case RuleKind::opaque_in_front:
            if (pixel.has_opaque) items_.clear();
            return;
        default: return;
    }
}

void StackMaker::order(const Rule& rule) {
    const std::size_t n = std::min<std::size_t>(rule.n, items_.size());
    const auto by = [&](auto key) {
        std::ranges::stable_sort(items_, {}, [&](const Item& i) { return key(*i.fragment); });
    };
    // The fragment that is drawn last is in front.
    const auto as_submitted = [&](std::size_t first, std::size_t last) {
        const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
        if (first < last)
            std::stable_sort(at(first), at(last), [](const Item& a, const Item& b) {
                return a.fragment->primitive > b.fragment->primitive;
            });
    };
    switch (rule.kind) {
        case RuleKind::reversed: std::ranges::reverse(items_); return;
        case RuleKind::by_centroid:
            return by([&](const Fragment& f) {
                const auto& nearness = setting_->nearness[rule.n];
                return std::pair{f.primitive < nearness.size() ? -nearness[f.primitive] : 0.0f, ~f.primitive};
            });
        case RuleKind::ordered_in_bits:
            return by([&](const Fragment& f) { return std::pair{in_bits(f, rule.n), f.primitive}; });
        case RuleKind::sorted_once:
            by([](const Fragment& f) { return f.primitive; });
            for (std::size_t i = 0; i + 1 < items_.size(); ++i)
                if (items_[i].fragment->code > items_[i + 1].fragment->code) std::swap(items_[i], items_[i + 1]);
            return;
        case RuleKind::as_submitted: return by([&](const Fragment& f) { return ~drawn(f, rule.n); });
        case RuleKind::by_instance:
            return by([&](const Fragment& f) {
                const auto& rank = setting_->rank[rule.n];
                return ~(rank.empty() ? f.instance : rank[f.instance]);
            });
        case RuleKind::rest_as_submitted: return as_submitted(n, items_.size());
        case RuleKind::ends_rest_as_submitted: return as_submitted(n, items_.size() - n);
        default: return;
    }
}

void StackMaker::edit_one(const Rule& rule) {
    const std::size_t n = rule.n, all = items_.size();
    const auto at = [&](std::size_t number) { return items_.begin() + static_cast<std::ptrdiff_t>(number); };
    const auto doubles = [&] {
        std::vector<Item> twice;
        for (const Item& i : items_) {
            twice.push_back(i);
            if (is_in(rule, *i.fragment)) twice.push_back(i);
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
        case RuleKind::mixed:
            if (n + 1 >= all) return;
            for (std::size_t c = 0; c < 4; ++c)
                items_[n].layer.color[c] = (items_[n].layer.color[c] + items_[n + 1].layer.color[c]) / 2;
            items_.erase(at(n + 1));
            return;
        case RuleKind::alphas_as_submitted:
        case RuleKind::colors_as_submitted: {
            std::vector<Item> submitted = items_;
            std::ranges::stable_sort(submitted, {}, [](const Item& i) { return i.fragment->primitive; });
            if (rule.n != 0) std::ranges::reverse(submitted);
            for (std::size_t i = 0; i < all; ++i)
                for (std::size_t c = 0; c < 4; ++c)
                    if ((c == 3) == (rule.kind == RuleKind::alphas_as_submitted))
                        items_[i].layer.color[c] = submitted[i].layer.color[c];
            return;
        }
        case RuleKind::some_doubled: return doubles();
        default: return;
    }
}

// Changes fragments that are close behind the last kept fragment.
void StackMaker::edit_close(const Rule& rule) {
    const bool is_within = rule.kind == RuleKind::within_lost || rule.kind == RuleKind::within_merged;
    const bool merges = rule.kind == RuleKind::within_merged || rule.kind == RuleKind::close_merged;
    if (!is_within && !merges && rule.kind != RuleKind::close_lost && rule.kind != RuleKind::close_swapped) return;
    std::vector<Item> kept;
    std::size_t begin = 0;  // index of the first fragment of a group of close ones
    const Fragment* first = nullptr;
    for (const Item& item : items_) {
        const bool is_close = first != nullptr && (is_within ? item.fragment->shader_z - first->shader_z <= rule.value
                                                             : item.fragment->code - first->code <= rule.n);
        if (!is_close) {
            first = item.fragment;
            begin = kept.size();
            kept.push_back(item);
        } else if (merges) {
            kept.back().layer =
                verdict::merged(kept.back().layer.color, item.layer.color, item.depth < (depths_ + 1) / 2);
        } else if (rule.kind == RuleKind::close_swapped) {
            kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(begin), item);
        }
    }
    items_ = std::move(kept);
}

}  // namespace strata::oracle::verdict
