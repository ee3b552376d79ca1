#include "tools/strata/options/option_readers.h"

#include <fmt/format.h>

#include <algorithm>

#include "peeling/registry.h"
#include "tools/strata/messages.h"

namespace strata::tools {

namespace {

using peeling::Algorithm;

struct Readers {
    std::string_view option;
    std::vector<std::string_view> algorithms;
    bool (*reads)(const Algorithm&) = nullptr;  // used instead of the names
};

const std::vector<Readers> all_readers{
    {"--average-count", {"weighted_average"}},
    {"--weight", {"weighted_blended", "weighted_blended_shared"}},
    {"--nodes", {"multi_layer", "adaptive", "atomic_loop", "hybrid_transparency"}},
    {"--tail", {"front_to_back", "dual", "atomic_loop", "hybrid_transparency"}},
    {"--pixel-nodes", {"linked_list"}},
    {"--frame-nodes", {"linked_list"}},
    {"--overflow", {"linked_list"}},
    {"--moments", {"moments", "moments_quantized"}},
    {"--moment-bias", {"moments", "moments_quantized"}},
    {"--overestimation", {"moments", "moments_quantized"}},
    {"--stochastic-samples", {"stochastic"}},
    {"--stochastic-seed", {"stochastic"}},
    {"--formulation", {}, [](const Algorithm& a) { return a.has_published_form; }},
    {"--sorted", {}, [](const Algorithm& a) { return a.order == peeling::ListOrder::sets; }}};

const Readers* readers_of(std::string_view option) {
    const auto found = std::ranges::find(all_readers, option, &Readers::option);
    return found == all_readers.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string_view> options_of_algorithms() {
    std::vector<std::string_view> options;
    for (const Readers& readers : all_readers) options.push_back(readers.option);
    return options;
}

bool reads(const Algorithm& algorithm, std::string_view option, const peeling::AlgorithmOptions& given) {
    const Readers* const readers = readers_of(option);
    if (readers == nullptr) return true;
    if (option == "--weight" && given.tail == peeling::Tail::weighted && reads(algorithm, "--tail", given)) return true;
    if (readers->reads != nullptr) return readers->reads(algorithm);
    return std::ranges::find(readers->algorithms, algorithm.name) != readers->algorithms.end();
}

void refuse_unread(const CLI::App& app, const std::vector<const Algorithm*>& algorithms,
                   const peeling::AlgorithmOptions& given) {
    for (const std::string_view option : options_of_algorithms()) {
        const CLI::Option* const found = app.get_option_no_throw(std::string{option});
        const auto is_reader = [&](const Algorithm* algorithm) { return reads(*algorithm, option, given); };
        if (found == nullptr || found->count() == 0 || std::ranges::any_of(algorithms, is_reader)) continue;
        std::vector<std::string_view> chosen, readers;
        for (const Algorithm* algorithm : algorithms) chosen.push_back(algorithm->name);
        for (const Algorithm& algorithm : peeling::algorithms())
            if (is_reader(&algorithm)) readers.push_back(algorithm.name);
        throw CLI::ValidationError(fmt::format("{} has no effect on {}; algorithms that use it: {}", option,
                                               fmt::join(chosen, ", "), fmt::join(readers, ", ")));
    }
}

void refuse_others(const CLI::App& app, const std::vector<std::string_view>& read, const std::string& why) {
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() > 0 && !is_message_option(*option) && std::ranges::find(read, name) == read.end())
            throw CLI::ValidationError(name + " has no effect " + why);
    }
}

}  // namespace strata::tools
