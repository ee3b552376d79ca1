// tools/strata/lists.cpp - strata algorithms, profiles, scenes: what there is to choose from.
#include <memory>
#include <nlohmann/json.hpp>

#include "peeling/registry.h"
#include "scenes/files/profile_json.h"
#include "scenes/scene.h"
#include "tools/strata/command.h"
#include "tools/strata/options/options.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

// The command line of a list; `name` is given to `profiles` alone.
struct ListOptions {
    bool json = false;
    std::string name;  // profiles alone
};

// Built-in profiles that do not refuse the algorithm.
std::vector<std::string> profiles_that_run(const peeling::Algorithm& algorithm) {
    std::vector<std::string> names;
    for (const auto& profile : pipeline::builtin_profiles()) {
        if (!peeling::refusal(algorithm, profile)) names.push_back(profile.name);
    }
    return names;
}

// The features that an algorithm needs, in the words in which a profile is refused: a profile without any feature is
// refused for each of them.
std::vector<std::string> needs_of(const peeling::Algorithm& algorithm) {
    pipeline::DeviceProfile nothing;
    nothing.has_d24 = nothing.has_sequential_depth_units = false;
    std::vector<std::string> words;
    for (const pipeline::Feature feature : algorithm.features) {
        if (const auto refusal = pipeline::check(nothing, feature)) words.push_back(refusal->feature);
    }
    return words;
}

// The depth that the algorithm compares, by its name in --json.
std::string_view key_name(pipeline::DepthKey key) {
    return key == pipeline::DepthKey::shader_z ? "shader_z" : "stored_code";
}

int list_algorithms(const ListOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"algorithm"}, {"geometry passes"}, {"ties"}, {"exact"}, {"profiles"}, {"paper"}}, {}};
    Table summaries{{{"algorithm"}, {"what it does"}}, {}};
    for (const peeling::Algorithm& a : peeling::algorithms()) {
        const auto profiles = profiles_that_run(a);
        document.push_back({{"name", a.name},
                            {"paper", a.paper},
                            {"section", a.section},
                            {"summary", a.summary},
                            {"needs", needs_of(a)},
                            {"pass_formula", a.pass_formula},
                            {"ties", peeling::name(a.ties)},
                            {"key", key_name(a.key)},
                            {"exact", a.exact},
                            {"makes_layers", a.makes_layers},
                            {"profiles", profiles}});
        // "all" instead of every name keeps the table narrow.
        const bool runs_everywhere = profiles.size() == pipeline::builtin_profiles().size();
        std::string where = runs_everywhere ? "all" : "";
        for (std::size_t i = 0; !runs_everywhere && i < profiles.size(); ++i) where += (i > 0 ? "," : "") + profiles[i];
        const std::string paper = a.section.empty() ? a.paper : a.paper + ", " + a.section;
        table.rows.push_back(
            {a.name, a.pass_formula, std::string(peeling::name(a.ties)), a.exact ? "yes" : "no", where, paper});
        summaries.rows.push_back({a.name, a.summary});
    }
    print(options.json ? document.dump(2) + '\n' : titled(to_text(table)) + '\n' + to_text(summaries));
    return 0;
}

int list_scenes(const ListOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"scene"}, {"what it is"}}, {}};
    for (const auto& scene : scenes::procedural_scenes()) {
        document.push_back(
            {{"name", scene.name}, {"parameters", scene.parameters}, {"description", scene.description}});
        table.rows.push_back(
            {scene.parameters.empty() ? scene.name : scene.name + ":" + scene.parameters, scene.description});
    }
    print(options.json ? document.dump(2) + '\n'
                       : titled(to_text(table)) + "Every .gltf and .glb file is a scene, too.\n");
    return 0;
}

int list_profiles(const ListOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"profile"}, {"what it is"}}, {}};
    for (const auto& profile : pipeline::builtin_profiles()) {
        document.push_back(ordered_json::parse(scenes::to_json(profile)));
        table.rows.push_back({profile.name, profile.description});
    }
    print(options.json ? document.dump(2) + '\n'
                       : titled(to_text(table)) + "strata profiles NAME prints its numbers and where each is from.\n");
    return 0;
}

// Every number with its source: S specified, M measured, A assumed; then the page and section of the book.
int show_profile(const ListOptions& options) {
    const pipeline::DeviceProfile profile = scenes::load_profile(options.name);
    if (options.json) {
        std::string text = scenes::to_json(profile);
        if (!text.ends_with('\n')) text += '\n';
        print(text);
        return 0;
    }
    Table table{{{"key"}, {"value"}, {"source"}}, {}};
    for (const auto& entry : pipeline::describe(profile)) table.rows.push_back({entry.key, entry.value, entry.source});
    print(profile.name + ": " + profile.description + "\n\n" + titled(to_text(table)));
    return 0;
}

// A listing subcommand: its words, and what runs.
struct List {
    std::string name, help, json_help, examples;
    int (*run)(const ListOptions&);
};

Command add_list(CLI::App& root, const std::shared_ptr<ListOptions>& options, const List& list) {
    auto* app = root.add_subcommand(list.name, list.help);
    app->add_flag("--json", options->json, list.json_help);
    app->footer(footer(list.examples));
    return {app, [options, run = list.run] { return run(*options); }};
}

int list_or_show_profiles(const ListOptions& options) {
    return options.name.empty() ? list_profiles(options) : show_profile(options);
}

constexpr auto json_instead = "one JSON document instead of the table";

}  // namespace

Command add_algorithms(CLI::App& root) {
    return add_list(root, std::make_shared<ListOptions>(),
                    {"algorithms", "list the algorithms: paper, passes, ties, and which profiles run them",
                     json_instead, "  strata algorithms\n  strata algorithms --json\n", list_algorithms});
}

Command add_scenes(CLI::App& root) {
    return add_list(
        root, std::make_shared<ListOptions>(),
        {"scenes", "list the built-in scenes", json_instead, "  strata scenes\n  strata scenes --json\n", list_scenes});
}

Command add_profiles(CLI::App& root) {
    const auto options = std::make_shared<ListOptions>();
    const Command command = add_list(
        root, options,
        {"profiles", "list the emulated devices, or show the numbers of one and where each is from",
         "JSON instead of the table; of one profile, what --profile FILE.json takes",
         "  strata profiles\n  strata profiles geforce3\n  strata profiles --json ideal\n", list_or_show_profiles});
    command.app->add_option("NAME", options->name, "a built-in profile, or a JSON file with one")->type_name("");
    return command;
}

}  // namespace strata::tools
