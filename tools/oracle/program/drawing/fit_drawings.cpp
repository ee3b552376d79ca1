// tools/oracle/program/drawing/fit_drawings.cpp - proves the right program on other lists (fit_drawings.h).
#include "tools/oracle/program/drawing/fit_drawings.h"

#include <algorithm>
#include <cmath>

#include "tools/oracle/program/fit/pairs.h"

namespace strata::oracle::program {

namespace {

struct ProvedDrawing {
    const OtherLists* other = nullptr;
    Proof proof{};
};

// Those that cost about as little as the best, the plainest first.
std::vector<Proof> told(const std::vector<ProvedDrawing>& whole) {
    constexpr std::size_t most_told = 4;
    const double best = std::ranges::min(whole, {}, [](const ProvedDrawing& d) { return d.proof.cost; }).proof.cost;
    std::vector<ProvedDrawing> some;
    std::ranges::copy_if(whole, std::back_inserter(some),
                         [&](const ProvedDrawing& d) { return d.proof.cost <= 1.15 * best + 20; });
    std::ranges::stable_sort(some, {}, [](const ProvedDrawing& d) { return d.proof.rank(); });
    std::vector<Proof> all;
    for (ProvedDrawing& d : some) {
        if (all.size() == most_told) break;
        if (std::ranges::any_of(all, [&](const Proof& p) { return describe(p.program) == describe(d.proof.program); }))
            continue;
        d.proof.is_equal = all.empty() || predict_alike({some[0].other->lists, some[0].proof.program},
                                                        {d.other->lists, d.proof.program});
        all.push_back(std::move(d.proof));
    }
    return all;
}

}  // namespace

Fitting fit_drawings(const Lists& given, const std::vector<OtherLists>& others, const Fitness* right) {
    using State = Fitting::State;
    Fitting fitting{.right = right != nullptr ? *right : best_fitness(given, {})};
    std::vector<ProvedDrawing> whole, part, cheaper;
    for (const OtherLists& other : others) {
        Program program;
        program.drawing = other.words;
        program.drawing_price = other.price;
        Proof proof = prove(other.lists, program, fitting.right, &given);
        constexpr double some = 0.8;  // of the cost of the right program: worth a search on top
        if (proof.cost < some * fitting.right.bits) cheaper.push_back({&other, proof});
        if (proof.is_whole)
            whole.push_back({&other, std::move(proof)});
        else if (proof.is_part)
            part.push_back({&other, std::move(proof)});
    }
    if (whole.empty())
        for (const OtherLists& other : others)
            for (Program& program : plain_programs(other.lists, 1)) {
                program.drawing = other.words;
                program.drawing_price = other.price;
                Proof proof = prove(other.lists, program, fitting.right, &given);
                if (proof.is_whole) whole.push_back({&other, std::move(proof)});
            }
    if (whole.empty() && !cheaper.empty()) {
        const ProvedDrawing& base = std::ranges::min(cheaper, {}, [](const ProvedDrawing& d) { return d.proof.cost; });
        for (Proof& proof : with_one_more(base.other->lists, base.proof, fitting.right))
            whole.push_back({base.other, std::move(proof)});
    }
    if (!whole.empty()) {
        fitting.state = State::explained;
        fitting.found = told(whole);
    } else if (!part.empty()) {
        fitting.state = State::explained_in_part;
        fitting.found = told(part);
    }
    return fitting;
}

}  // namespace strata::oracle::program
