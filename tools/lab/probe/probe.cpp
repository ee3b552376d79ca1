// tools/lab/probe/probe.cpp - strata probe: writes the kit that measures a device, and the answers that a profile gives
// to it.
#include <fmt/format.h>

#include <memory>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/profile_json.h"
#include "scenes/packs/new_folder.h"
#include "tools/lab/commands.h"
#include "tools/lab/probe/items.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/search/comparison.h"
#include "tools/request/choices.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// The command line.
struct ProbeOptions {
    std::string output, profile, compare;
    std::optional<probe::YDirection> orientation{};  // if absent: the profile's
    int unseen = 0;
    bool json = false;
};

std::vector<std::string> row(const std::string& name, const probe::Difference& d) {
    return {name, std::to_string(d.pixels), std::to_string(d.coverage), std::to_string(d.depth),
            std::to_string(d.color)};
}

// Compares items drawn by a device with those drawn by the profile.
int compare(const ProbeOptions& options, const std::vector<probe::Item>& items) {
    const pipeline::DeviceProfile given = scenes::load_profile(options.profile);
    const probe::YDirection y = options.orientation.value_or(probe::direction_of(given.origin));
    const pipeline::DeviceProfile profile = with_origin(given, probe::origin_of(y));
    const probe::ProbePack pack = probe::read_pack(options.compare, items);
    const probe::KitComparison device{pack, items, y};
    if (device.count() == 0)
        throw InputError(options.compare, "probe/" + std::string{probe::name(y)},
                         "answers of that orientation (--y names another)", "none");
    Table table{{{"scene"},
                 {"pixels", Align::right},
                 {"coverage", Align::right},
                 {"depth", Align::right},
                 {"color", Align::right}},
                {}};
    nlohmann::ordered_json document{{"profile", profile.name}, {"made_by", pack.made_by}, {"scenes", {}}};
    probe::Difference sum;
    for (std::size_t i = 0; i < device.count(); ++i) {
        const probe::Reply drawn = device.drawn(profile, i);
        if (!drawn.answer)
            throw InputError(options.profile, device.item(i).name, "a device that can draw it", drawn.refusal);
        const probe::Difference one = difference(device.answer(i), *drawn.answer);
        sum += one;
        table.rows.push_back(row(device.item(i).name, one));
        document["scenes"].push_back({{"name", device.item(i).name},
                                      {"pixels", one.pixels},
                                      {"coverage_differ", one.coverage},
                                      {"depth_differ", one.depth},
                                      {"color_differ", one.color}});
    }
    table.rows.push_back(row("all", sum));
    print(options.json ? document.dump(1) + "\n" : titled(to_text(table)));
    return sum.is_none() ? 0 : 1;
}

void write_kit(const std::vector<probe::Item>& items, const std::string& folder) {
    scenes::NewFolder place{folder};
    place.write("kit.json", probe::to_json(items));
    place.write("probe.html", probe::page_of(items));
    place.keep();
}

int run(const ProbeOptions& options) {
    const std::vector<probe::Item> items = items_of(options.unseen);
    if (!options.compare.empty()) {
        if (options.profile.empty()) throw CLI::ValidationError("--compare needs --profile, too");
        return compare(options, items);
    }
    if (options.output.empty()) throw CLI::ValidationError("-o is missing: the folder for the kit or the answers");
    scenes::check_new_folder(options.output);
    if (options.profile.empty()) {
        write_kit(items, options.output);
        if (!is_quiet())
            print(fmt::format(
                "{0}: kit.json and probe.html, {1} scenes. Open probe.html on the device, or draw kit.json there;\n"
                "strata infer ANSWERS finds the profile of what comes back\n",
                options.output, items.size()));
    } else {
        const pipeline::DeviceProfile profile = scenes::load_profile(options.profile);
        const auto& both = enum_values<probe::YDirection>;
        const probe::ProbePack pack = answer(profile, items, {both.begin(), both.end()});
        write_pack(pack, items, options.output);
        if (!is_quiet())
            print(fmt::format("{}: the answers of {} to {} scenes\n", options.output, profile.name, items.size()));
    }
    return 0;
}

}  // namespace

Command add_probe(CLI::App& root) {
    auto* app = add_lab_command(root, "probe");
    const auto options = std::make_shared<ProbeOptions>();
    add_path(*app, options->output,
             {"-o,--output", "FOLDER", "the kit; with --profile the answers, a candidate pack", "a folder's name"});
    add_path(*app, options->profile, {"--profile", "NAME|FILE", "the device that answers", "a profile"});
    add_path(*app, options->compare,
             {"--compare", "PACK", "hold the profile's answers against a device's", "a folder or a tar archive"});
    add_orientation(*app, options->orientation, "which answers --compare looks at (default: as the profile's origin)");
    add_unseen(*app, options->unseen);
    app->add_flag("--json", options->json, "--compare prints one JSON object");
    app->footer(
        "Examples:\n"
        "  strata probe -o kit\n"
        "  strata probe --profile llvmpipe --unseen 2 -o answers && strata probe --profile llvmpipe --unseen 2 "
        "--compare "
        "answers\n"
        "Exit status: 0 done, 1 --compare found differences, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [options] { return run(*options); }};
}

}  // namespace strata::tools
