// tools/strata/info.cpp - strata info: prints the metadata of a picture, first the command that rendered it, and its
// digests.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/formats/value_digest.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/files/picture_attributes.h"
#include "scenes/printable.h"
#include "tools/oracle/picture/picture.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// One row and one JSON object per target, in the order of the files.
struct FileDigests {
    nlohmann::ordered_json document;
    Table table;
    bool all_read = true;  // false: some files could not be read, with the reasons on standard error
};

using nlohmann::ordered_json;

using Digests = std::vector<scenes::FileDigest>;

// The digest of a target that scenes/reference/images.md 5 does not define, or of one channel: a hash over name, size
// and codes.
std::string digest_of(const oracle::TargetImage& target, int first, int count, const std::string& name) {
    pipeline::ValueDigest digest{name};
    digest.add(static_cast<std::uint32_t>(target.width));
    digest.add(static_cast<std::uint32_t>(target.height));
    for (std::size_t pixel = 0; pixel < target.pixels(); ++pixel)
        for (int c = first; c < first + count; ++c) digest.add(target.at(pixel, c).word);
    return digest.hexadecimal();
}

std::string format_of(const oracle::TargetImage& target) {
    const std::string channels[] = {"r", "rg", "rgb", "rgba"};
    return channels[std::clamp(target.channels, 1, 4) - 1] + "/" + std::string(oracle::name(target.code));
}

// One digest per channel.
Digests channels_of(const std::string& file) {
    Digests digests;
    for (const oracle::TargetImage& target : oracle::read_picture(file).targets)
        for (int c = 0; c < target.channels; ++c) {
            const std::string channel = target.channels > 1 ? std::string(1, "RGBA"[c & 3]) : target.name;
            const std::string format = channel + "/" + std::string(oracle::name(target.code));
            digests.push_back({target.part, target.name + "." + channel, format, target.width, target.height,
                               digest_of(target, c, 1, format)});
        }
    return digests;
}

// True if the PNG header gives 8 bits per channel and colours (PNG 11.2.2: bit 1 of the colour type). False for any
// other file.
bool has_8_bit_colors(const std::string& file) {
    std::array<char, 26> header{};
    std::ifstream{file, std::ios::binary}.read(header.data(), header.size());
    return header[24] == 8 && (header[25] & 2) != 0;
}

// The digests of a file's targets. A PNG of grey or with 16 bits per channel is not a format of this program's targets,
// so its codes are hashed as they are.
Digests digests_of(const std::string& file) {
    if (scenes::image_file(file) == scenes::ImageFile::png && !has_8_bit_colors(file)) {
        const oracle::TargetImage target = oracle::read_picture(file).targets.at(0);
        if (target.channels < 3 || target.code != oracle::Code::unorm8)
            return {{"", "color", format_of(target), target.width, target.height,
                     digest_of(target, 0, target.channels, format_of(target))}};
    }
    return scenes::digests_of(file);
}

// Empty for a file that cannot be read; the reason is then printed on standard error.
std::optional<Digests> digests_or_reason(const std::string& file, bool channels) {
    try {
        return channels ? channels_of(file) : digests_of(file);
    } catch (const InputError& error) {
        say_error(error.what());
        return std::nullopt;
    }
}

// `channels`: one digest per channel instead of one per target.
FileDigests digests_of_files(const std::vector<std::string>& files, bool channels) {
    FileDigests found{.document = ordered_json::array(),
                      .table = {{{"digest"}, {"target"}, {"part"}, {"format"}, {"size"}, {"file"}}, {}}};
    bool all_read = true;
    for (const std::string& file : files) {
        const auto digests = digests_or_reason(file, channels);
        all_read &= digests.has_value();
        for (const auto& [part, target, format, width, height, value] : digests.value_or(Digests{})) {
            found.document.push_back({{"file", file},
                                      {"part", part},
                                      {"target", target},
                                      {"format", format},
                                      {"width", width},
                                      {"height", height},
                                      {"digest", value}});
            found.table.rows.push_back({value, target, part.empty() ? "-" : part, format,
                                        std::to_string(width) + "x" + std::to_string(height), file});
        }
    }
    found.all_read = all_read;
    return found;
}

// The options of the command line.
struct InfoOptions {
    std::vector<std::string> files;
    std::string expected;  // the digest that the file must have; empty: any
    bool json = false, digests = false, channels = false;
};

std::optional<std::string> to_digest(std::string_view text) {
    const bool is_digest = text.size() == 32 && std::all_of(text.begin(), text.end(), [](char c) {
                               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
                           });
    return is_digest ? std::optional(std::string(text)) : std::nullopt;
}

// The command that rendered the picture, and all other attributes that fit on one line. Pictures of other programs have
// no command.
std::string said_by(const std::string& file) {
    const scenes::Attributes attributes = scenes::read_attributes(file);
    const auto command = attributes.find("command");
    if (command == attributes.end()) return "no command of strata in it\n";
    std::string text = scenes::printable(command->second) + "\n";
    for (const auto& [key, value] : attributes)
        if (key != "command" && value.size() <= 64)
            text += fmt::format("{}: {}\n", scenes::printable(key), scenes::printable(value));
    return text;
}

// The text of all files that have digests. For any other file the reason has already been printed.
std::string text_of(const InfoOptions& options, const FileDigests& digests) {
    std::string text;
    for (const std::string& file : options.files) {
        if (std::ranges::none_of(digests.table.rows, [&](const auto& row) { return row.back() == file; })) continue;
        text += (options.files.size() > 1 ? scenes::printable(file) + ":\n" : "") + said_by(file);
    }
    return text;
}

nlohmann::ordered_json document_of(const InfoOptions& options, const FileDigests& digests) {
    nlohmann::ordered_json document = nlohmann::ordered_json::array();
    for (const std::string& file : options.files) {
        nlohmann::ordered_json targets = nlohmann::ordered_json::array();
        for (const auto& target : digests.document)
            if (target["file"] == file) targets.push_back(target);
        if (targets.empty()) continue;
        document.push_back({{"file", file}, {"attributes", scenes::read_attributes(file)}, {"targets", targets}});
    }
    return document;
}

int info(const InfoOptions& options) {
    const FileDigests digests = digests_of_files(options.files, options.channels);
    if (options.json) {
        const nlohmann::ordered_json document = options.digests ? digests.document : document_of(options, digests);
        print(document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
    } else if (!digests.table.rows.empty()) {
        print((options.digests ? "" : text_of(options, digests)) + titled(to_text(digests.table)));
    }
    if (!digests.all_read) return 2;
    const auto is_expected = [&](const auto& row) { return row.front() == options.expected; };
    if (options.expected.empty() || std::ranges::any_of(digests.table.rows, is_expected)) return 0;
    say_error("--expect: no target has the digest " + options.expected);
    return 1;
}

}  // namespace

Command add_info(CLI::App& root) {
    auto* app =
        root.add_subcommand("info", "show which command made a picture, and its digests: equal strings, equal bits");
    const auto options = std::make_shared<InfoOptions>();
    app->add_option("FILE", options->files, ".exr and .png files; render --from FILE runs its command again")
        ->required()
        ->type_name("...");
    app->add_flag("--digests", options->digests, "the digests alone, also of pictures that other programs made");
    app->add_flag("--channels", options->channels, "a digest a channel instead of one a target");
    add_option(*app, options->expected,
               {"--expect", "DIGEST", "exit status 1 unless a target has this digest", "32 hexadecimal digits"},
               to_digest);
    app->add_flag("--json", options->json, "one JSON document with all that it says: camera and profile, too");
    app->footer(footer(
        "  strata render teapot --size 64x64 -o teapot.png && strata info teapot.png\n"
        "  strata render teapot --size 64x64 -o teapot.exr && strata info --digests --channels teapot.exr\n"
        "  strata render teapot --size 64x64 -o a.png && strata render --from a.png -o b.png && cmp a.png b.png\n"));
    return {app, [options] { return info(*options); }};
}

}  // namespace strata::tools
