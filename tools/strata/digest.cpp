// tools/strata/digest.cpp - strata digest: one string a target, equal exactly if the bits are.
#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/formats/word_digest.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "tools/oracle/picture.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

// The command line.
struct DigestOptions {
    std::vector<std::string> files;
    std::string expected;
    bool json = false, channels = false;
};

using Digests = std::vector<scenes::FileDigest>;

// Of codes that no target of ours has, or of one channel: the hash over a name, the size and the codes (scenes/README.md, "Digests").
std::string digest_of(const oracle::Target& target, int first, int count, const std::string& name) {
    pipeline::WordDigest digest{name};
    digest.add(static_cast<std::uint32_t>(target.width));
    digest.add(static_cast<std::uint32_t>(target.height));
    for (std::size_t pixel = 0; pixel < target.pixels(); ++pixel)
        for (int c = first; c < first + count; ++c) digest.add(target.at(pixel, c).word);
    return digest.hexadecimal();
}

std::string format_of(const oracle::Target& target) {
    const std::string channels[] = {"r", "rg", "rgb", "rgba"};
    return channels[std::clamp(target.channels, 1, 4) - 1] + "/" + std::string(oracle::name(target.code));
}

// A digest a channel.
Digests channels_of(const std::string& file) {
    Digests digests;
    for (const oracle::Target& target : oracle::read_picture(file).targets)
        for (int c = 0; c < target.channels; ++c) {
            const std::string channel = target.channels > 1 ? std::string(1, "RGBA"[c & 3]) : target.name;
            const std::string format = channel + "/" + std::string(oracle::name(target.code));
            digests.push_back({target.part, target.name + "." + channel, format, target.width, target.height,
                               digest_of(target, c, 1, format)});
        }
    return digests;
}

// Whether a PNG's header says 8 bits a channel and colours (PNG 11.2.2: of the colour type bit 1). Anything else says no.
bool has_8_bit_colors(const std::string& file) {
    std::array<char, 26> header{};
    std::ifstream{file, std::ios::binary}.read(header.data(), header.size());
    return header[24] == 8 && (header[25] & 2) != 0;
}

// A PNG of grey, or of 16 bits a channel, is no target of ours: its own codes are hashed.
Digests digests_of(const std::string& file) {
    if (scenes::image_file(file) == scenes::ImageFile::png && !has_8_bit_colors(file)) {
        const oracle::Target target = oracle::read_picture(file).targets.at(0);
        if (target.channels < 3 || target.code != oracle::Code::unorm8)
            return {{"", "color", format_of(target), target.width, target.height,
                     digest_of(target, 0, target.channels, format_of(target))}};
    }
    return scenes::digests_of(file);
}

// Nothing for a file that cannot be read; standard error then has the reason.
std::optional<Digests> digests_or_reason(const std::string& file, bool channels) {
    try {
        return channels ? channels_of(file) : digests_of(file);
    } catch (const InputError& error) {
        say_error(error.what());
        return std::nullopt;
    }
}

std::optional<std::string> to_digest(std::string_view text) {
    const bool is_digest = text.size() == 32 && std::all_of(text.begin(), text.end(), [](char c) {
                               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
                           });
    return is_digest ? std::optional(std::string(text)) : std::nullopt;
}

int digest(const DigestOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"digest"}, {"target"}, {"part"}, {"format"}, {"size"}, {"file"}}, {}};
    bool all_read = true, is_found = false;
    for (const std::string& file : options.files) {
        const auto digests = digests_or_reason(file, options.channels);
        all_read &= digests.has_value();
        for (const auto& [part, target, format, width, height, value] : digests.value_or(Digests{})) {
            is_found |= value == options.expected;
            document.push_back({{"file", file},
                                {"part", part},
                                {"target", target},
                                {"format", format},
                                {"width", width},
                                {"height", height},
                                {"digest", value}});
            table.rows.push_back({value, target, part.empty() ? "-" : part, format,
                                  std::to_string(width) + "x" + std::to_string(height), file});
        }
    }
    if (options.json) print(document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n');
    if (!options.json && !table.rows.empty()) print(titled(to_text(table)));
    if (!all_read) return 2;
    if (options.expected.empty() || is_found) return 0;
    say_error("--expect: expected " + options.expected + ", found no such digest");
    return 1;
}

}  // namespace

Command add_digest(CLI::App& root) {
    auto* app = root.add_subcommand("digest", "print the digests of images: equal strings, equal bits");
    const auto options = std::make_shared<DigestOptions>();
    app->add_option("FILE", options->files, ".exr and .png files")->required()->type_name("");
    app->add_flag("--json", options->json, "one JSON document instead of the table");
    app->add_flag("--channels", options->channels, "a digest a channel instead of one a target");
    add_option(*app, options->expected,
               {"--expect", "DIGEST", "exit status 1 unless a file has this digest", "32 hexadecimal digits"},
               to_digest);
    app->footer(
        footer("  strata render teapot --size 64x64 -o teapot.exr && strata digest teapot.exr\n"
               "  strata render teapot --size 64x64 -o teapot.png && strata digest --json teapot.png\n"
               "  strata render teapot --size 64x64 -o teapot.png && strata digest --channels teapot.png\n"));
    return {app, [options] { return digest(*options); }};
}

}  // namespace strata::tools
