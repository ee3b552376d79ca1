// tools/oracle/program/fit/pairs.cpp - runs plain edits on some pixels (pairs.h).
#include "tools/oracle/program/fit/pairs.h"

#include <algorithm>
#include <array>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

struct WeighedPixel {
    const ListPixel* pixel = nullptr;
    double weight = 1;
    double right_so_far = 0;  // cost of the right program, of this pixel and those before it
};

class PairSearch {
  public:
    explicit PairSearch(const Lists& lists) : unit_{lists.unit()} {
        constexpr std::size_t looked_at = 4000;
        std::array<std::vector<const ListPixel*>, 2> classes;  // right, wrong
        for (std::size_t i = 0; i < lists.pixels.size(); i += lists.pixels.size() / looked_at | 1) {
            const ListPixel& pixel = lists.pixels[i];
            const Color off = residual(value({}, pixel, {}), pixel, unit_);
            const auto is_off = [&](double r) { return r > bound_at(pixel) || r < -bound_at(pixel); };
            classes[std::ranges::any_of(off, is_off) ? 1 : 0].push_back(&pixel);
        }
        // Wrong ones first: most programs do not repair them.
        for (const std::size_t which : {std::size_t{1}, std::size_t{0}}) {
            const auto& all = classes[which];
            const std::size_t count = std::min<std::size_t>(all.size(), which == 1 ? 80 : 40);
            for (std::size_t i = 0; i < count; ++i) {
                const double weight = static_cast<double>(all.size()) / static_cast<double>(count);
                const ListPixel& pixel = *all[i * all.size() / count];
                right_ += weight * cost_of(value({}, pixel, {}), pixel, unit_);
                pixels_.push_back({&pixel, weight, right_});
            }
        }
    }

    // Takes an edit, with the fragments that it changes.
    void add(Edit edit) {
        EditHere& here = edits_.emplace_back(EditHere{std::move(edit), {}});
        for (const WeighedPixel& w : pixels_) {
            std::vector<char>& mask = here.masks.emplace_back();
            select(here.edit, *w.pixel, mask);
            if (mask.empty()) mask = {0};
        }
    }

    void ask(std::size_t count) {
        for (std::size_t a = 0; a < edits_.size(); ++a) {
            if (count == 1) ask(edits_[a], nullptr);
            for (std::size_t b = a + 1; count == 2 && b < edits_.size(); ++b)
                if (edits_[a].edit.entry != edits_[b].edit.entry) ask(edits_[a], &edits_[b]);
        }
    }

    [[nodiscard]] std::vector<Program> best() && {
        std::vector<Program> all;
        for (CheapProgram& found : found_) all.push_back(std::move(found.program));
        return all;
    }

  private:
    static constexpr std::size_t most = 6;
    struct CheapProgram {
        double cost = 0;
        Program program{};
    };

    struct EditHere {
        Edit edit{};
        std::vector<std::vector<char>> masks{};
    };

    void ask(const EditHere& a, const EditHere* b) {
        constexpr double some = 0.25;   // of the right program's cost
        constexpr std::size_t few = 8;  // pixels that show if it may cost so little
        const double words = price(a.edit) + (b != nullptr ? price(b->edit) : 0);
        double cost = words;
        const double limit = std::min(some * right_, found_.size() < most ? some * right_ : found_.back().cost);
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const auto& [pixel, weight, right_so_far] = pixels_[i];
            std::array<Applied, 2> edits{Applied{a.edit.entry, a.edit.parameters, a.masks[i]}};
            if (b != nullptr) edits[1] = {b->edit.entry, b->edit.parameters, b->masks[i]};
            cost += weight * cost_of(run({edits.data(), b != nullptr ? 2u : 1u}, *pixel, {}), *pixel, unit_);
            if (cost >= limit || (i >= few && cost > 2 * some * right_so_far + words)) return;
        }
        Program program{.edits = {a.edit}};
        if (b != nullptr) program.edits.push_back(b->edit);
        found_.insert(std::ranges::upper_bound(found_, cost, {}, &CheapProgram::cost), {cost, std::move(program)});
        if (found_.size() > most) found_.pop_back();
    }

    double unit_ = 1, right_ = 0;
    std::vector<WeighedPixel> pixels_{};
    std::vector<EditHere> edits_{};
    std::vector<CheapProgram> found_{};
};

// Some layers of every pixel: by a plain property, a flag or a rank.
std::vector<Condition> plain_conditions() {
    using Kind = FragmentProperty::Kind;
    using Is = Condition::Is;
    std::vector<Condition> all;
    for (const FragmentProperty& p : properties()) {
        if (p.is_of_pixel || p.price > 5) continue;
        if (p.kind == Kind::flag) all.insert(all.end(), {{&p, Is::equal, 1}, {&p, Is::equal, 0}});
        if (p.kind != Kind::integer || p.name.find("rank") == p.name.npos || p.name.find("modulo") != p.name.npos)
            continue;
        for (const double first : {0, 1}) all.push_back({&p, Is::equal, first});
        for (const double end : {1, 2, 3, 4, 5, 6, 8}) all.push_back({&p, Is::at_least, end});
    }
    return all;
}

}  // namespace

std::vector<Program> plain_programs(const Lists& lists, std::size_t edits) {
    PairSearch search{lists};
    for (Variation& v : variations()) search.add({v.entry, std::move(v.parameters), {}});
    for (const Condition& condition : plain_conditions())
        for (const StepEntry& entry : list_entries().first(2)) search.add({&entry, {}, {condition}});
    search.ask(edits);
    return std::move(search).best();
}

}  // namespace strata::oracle::program
