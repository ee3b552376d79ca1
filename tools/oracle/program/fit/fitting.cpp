// tools/oracle/program/fit/fitting.cpp - the order of the questions (fitting.h).
#include "tools/oracle/program/fit/fitting.h"

#include <algorithm>
#include <cmath>

#include "tools/oracle/program/fit/at_random.h"
#include "tools/oracle/program/fit/pairs.h"
#include "tools/oracle/program/fit/search.h"

namespace strata::oracle::program {

namespace {

constexpr std::size_t proved_of_search = 8, most_told = 6;

// The best edits on top of a program, proved.
std::vector<Proof> search_and_prove(const Lists& lists, const Program& base, const PortRounding& rounding,
                                    const Fitness& right) {
    const PixelClasses classes{lists, base, rounding};
    const FitSample sample{classes};
    std::vector<Proof> proofs, others;
    for (const Trial& trial : best_edits(FitSample{classes, small_sample}, sample, roundings(lists.format))) {
        if (proofs.size() >= proved_of_search || trial.cost > 0.9 * sample.cost()) break;
        Program program = base;
        program.edits.push_back(trial.edit);
        const PortRounding of_program = likely_rounding(lists, program);
        place_thresholds(lists, sample, program, of_program);
        proofs.push_back(prove(lists, program, right));
        // Programs that select the same are of use only if they are told: of a part by a first edit alone.
        const bool is_first = base.edits.empty() && base.drawing.empty();
        const bool may_be_told = proofs.back().is_whole || (proofs.back().is_part && is_first);
        if (!may_be_told || proofs.back().cost > 0.5 * right.bits || proofs.size() > 3) continue;
        for (Program& equal : equal_programs(sample, program)) {
            place_thresholds(lists, sample, equal, of_program);
            const Fitness fitness = measure(lists, equal, of_program);
            if (fitness.bits < 1.15 * proofs.back().fitness.bits + 60)
                others.push_back(prove(lists, equal, right, nullptr, &fitness));
        }
    }
    proofs.insert(proofs.end(), others.begin(), others.end());
    return proofs;
}

// True if they differ in numbers alone.
bool says_the_same(const Program& a, const Program& b) {
    return std::ranges::equal(a.edits, b.edits, [](const Edit& x, const Edit& y) {
        return x.entry == y.entry &&
               std::ranges::is_permutation(x.conditions, y.conditions, {}, &Condition::property, &Condition::property);
    });
}

// Those that cost about as little as the best, the plainest first.
std::vector<Proof> alike(const Lists& lists, std::vector<Proof> proofs) {
    if (proofs.empty()) return proofs;
    // A cause goes before a free fit of many numbers.
    const auto is_free = [](const Proof& p) {
        return !p.program.edits.empty() && p.program.edits.back().entry->start != nullptr;
    };
    if (!std::ranges::all_of(proofs, is_free)) std::erase_if(proofs, is_free);
    const double best = std::ranges::min(proofs, {}, &Proof::cost).cost;
    std::erase_if(proofs, [&](const Proof& p) { return p.cost > 1.15 * best + 60; });
    std::ranges::stable_sort(proofs, {}, &Proof::rank);
    std::vector<Proof> told;
    for (Proof& proof : proofs) {
        const bool is_told =
            std::ranges::any_of(told, [&](const Proof& p) { return says_the_same(p.program, proof.program); });
        if (is_told || told.size() >= most_told) continue;
        proof.is_equal = told.empty() || predict_alike({lists, told[0].program}, {lists, proof.program});
        told.push_back(std::move(proof));
    }
    return told;
}

// A second edit repairs what the first one does not describe: it is a mistake of its own only if few words say it,
// and if it repairs some pixels.
bool is_plain_pair(const Program& program) {
    const Edit &first = program.edits.front(), &second = program.edits.back();
    const bool are_orders = program.edits.size() > 1 && first.entry->is_order && second.entry->is_order;
    return second.conditions.size() <= 1 && first.conditions.size() <= 1 &&
           std::ranges::all_of(second.parameters, is_round) && !are_orders;
}

std::vector<Proof> only(std::vector<Proof> proofs, bool Proof::*is) {
    std::erase_if(proofs, [&](const Proof& p) { return !(p.*is); });
    return proofs;
}

}  // namespace

std::vector<Proof> with_one_more(const Lists& lists, const Proof& base, const Fitness& right) {
    std::vector<Proof> whole =
        only(search_and_prove(lists, base.program, base.fitness.rounding, right), &Proof::is_whole);
    constexpr std::uint64_t few = 20;  // pixels
    std::erase_if(whole, [&](const Proof& p) {
        return !is_plain_pair(p.program) || base.fitness.beyond < p.fitness.beyond + few;
    });
    return whole;
}

namespace {

// Two plain edits.
std::vector<Proof> proved_pairs(const Lists& lists, const Fitness& right) {
    std::vector<Proof> proofs;
    for (const Program& pair : plain_programs(lists, 2))
        if (is_plain_pair(pair)) proofs.push_back(prove(lists, pair, right));
    return only(std::move(proofs), &Proof::is_whole);
}

Fitting fitted(const Lists& lists) {
    using State = Fitting::State;
    Fitting fitting{.right = best_fitness(lists, {})};
    const Fitness& right = fitting.right;
    const bool may_be_right = is_narrow(right);
    if (is_plainly_right(right)) {
        fitting.state = State::right;
        return fitting;
    }
    std::vector<Proof> proofs = search_and_prove(lists, {}, right.rounding, right);
    std::vector<Proof> whole = only(proofs, &Proof::is_whole);
    std::vector<Proof> part = only(proofs, &Proof::is_part);
    if (may_be_right) {
        std::erase_if(whole, [&](const Proof& p) { return p.cost > 0.12 * right.bits; });
        part.clear();
    } else if (whole.empty()) {
        whole = proved_pairs(lists, right);
        constexpr double some = 0.8;  // of the cost of the right program: worth a search on top
        const std::vector<Proof> bases = alike(lists, std::move(proofs));
        if (whole.empty() && !bases.empty() && bases[0].cost < some * right.bits)
            whole = with_one_more(lists, bases[0], right);
        if (whole.empty()) whole = explained_at_random(lists, right);
    }
    if (!whole.empty()) {
        fitting.state = State::explained;
        fitting.found = alike(lists, std::move(whole));
    } else if (may_be_right) {
        fitting.state = State::right;
    } else if (!part.empty()) {
        fitting.state = State::explained_in_part;
        fitting.found = alike(lists, std::move(part));
    }
    return fitting;
}

// About `most` pixels of a picture, at even distances. They refer to the fragments of the given lists.
Lists thinned(const Lists& lists, std::size_t most) {
    Lists few;
    few.width = lists.width;
    few.height = lists.height;
    few.format = lists.format;
    const std::size_t step = lists.pixels.size() / most | 1;
    for (std::size_t i = 0; i < lists.pixels.size(); i += step) few.pixels.push_back(lists.pixels[i]);
    return few;
}

// What was found on some pixels, proved on all.
Fitting proved(const Lists& lists, const Fitting& of_few, const Fitness& right) {
    using State = Fitting::State;
    Fitting fitting{.right = right};
    for (const Proof& found : of_few.found) {
        Proof proof = prove(lists, found.program, right);
        proof.is_equal = found.is_equal;
        if (proof.is_whole || proof.is_part) fitting.found.push_back(std::move(proof));
    }
    if (std::ranges::any_of(fitting.found, &Proof::is_whole)) {
        fitting.state = State::explained;
        std::erase_if(fitting.found, [](const Proof& p) { return !p.is_whole; });
    } else if (is_narrow(right)) {
        fitting.state = State::right;
        fitting.found.clear();
    } else if (!fitting.found.empty()) {
        fitting.state = State::explained_in_part;
    }
    return fitting;
}

}  // namespace

Fitting fit(const Lists& lists) {
    constexpr std::size_t most = 32768;
    if (lists.pixels.size() <= 2 * most) return fitted(lists);
    const Fitness right = best_fitness(lists, {});
    if (is_plainly_right(right)) return {.state = Fitting::State::right, .right = right};
    return proved(lists, fitted(thinned(lists, most)), right);
}

}  // namespace strata::oracle::program
