// tools/strata/options/options.cpp - declares the options of scene, view, algorithm and sampling, and completes what
// the user left out (options.h).
#include "tools/strata/options/options.h"

#include <algorithm>

#include "peeling/registry.h"
#include "scenes/files/atomic_file.h"
#include "tools/request/choices.h"
#include "tools/request/complete.h"
#include "tools/request/names.h"
#include "tools/request/option_fields.h"
#include "tools/request/parse.h"
#include "tools/strata/options/option_readers.h"
#include "tools/strata/options/pack_options.h"

namespace strata::tools {

namespace {

// The algorithms of a list of names, in the order of the list, without repetition; `all` means every algorithm of the
// registry. Throws CLI::ValidationError for an unknown name.
std::vector<const peeling::Algorithm*> to_algorithms(const std::string& text) {
    std::vector<const peeling::Algorithm*> chosen;
    const auto add = [&](const peeling::Algorithm& algorithm) {
        if (std::find(chosen.begin(), chosen.end(), &algorithm) == chosen.end()) chosen.push_back(&algorithm);
    };
    for (const std::string& name : split(text, ',')) {
        if (name == "all") {
            for (const peeling::Algorithm& algorithm : peeling::algorithms()) add(algorithm);
            continue;
        }
        const peeling::Algorithm* algorithm = peeling::find_algorithm(name);
        if (algorithm == nullptr) {
            auto names = algorithm_names();
            names.emplace_back("all");
            throw CLI::ValidationError(
                "--algorithm", "expected names of algorithms (strata list algorithms shows them) or all, found " +
                                   found_but_near(name, names));
        }
        add(*algorithm);
    }
    return chosen;
}

void add_algorithm_option(CLI::App& app, RunOptions& options) {
    app.add_option_function<std::string>(
           "--algorithm", [&options](const std::string& text) { options.algorithms = to_algorithms(text); },
           (options.takes_one_algorithm ? "an algorithm (default "
                                        : "algorithms with commas between, or all (default ") +
               options.default_algorithm + ")")
        ->type_name(options.takes_one_algorithm ? "NAME" : "NAME[,NAME...]|all");
}

CLI::Option* add_field(CLI::App& app, PictureRequest& request, const OptionField& field) {
    if (field.is_flag) {
        const std::string value = field.is_on_by_default() ? "false" : "true";
        return app.add_flag_callback(
            field.option(), [&request, &field, value] { field.set(request, value); }, field.help);
    }
    const auto fill = [&request, &field](const std::string& given) {
        if (!field.set(request, given)) throw CLI::ValidationError(field.option(), expectation(field, given));
    };
    return app.add_option_function<std::string>(field.option(), fill, field.help)->type_name(field.type);
}

void add_scene(CLI::App& app, const std::function<void(const std::string&)>& take) {
    app.add_option_function<std::string>("SCENE", take,
                                         "a .gltf, .glb, .obj, .ply, .stl or .off file, - for a glTF file from "
                                         "standard input, a pack, or a built-in scene (strata list scenes)")
        ->required()
        ->type_name("");
}

}  // namespace

std::vector<std::string> algorithm_names() {
    std::vector<std::string> names;
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) names.push_back(algorithm.name);
    return names;
}

void add_options(CLI::App& app, PictureRequest& request, OptionGroup group) {
    for (const OptionField& field : option_fields())
        if (field.group == group) add_field(app, request, field);
}

CLI::Option* add_option_of_table(CLI::App& app, PictureRequest& request, std::string_view name) {
    return add_field(app, request, *find_option(name));
}

void add_scene_options(CLI::App& app, std::string& scene, PictureRequest& request) {
    add_scene(app, [&scene](const std::string& given) { scene = given; });
    add_options(app, request, OptionGroup::reading);
}

void add_profile_option(CLI::App& app, std::string& profile) {
    add_path(app, profile,
             {"--profile", "NAME|FILE", "a built-in profile, or a JSON file with one (default geforce8)",
              "a profile's name or file"});
}

void take_scene(RunOptions& options, const std::string& scene) {
    options.scene = scene;
    take_pack_state(options, scene);
}

const peeling::Algorithm* to_algorithm(const std::string& name) {
    const auto chosen = to_algorithms(name);
    if (chosen.size() != 1)
        throw CLI::ValidationError("--algorithm",
                                   "expected one algorithm, found " + std::to_string(chosen.size()) + " of them");
    return chosen[0];
}

void add_picture_options(CLI::App& app, RunOptions& options) {
    // Options take effect in the order in which they are added: SCENE is first, so that other options override the
    // state of a pack.
    options.app = &app;
    add_scene(app, [&options](const std::string& scene) { take_scene(options, scene); });
    using enum OptionGroup;
    add_options(app, options, reading);
    add_algorithm_option(app, options);
    add_profile_option(app, options.profile);
    for (const OptionGroup group : {origin, depth, targets, algorithm, samples, shading, order, view})
        add_options(app, options, group);
    if (options.takes_size_of_picture) app.get_option("--size")->description(help_of_picture_size);
}

void complete(RunOptions& options) {
    const bool is_piped = scenes::is_standard_output(options.output);
    if (options.format && !is_piped)
        throw CLI::ValidationError(
            "--format is valid only with -o -" +
            (options.output.empty() ? "" : "; the name '" + options.output + "' determines the format"));
    if (is_piped && scenes::is_standard_output(options.stats))
        throw CLI::ValidationError("with -o -, --stats must name a file");
    if (options.algorithms.empty()) options.algorithms = to_algorithms(options.default_algorithm);
    if (options.app != nullptr) refuse_unread(*options.app, options.algorithms, options);
    if (const auto found = option_conflict(options)) {
        if (found->option.empty()) throw CLI::ValidationError(found->sentence);
        throw CLI::ValidationError(found->option, found->sentence);
    }
    if (const auto found = light_conflict(options.render, options.scene_options.color_space))
        throw CLI::ValidationError("--color-space", *found);
    // A pack has its own background, so black counts, too, if it replaces that.
    if (options.background == pipeline::Rgba{0, 0, 0, 1} && !scenes::is_pack(options.scene)) options.background.reset();
    if (is_piped && options.algorithms.size() > 1)
        throw CLI::ValidationError("-o", "standard output takes one picture, not those of " +
                                             std::to_string(options.algorithms.size()) +
                                             " algorithms; name a file instead");
}

}  // namespace strata::tools
