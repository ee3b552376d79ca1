// tools/oracle/program/fit/search.cpp - the order of the search (search.h).
#include "tools/oracle/program/fit/search.h"

#include <algorithm>
#include <memory>
#include <set>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

void Beam::add(Trial trial) {
    if (std::ranges::find(trials_, trial.edit, &Trial::edit) != trials_.end()) return;
    if (trial.cost >= limit()) return;
    const auto at = std::ranges::upper_bound(trials_, trial.cost, {}, &Trial::cost);
    const StepEntry* const entry = trial.edit.entry;
    trials_.insert(at, std::move(trial));
    std::size_t of_entry = 0;
    for (auto t = trials_.begin(); t != trials_.end(); ++t)
        if (t->edit.entry == entry && ++of_entry > most_of_entry_) {
            trials_.erase(t);
            break;
        }
    if (trials_.size() > most_) trials_.pop_back();
}

namespace {

enum class Among { all, pixels };

// Conditions with the fragments, or pixels, of the sample that meet them.
struct ConditionMask {
    Condition condition{};
    SampleMask mask;
};
struct ConditionMasks {
    std::unique_ptr<MaskNumbers> numbers = std::make_unique<MaskNumbers>();
    std::vector<ConditionMask> all{};
};

class Search {
  public:
    explicit Search(const FitSample& sample) : sample_{sample} {
        for (const FragmentProperty& property : properties()) by_price_.push_back(&property);
        std::ranges::stable_sort(by_price_, {}, &FragmentProperty::price);
    }

    std::vector<Trial> run() {
        solved_ = solve(sample_);
        for (Solved& s : solved_) {
            const Edit edit{s.variation.entry, s.variation.parameters, {}};
            const Score score = sample_.score(edit);
            s.saved = score.saved;
            add(edit, score);
        }
        fit_all();
        learn_from_solved();
        try_stumps();
        for (const Trial& trial : std::vector<Trial>{saving_.trials()}) try_conditions(trial.edit, Among::pixels);
        refine(6);
        join(6);
        refine(6);
        join(3);
        refine(8);
        return best_.trials();
    }

  private:
    static constexpr std::uint64_t most_work = 200'000'000;  // layers composited in one stage

    void add(const Edit& edit, const Score& score) {
        best_.add({edit, score.bits + price(edit)});
        saving_.add({edit, sample_.cost() - score.saved + price(edit)});
    }
    void add(const Edit& edit) { add(edit, sample_.score(edit)); }

    // Every continuous parameter without a condition.
    void fit_all() {
        for (const StepEntry* entry : entries()) {
            if (!entry->is_continuous) continue;
            Beam candidates{1, 1};
            for (const double p : entry->parameters) {
                const Edit edit{entry, {p}, {}};
                candidates.add({edit, sample_.score(edit).bits + price(edit)});
            }
            Trial trial = candidates.trials()[0];
            Scorer scorer{sample_};
            fit_parameter(scorer, trial);
            best_.add(std::move(trial));
        }
    }

    void learn_from_solved() {
        const std::size_t few = std::max<std::size_t>(3, sample_.wrong() / 50);
        for (const Solved& s : solved_)
            if (s.hits.size() >= few) add({s.variation.entry, s.variation.parameters, learn(sample_, s)});
    }

    // The conditions of one more that select other fragments, or other pixels, of those given. Of conditions that
    // select the same the cheapest is kept.
    [[nodiscard]] ConditionMasks choices(const std::vector<char>& given, PortStep step, Among among) const {
        ConditionMasks made;
        std::vector<char> mask(given.size());
        std::set<std::vector<char>> known{given};
        for (const FragmentProperty* property : by_price_) {
            if ((step != PortStep::list || among == Among::pixels) && !property->is_of_pixel) continue;
            const std::vector<double>& values = sample_.values(*property, step);
            std::vector<double> here;
            for (std::size_t i = 0; i < given.size(); ++i)
                if (given[i] != 0) here.push_back(values[i]);
            for (const Condition& condition : conditions_of(*property, here)) {
                for (std::size_t i = 0; i < mask.size(); ++i)
                    mask[i] = given[i] != 0 && condition.holds(values[i]) ? 1 : 0;
                if (known.insert(mask).second) made.all.push_back({condition, {mask, *made.numbers}});
            }
        }
        return made;
    }

    void try_choices(const Edit& edit, ConditionMasks& masks) {
        const double words = price(edit);
        KnownCosts known;
        for (ConditionMask& choice : masks.all) {
            if (work_ > most_work) return;
            work_ += sample_.fragments();
            const WantedScore wanted{best_.limit() - words, sample_.cost() - saving_.limit() + words};
            const Score score = sample_.score(*edit.entry, edit.parameters, choice.mask, known, wanted);
            if (score.bits >= wanted.bits && score.saved <= wanted.saved) continue;
            Edit trial = edit;
            trial.conditions.push_back(choice.condition);
            add(trial, score);
        }
    }

    void try_conditions(const Edit& edit, Among among) {
        const std::vector<char> given = sample_.mask(*edit.entry, edit.conditions);
        ConditionMasks masks = choices(given, edit.entry->step, among);
        try_choices(edit, masks);
    }

    // Of each entry the variations that hit most fragments, or save most.
    [[nodiscard]] std::vector<Variation> promising() const {
        constexpr std::size_t of_entry = 2;
        struct Promise {
            Variation variation;
            std::size_t hits;
            double saved;
        };
        std::vector<Variation> chosen;
        for (const StepEntry* entry : entries()) {
            std::vector<Promise> all;
            for (const Solved& s : solved_)
                if (s.variation.entry == entry) all.push_back({s.variation, s.hits.size(), s.saved});
            std::ranges::stable_sort(all, std::ranges::greater{}, [](const Promise& p) {
                return std::pair{p.hits, p.saved};
            });
            for (std::size_t i = 0; i < std::min(all.size(), of_entry); ++i) chosen.push_back(all[i].variation);
        }
        return chosen;
    }

    // Entries with every condition.
    void try_stumps() {
        ConditionMasks of_fragments = choices(std::vector<char>(sample_.fragments(), 1), PortStep::list, Among::all);
        ConditionMasks of_pixels =
            choices(std::vector<char>(sample_.pixels().size(), 1), PortStep::finish, Among::pixels);
        for (const Variation& v : promising())
            try_choices({v.entry, v.parameters, {}}, v.entry->step == PortStep::list ? of_fragments : of_pixels);
    }

    void refine(std::size_t count) {
        std::vector<Trial> best{best_.trials()};
        best.resize(std::min(best.size(), count));
        for (Trial& trial : best) {
            Scorer scorer{sample_};
            walk_thresholds(scorer, trial);
            fit_parameter(scorer, trial);
            best_.add(std::move(trial));
        }
    }

    // One more condition for the best.
    void join(std::size_t count) {
        std::vector<Trial> best{best_.trials()};
        best.resize(std::min(best.size(), count));
        for (const Trial& trial : best)
            if (trial.edit.conditions.size() < 3 && trial.cost > 0.002 * sample_.cost()) {
                work_ = 0;
                try_conditions(trial.edit, Among::all);
            }
    }

    const FitSample& sample_;
    std::vector<const FragmentProperty*> by_price_{};
    std::vector<Solved> solved_{};
    Beam best_{32, 4}, saving_{8, 2};
    std::uint64_t work_ = 0;
};

// The rounding under which an edit costs least.
struct Closest {
    const Emulation* emulation = nullptr;
    double cost = std::numeric_limits<double>::infinity();
};
Closest closest_of(const FitSample& sample, const std::vector<Emulation>& emulations, const Edit& edit) {
    const std::vector<double> bits = sample.emulated(edit, emulations);
    const auto least = std::ranges::min_element(bits);
    return {&emulations[static_cast<std::size_t>(least - bits.begin())], price(edit) + *least};
}

// Other entries, with the conditions of the best trial, that cost as little: one of them may be plainer.
void add_alike(const FitSample& sample, const std::vector<Emulation>& emulations, Beam& beam) {
    if (beam.trials().empty()) return;
    const Edit best = beam.trials()[0].edit;
    const double least = sample.score(best).bits;
    for (const Variation& v : variations()) {
        if (v.entry->step != PortStep::list &&
            !std::ranges::all_of(best.conditions, [](const Condition& c) { return c.property->is_of_pixel; }))
            continue;
        Trial trial{.edit = {v.entry, v.parameters, best.conditions}};
        if (sample.score(trial.edit).bits > 1.02 * least + 10) continue;
        trial.cost = closest_of(sample, emulations, trial.edit).cost;
        beam.add(std::move(trial));
    }
}

}  // namespace

std::vector<Trial> best_edits(const FitSample& few, const FitSample& many, std::span<const PortRounding> roundings) {
    std::vector<Emulation> emulations;
    for (const PortRounding& r : roundings) emulations.push_back(many.emulation(r));
    std::vector<Trial> trials = Search{few}.run();
    Beam beam{24, 4};
    for (Trial& trial : trials) {
        const Closest closest = closest_of(many, emulations, trial.edit);
        trial.cost = closest.cost;
        if (trial.cost > 2 * beam.limit_of(8)) continue;
        Scorer scorer{many, *closest.emulation};
        if (trial.cost < beam.limit_of(3) && trial.cost > 0.01 * many.cost()) exchange_conditions(scorer, trial);
        walk_thresholds(scorer, trial);
        fit_parameter(scorer, trial);
        drop_conditions(scorer, trial);
        beam.add(std::move(trial));
    }
    add_alike(many, emulations, beam);
    const auto [nearest, farthest] = many.depths();
    for (const StepEntry* entry : entries()) {
        if (entry->start == nullptr) continue;
        Trial trial{.edit = {entry, entry->start(nearest, farthest), {}}};
        Scorer scorer{many};
        fit_parameters(scorer, trial);
        trial.cost = closest_of(many, emulations, trial.edit).cost;
        beam.add(std::move(trial));
    }
    return beam.trials();
}

}  // namespace strata::oracle::program
