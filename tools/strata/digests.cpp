#include "tools/strata/digests.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/formats/value_digest.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "tools/oracle/picture/picture.h"
#include "tools/strata/messages.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

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

}  // namespace

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

}  // namespace strata::tools
