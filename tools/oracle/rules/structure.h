// tools/oracle/rules/structure.h - makes the list of layers that a port composites at a pixel, with and without a
// mistake, over its background.
//
// Rule     The right structure contains all visible fragments of a pixel, near to far. Of fragments at equal depths,
//          peels keep the first, the last, all, or a mixture (peeling/reference/keys-and-counts.md 2.2); each is right,
//          if the whole picture follows one of them. A wrong structure is made by a rule (rule.h).
// Tests    tests/tools/oracle/rules/structure_test.cpp, tests/tools/oracle/search/search_test.cpp
#pragma once
#include <span>
#include <vector>

#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/fragments/setting.h"
#include "tools/oracle/rounding/composite.h"
#include "tools/oracle/rules/rule.h"
#include "tools/oracle/rules/ties.h"

namespace strata::oracle::verdict {

// True if some visible fragments of a pixel have equal depths, or if the two depths (code and binary32) order them
// differently.
[[nodiscard]] bool has_ties(std::span<const Fragment> visible) noexcept;

// The rules for ties that may give different structures at a pixel; of equivalent rules only the first is used.
struct TieChoices {
    std::array<std::uint8_t, ties_count> same_as{};  // by number: the first equivalent rule
    std::uint32_t permutations = 0;  // number of permutations for TieHandling::other; 0: they add no structure
};
[[nodiscard]] TieChoices tie_choices(std::span<const Rule> rules, const PixelList& list) noexcept;

class StackMaker {
  public:
    explicit StackMaker(const Setting& setting) : setting_{&setting}, steps_{*setting.work} {}
    StackMaker(const Setting& setting, std::uint64_t share) : setting_{&setting}, steps_{*setting.work, share} {}
    // The count of its steps, for the sequential part of a search that uses it.
    [[nodiscard]] Steps& steps() noexcept { return steps_; }
    // The returned references are valid until the next call.
    [[nodiscard]] const Stack& right(const PixelList& pixel, const Ties& ties) { return with({}, pixel, ties); }
    // Applies the rules one after another.
    [[nodiscard]] const Stack& with(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties,
                                    bool is_moved = false);

  private:
    struct Item {
        Layer layer{};
        const Fragment* fragment = nullptr;  // the first one, if it is a mixture
        std::size_t depth = 0;               // index of its depth, from the near end
    };

    void list(std::span<const Rule> rules, const PixelList& pixel, const Ties& ties);
    void add_group(std::span<const Fragment* const> group, const Ties& ties, bool is_near, std::size_t depth);
    void finish(std::span<const Rule> rules);
    // Parts of apply() in layer_rules.cpp and color_rules.cpp; each handles some kinds and ignores the others.
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

    void keep(std::size_t first, std::size_t last);  // of items_
    // Its position in drawing order.
    [[nodiscard]] std::uint64_t drawn(const Fragment& fragment, std::uint32_t drawing_order) const;

    const Setting* setting_;
    Steps steps_;
    Stack stack_{};
    std::size_t depths_ = 0;
    std::vector<const Fragment*> order_{};
    std::vector<Item> items_{};
};

// True if the rule's scope includes this fragment.
[[nodiscard]] bool is_in(const Rule& rule, const Fragment& fragment) noexcept;
// The MAX of each channel of straight colours, or of premultiplied ones.
[[nodiscard]] Layer merged(const Rgba& a, const Rgba& b, bool is_premultiplied);

}  // namespace strata::oracle::verdict
