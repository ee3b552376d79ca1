// tools/strata/lists.cpp - strata list: lists the available algorithms, profiles and scenes.
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "peeling/registry.h"
#include "scenes/files/profile_json.h"
#include "scenes/scene.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/options.h"
#include "tools/strata/papers.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

enum class ListKind : std::uint8_t { algorithms, profiles, scenes };

// The options of the command line; with an empty name all entries are listed.
struct ListOptions {
    ListKind what = ListKind::algorithms;
    std::string name;
    bool json = false;
};

// The web address of a paper.
struct PaperLink {
    std::string_view paper, link;
};
constexpr std::array paper_links{PaperLink{"Everitt 2001", everitt_2001_link},
                                 PaperLink{"Bavoil and Myers 2008", bavoil_2008_link},
                                 PaperLink{"Carr, Mech and Miller 2008", carr_2008_link}};

std::string link_of(const std::string& paper) {
    const auto found = std::ranges::find(paper_links, paper, &PaperLink::paper);
    return found == paper_links.end() ? "" : std::string(found->link);
}

// The entries of `all`, or only the requested one; `name_of_one` returns an entry's name. Throws CLI::ValidationError
// for an unknown name.
template <class Range, class Name>
auto chosen(const Range& all, const ListOptions& options, const std::string& what, Name name_of_one) {
    std::vector<std::ranges::range_value_t<Range>> found;
    std::vector<std::string> names;
    for (const auto& one : all) {
        names.push_back(name_of_one(one));
        if (options.name.empty() || options.name == names.back()) found.push_back(one);
    }
    if (found.empty())
        throw CLI::ValidationError(
            "NAME", "expected " + what + " (" + one_of(names) + "), found " + found_but_near(options.name, names));
    return found;
}

// The built-in profiles that can run the algorithm.
std::vector<std::string> profiles_that_run(const peeling::Algorithm& algorithm) {
    std::vector<std::string> names;
    for (const auto& profile : pipeline::builtin_profiles()) {
        if (!peeling::refusal(algorithm, profile)) names.push_back(profile.name);
    }
    return names;
}

// The features that an algorithm needs, in the words of refusals: they are collected by asking a profile without any
// feature.
std::vector<std::string> needs_of(const peeling::Algorithm& algorithm) {
    pipeline::DeviceProfile nothing;
    nothing.has_d24 = nothing.has_sequential_depth_units = false;
    std::vector<std::string> words;
    for (const pipeline::Feature feature : algorithm.features) {
        if (const auto refusal = pipeline::check(nothing, feature)) words.push_back(refusal->feature);
    }
    return words;
}

// The name in --json of the depth that the algorithm compares.
std::string_view key_name(pipeline::DepthKey key) {
    return key == pipeline::DepthKey::shader_z ? "shader_z" : "stored_code";
}

// A group of algorithms with similar numbers of passes, which are alternatives to each other.
struct AlgorithmGroup {
    std::string_view name, heading;  // in --json, and above the group's table
    bool (*has)(const peeling::Algorithm&);
};

bool has_fixed_passes(const peeling::Algorithm& a) {
    return a.geometry_passes != nullptr && a.geometry_passes(2) == a.geometry_passes(9);
}

// An algorithm belongs to the first group that contains it; the groups are printed in reverse order.
constexpr std::array algorithm_groups{
    AlgorithmGroup{"oracle", "What the others are measured against; no device runs it:",
                   [](const peeling::Algorithm& a) { return a.is_oracle; }},
    AlgorithmGroup{"fixed_passes",
                   "A fixed number of passes, exact under a condition or not at all:", has_fixed_passes},
    AlgorithmGroup{"conditional", "As many passes as the picture takes, exact under a condition:",
                   [](const peeling::Algorithm& a) { return !a.exact; }},
    AlgorithmGroup{"exact_peel", "Exact, with as many passes as the layers of the picture take:",
                   [](const peeling::Algorithm&) { return true; }}};

std::size_t group_of(const peeling::Algorithm& algorithm) {
    std::size_t group = 0;
    while (!algorithm_groups[group].has(algorithm)) ++group;
    return group;
}

int list_algorithms(const ListOptions& options) {
    ordered_json document = ordered_json::array();
    const Table empty{{{"algorithm"}, {"geometry passes"}, {"ties"}, {"exact"}, {"profiles"}, {"paper"}}, {}};
    std::vector<Table> tables(algorithm_groups.size(), empty);
    Table summaries{{{"algorithm"}, {"what it does"}}, {}};
    std::set<std::string> links;
    for (const peeling::Algorithm& a :
         chosen(peeling::algorithms(), options, "an algorithm", [](const auto& one) { return one.name; })) {
        const auto profiles = profiles_that_run(a);
        document.push_back({{"name", a.name},
                            {"paper", a.paper},
                            {"section", a.section},
                            {"link", link_of(a.paper)},
                            {"summary", a.summary},
                            {"needs", needs_of(a)},
                            {"render_targets", a.render_targets},
                            {"samples", a.samples},
                            {"pass_formula", a.pass_formula},
                            {"ties", peeling::name(a.ties)},
                            {"key", key_name(a.key)},
                            {"exact", a.exact},
                            {"group", algorithm_groups[group_of(a)].name},
                            {"makes_layers", a.makes_layers},
                            {"profiles", profiles}});
        // Prints "all" instead of every name, to keep the table narrow.
        const bool runs_everywhere = profiles.size() == pipeline::builtin_profiles().size();
        std::string where = runs_everywhere ? "all" : "";
        for (std::size_t i = 0; !runs_everywhere && i < profiles.size(); ++i) where += (i > 0 ? "," : "") + profiles[i];
        const std::string paper = a.section.empty() ? a.paper : a.paper + ", " + a.section;
        tables[group_of(a)].rows.push_back(
            {a.name, a.pass_formula, std::string(peeling::name(a.ties)), a.exact ? "yes" : "no", where, paper});
        summaries.rows.push_back({a.name, a.summary});
        if (const std::string link = link_of(a.paper); !link.empty()) links.insert(a.paper + ": " + link);
    }
    std::string papers;
    for (const std::string& link : links) papers += link + '\n';
    std::string groups;
    for (std::size_t g = tables.size(); g-- > 0;)
        if (!tables[g].rows.empty())
            groups += std::string(algorithm_groups[g].heading) + '\n' + titled(to_text(tables[g])) + '\n';
    print(options.json ? document.dump(2) + '\n' : groups + to_text(summaries) + (papers.empty() ? "" : "\n" + papers));
    return 0;
}

int list_scenes(const ListOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"scene"}, {"what it is"}}, {}};
    for (const auto& scene :
         chosen(scenes::procedural_scenes(), options, "a built-in scene", [](const auto& one) { return one.name; })) {
        document.push_back(
            {{"name", scene.name}, {"parameters", scene.parameters}, {"description", scene.description}});
        table.rows.push_back(
            {scene.parameters.empty() ? scene.name : scene.name + ":" + scene.parameters, scene.description});
    }
    print(options.json
              ? document.dump(2) + '\n'
              : titled(to_text(table)) + (options.name.empty() ? "Every .gltf and .glb file is a scene, too.\n" : ""));
    return 0;
}

int list_profiles(const ListOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"profile"}, {"what it is"}}, {}};
    for (const auto& profile : pipeline::builtin_profiles()) {
        document.push_back(ordered_json::parse(scenes::to_json(profile)));
        table.rows.push_back({profile.name, profile.description});
    }
    print(options.json
              ? document.dump(2) + '\n'
              : titled(to_text(table)) + "strata list profiles NAME prints its numbers and where each is from.\n");
    return 0;
}

// Prints every constant of a profile with its source.
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
    print(
        profile.name + ": " + profile.description + "\n\n" + titled(to_text(table)) +
        "[S]: specified by a standard or the vendor. [M]: measured on the device. [A]: assumed, for nothing says it.\n"
        "Behind it stands where that is written: a page of rasterizer/reference or pipeline/reference and its "
        "section.\n");
    return 0;
}

int list(const ListOptions& options) {
    switch (options.what) {
        case ListKind::algorithms: return list_algorithms(options);
        case ListKind::profiles: return options.name.empty() ? list_profiles(options) : show_profile(options);
        case ListKind::scenes: break;
    }
    return list_scenes(options);
}

}  // namespace

Command add_list(CLI::App& root) {
    auto* app = root.add_subcommand(
        "list", "list the algorithms, emulated devices (profiles) or built-in scenes, or show one of them");
    const auto options = std::make_shared<ListOptions>();
    const std::vector<Choice<ListKind>> choices{
        {"algorithms", ListKind::algorithms}, {"profiles", ListKind::profiles}, {"scenes", ListKind::scenes}};
    add_choice(
        *app, options->what, "WHAT", choices,
        "algorithms: paper, passes, ties, and which profiles run them; profiles: each number of one, and where it "
        "is from; scenes: their parameters")
        ->required()
        ->type_name("");
    app->add_option("NAME", options->name, "show only the entry of this name; a profile may be a JSON file")
        ->type_name("");
    app->add_flag("--json", options->json,
                  "one JSON document instead of the table; of one profile, what --profile FILE.json takes");
    app->footer(
        footer("  strata list algorithms\n  strata list profiles geforce3\n  strata list scenes teapot --json\n"));
    return {app, [options] { return list(*options); }};
}

}  // namespace strata::tools
