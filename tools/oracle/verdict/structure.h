// tools/oracle/verdict/structure.h - which fragments of a pixel are composited, and in which order: layers over a
// background.
//
// Rule     A right structure has all visible fragments of a pixel, near to far. Of fragments at one depth peels keep
//          the first, the last, all or a mixture (keys-and-counts.md 2.2); each is right, and a picture goes by one of
//          them. A wrong one comes from a rule (rule.h).
// Tests    tests/tools/oracle/verdict/structure_test.cpp, search_test.cpp
#pragma once
#include <span>
#include <vector>

#include "tools/oracle/verdict/composite.h"
#include "tools/oracle/verdict/fragments.h"
#include "tools/oracle/verdict/rule.h"
#include "tools/oracle/verdict/setting.h"
#include "tools/oracle/verdict/ties.h"

namespace strata::oracle::verdict {

// Whether some of a pixel's visible fragments lie at one depth, or the two depths order them differently.
[[nodiscard]] bool has_ties(std::span<const Fragment> visible) noexcept;

// The rules for ties that may give different structures at a pixel: of those that are alike the first stands for all.
struct TieChoices {
    std::array<std::uint8_t, ties_count> same_as{};  // by number
    std::uint32_t permutations = 0;                  // of TieRule::other; none: they give nothing else
};
[[nodiscard]] TieChoices tie_choices(std::span<const Rule> rules, const PixelList& list) noexcept;

class StackMaker {
  public:
    explicit StackMaker(const Setting& setting) : setting_{&setting}, steps_{*setting.work} {}
    StackMaker(const Setting& setting, std::uint64_t share) : setting_{&setting}, steps_{*setting.work, share} {}
    // What is done with it: it goes from hand to hand in a sequential part of a search.
    [[nodiscard]] Steps& steps() noexcept { return steps_; }
    // The references hold until the next call.
    [[nodiscard]] const Stack& right(const PixelList& pixel, const Ties& ties) { return with({}, pixel, ties); }
    // Rules are applied one after the other.
    [[nodiscard]] const Stack& with(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties,
                                    bool is_moved = false);

  private:
    struct Item {
        Layer layer{};
        const Fragment* fragment = nullptr;  // the first, of a mixture
        std::size_t depth = 0;               // number of its depth, from the near end
    };

    void list(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties);
    void add_group(std::span<const Fragment* const> group, const Ties& ties, bool is_near, std::size_t depth);
    void finish(std::span<const Rule> rules);
    // Parts of a rule, each of which does something for some kinds: layer_rules.cpp, color_rules.cpp.
    void apply(const Rule& rule, const PixelList& pixel);
    void choose_by_number(const Rule& rule);
    void choose_by_nature(const Rule& rule, const PixelList& pixel);
    void order(const Rule& rule);
    void edit_one(const Rule& rule);
    void read_elsewhere(const Rule& rule, const PixelList& pixel);
    void mix(const Rule& rule);
    void edit_close(const Rule& rule);
    void combine(const Rule& rule);
    void combine_with_background(const Rule& rule);
    void recolor(const Rule& rule);
    void set_background(const Rule& rule, const PixelList& pixel);

    void keep(std::size_t first, std::size_t last);                                                  // of the items
    [[nodiscard]] std::uint64_t drawn(const Fragment& fragment, std::uint32_t drawing_order) const;  // when

    const Setting* setting_;
    Steps steps_;
    Stack stack_{};
    std::size_t depths_ = 0;
    std::vector<const Fragment*> order_{};
    std::vector<Item> items_{};
};

// Whether the rule changes this fragment.
[[nodiscard]] bool is_in(const Rule& rule, const Fragment& fragment) noexcept;
// MAX of each channel of straight colours, or of those times alpha.
[[nodiscard]] Layer merged(const Rgba& a, const Rgba& b, bool is_premultiplied);

}  // namespace strata::oracle::verdict
