// tools/strata/manual/help_text.cpp - the text of --help: options in groups, the common ones first.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tools/strata/manual/manual.h"

namespace strata::tools {

namespace {

struct OptionGroup {
    std::string title;
    HelpDetail shown;
    std::vector<std::string> names;
};

// The groups of options in the order of --help. Options without a group are listed under "Options".
const std::vector<OptionGroup>& groups() {
    static const std::vector<OptionGroup> all{
        {"What is drawn",
         HelpDetail::usual,
         {"scene", "color-space", "no-light", "algorithm", "profile", "origin", "depth-format", "from"}},
        {"The view",
         HelpDetail::usual,
         {"size", "camera", "orbit", "alpha", "background", "samples", "sample", "resolve"}},
        {"Results",
         HelpDetail::usual,
         {"output", "format", "stats", "no-audit", "json", "csv", "digests", "expect", "channels", "report", "map",
          "region"}},
        {"Messages", HelpDetail::usual, {"quiet", "verbose", "color"}},
        {"Depths and positions, rarely needed",
         HelpDetail::all,
         {"depth-path", "reference-path", "compare-epsilon", "no-quantize-reference", "vertex-path", "polygon-offset",
          "depth-order", "clip-depth", "depth-range", "scissor"}},
        {"Algorithms, rarely needed",
         HelpDetail::all,
         {"color-format", "result-format", "back-format", "average-count", "termination", "max-passes", "formulation",
          "sorted", "sort", "mistake"}},
        {"Single algorithms, rarely needed",
         HelpDetail::all,
         {"weight", "nodes", "tail", "pixel-nodes", "frame-nodes", "overflow", "moments", "moment-bias",
          "overestimation", "stochastic-samples", "stochastic-seed"}},
        {"Samples of a pixel, rarely needed",
         HelpDetail::all,
         {"shading", "interpolate", "load-sample", "composite-sample", "alpha-to-coverage", "sample-coverage",
          "sample-coverage-invert", "sample-mask"}},
        {"Files of --from, rarely needed", HelpDetail::all, {"files-in"}},
        {"How it is run, to the same bits",
         HelpDetail::all,
         {"execution", "counters", "simd", "effects", "fragment-memory", "max-memory", "tile", "threads"}},
    };
    return all;
}

const OptionGroup* group_of(const CLI::Option& option) {
    for (const OptionGroup& group : groups())
        for (const std::string& name : group.names)
            if (option.check_lname(name)) return &group;
    return nullptr;
}

}  // namespace

std::string typed_name(const CLI::Option& option) {
    if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
    return option.get_snames().empty() ? "" : "-" + option.get_snames().front();
}

std::vector<CLI::App*> commands_of(CLI::App& root) {
    return root.get_subcommands([](CLI::App*) { return true; });
}

std::string help_of(CLI::App& command, HelpDetail shown) {
    std::size_t hidden = 0;
    for (CLI::Option* option : command.get_options()) {
        if (option->get_positional() || option->get_group().empty()) continue;
        const OptionGroup* group = group_of(*option);
        if (group == nullptr) continue;
        const bool is_hidden = group->shown == HelpDetail::all && shown == HelpDetail::usual;
        option->group(is_hidden ? "" : group->title);
        hidden += is_hidden ? 1 : 0;
    }
    const bool is_root = command.get_parent() == nullptr;
    std::string text = command.help(is_root ? "" : "strata") + '\n';
    if (hidden > 0)
        text += fmt::format("{} rare options are left out here: strata {} --help all\n", hidden, command.get_name());
    return text;
}

}  // namespace strata::tools
