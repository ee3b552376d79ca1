// tools/oracle/fragments/near_depths.cpp - lists a pixel's fragments with close depths exchanged or merged, as another
// right port may have them (near_depths.h).
#include "tools/oracle/fragments/near_depths.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

namespace {

std::int64_t codes_behind(std::uint32_t a, std::uint32_t b) noexcept { return std::int64_t{b} - std::int64_t{a}; }

// True if two different depths may change their order: in some moved rendering their distance changes by at least as
// much as it is.
class Meetings {
  public:
    explicit Meetings(Drawings moved) : moved_{moved} {}
    [[nodiscard]] bool may_meet(const Fragment& a, const Fragment& b) const {
        return may_meet(codes_behind(a.code, b.code), [&](const OtherList& drawing) -> std::optional<std::int64_t> {
            const Fragment *const x = same_triangle(a, drawing), *const y = same_triangle(b, drawing);
            if (x == nullptr || y == nullptr) return std::nullopt;
            return codes_behind(x->code, y->code);
        });
    }
    [[nodiscard]] bool may_meet(const Fragment& a, std::uint32_t opaque) const {
        return may_meet(codes_behind(a.code, opaque), [&](const OtherList& drawing) -> std::optional<std::int64_t> {
            const Fragment* const x = same_triangle(a, drawing);
            if (x == nullptr || !drawing.has_opaque) return std::nullopt;
            return codes_behind(x->code, drawing.opaque);
        });
    }

  private:
    template <class Between>
    [[nodiscard]] bool may_meet(std::int64_t given, Between between) const {
        constexpr std::int64_t rounded = 2;  // codes
        return given != 0 && std::ranges::any_of(moved_, [&](const OtherList* drawing) {
                   const auto other = between(*drawing);
                   return other && std::abs(given) <= std::abs(*other - given) + rounded;
               });
    }
    Drawings moved_;
};

// Adds copies of the list in which neighbours with such depths are exchanged: each pair alone, then all pairs starting
// at an even index, and all starting at an odd one.
void add_exchanged(const OtherList& given, const Meetings& meetings, std::vector<OtherList>& others) {
    const std::size_t n = given.visible.size();
    const auto exchanged = [&](std::size_t first, std::size_t last, std::size_t step) {
        OtherList made = given;
        bool is_changed = false;
        for (std::size_t i = first; i + 1 < std::min(n, last); i += step) {
            Fragment &a = made.visible[i], &b = made.visible[i + 1];
            if (!meetings.may_meet(a, b)) continue;
            std::swap(a.code, b.code);
            std::swap(a.shader_z, b.shader_z);
            std::swap(a, b);
            is_changed = true;
        }
        if (is_changed && others.size() < most_others) others.push_back(std::move(made));
    };
    for (std::size_t i = 0; i + 1 < n; ++i) exchanged(i, i + 2, 1);
    if (n > 3)
        for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) exchanged(first, n, 2);
}

// Adds copies with the farthest visible fragment hidden, or the nearest hidden one visible, if its depth may change its
// order with the opaque surface.
void add_at_opaque(const OtherList& given, const Meetings& meetings, std::vector<OtherList>& others) {
    if (!given.has_opaque) return;
    if (!given.visible.empty() && meetings.may_meet(given.visible.back(), given.opaque)) {
        others.push_back(given);
        others.back().hidden.insert(others.back().hidden.begin(), given.visible.back());
        others.back().visible.pop_back();
    }
    if (!given.hidden.empty() && meetings.may_meet(given.hidden.front(), given.opaque)) {
        others.push_back(given);
        others.back().visible.push_back(given.hidden.front());
        others.back().hidden.erase(others.back().hidden.begin());
    }
}

bool is_close(const Fragment& a, const Fragment& b) noexcept { return b.code - a.code <= close_codes; }

// True if the group has several depths: fragments of one depth alone have their own rules.
bool is_open(std::span<const Fragment> group) noexcept { return group.front().code != group.back().code; }

enum class OfGroup : std::uint8_t { first, last, reversed, merged };

// The visible fragments with the group [begin, end) as a right port may leave it.
void append_group(std::span<const Fragment> group, OfGroup how, std::vector<Fragment>& to) {
    switch (how) {
        case OfGroup::first: to.push_back(group.front()); break;
        case OfGroup::last: to.push_back(group.back()); break;
        case OfGroup::reversed:
            for (std::size_t i = group.size(); i-- > 0;) {
                to.push_back(group[i]);
                // Depths stay in order.
                to.back().code = group[group.size() - 1 - i].code;
                to.back().shader_z = group[group.size() - 1 - i].shader_z;
            }
            break;
        case OfGroup::merged:
            to.push_back(group.front());
            for (const Fragment& f : group.subspan(1)) to.back().color = merged(to.back().color, f.color, true).color;
            break;
    }
}

}  // namespace

void add_close_depths(const OtherList& given, std::vector<OtherList>& others) {
    const std::span<const Fragment> visible{given.visible};
    std::vector<std::span<const Fragment>> groups;  // also of one fragment
    for (std::size_t begin = 0, end = 0; begin < visible.size(); begin = end) {
        end = begin + 1;
        while (end < visible.size() && is_close(visible[end - 1], visible[end])) ++end;
        groups.push_back(visible.subspan(begin, end - begin));
    }
    const auto several = static_cast<std::size_t>(std::ranges::count_if(groups, is_open));
    if (several == 0) return;
    const auto add = [&](OfGroup how, auto is_chosen) {
        if (others.size() >= most_others) return;
        OtherList made = given;
        made.visible.clear();
        for (std::size_t g = 0; g < groups.size(); ++g)
            if (is_open(groups[g]) && is_chosen(g))
                append_group(groups[g], how, made.visible);
            else
                made.visible.insert(made.visible.end(), groups[g].begin(), groups[g].end());
        made.has_close_depths = true;
        others.push_back(std::move(made));
    };
    for (const OfGroup how : {OfGroup::first, OfGroup::last, OfGroup::reversed, OfGroup::merged}) {
        add(how, [](std::size_t) { return true; });
        if (several == 1) continue;
        for (std::size_t only = 0; only < groups.size(); ++only)
            if (is_open(groups[only])) add(how, [&](std::size_t g) { return g == only; });
    }
}

void add_near_depths(const OtherList& given, Drawings moved, std::vector<OtherList>& others) {
    const Meetings meetings{moved};
    add_exchanged(given, meetings, others);
    add_at_opaque(given, meetings, others);
}

}  // namespace strata::oracle::verdict
