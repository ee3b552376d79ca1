// scenes/files/image_formats.h - the readers and writers that image_io chooses from, and their shared functions.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scenes/exr/parts.h"
#include "scenes/files/image_io.h"
#include "scenes/files/load_module.h"

namespace strata::scenes {

// The value of a colour code: k / 255, k / 1023, or the value of the half or float, whose NaN payload may be lost.
[[nodiscard]] float channel_value(pipeline::ChannelType type, std::uint32_t code) noexcept;
// The value that is blended: linear for the colours of srgb8_alpha8, else channel_value.
[[nodiscard]] float blended_value(pipeline::Format format, int channel, std::uint32_t code) noexcept;

// Writes one file: `write` returns "", or an error message. Throws SystemError, with the system's reason if there is
// one.
void write_with(const std::string& path, const std::function<std::string(const ByteSink& sink)>& write);
void write_exr_parts(const std::string& path, std::span<const PartSource> parts);

// The attributes with the prefix "strata:".
[[nodiscard]] Attributes prefixed(const Attributes& attributes);

// The attribute "strata:KEY", or "".
[[nodiscard]] std::string attribute(const PartHeader& header, const std::string& key);

// The caller's attributes, with format, digest and colour space of the targets added.
[[nodiscard]] Attributes described(const OutputColor& image);

// "encoded" or "linear".
[[nodiscard]] std::string name_of(pipeline::ColorSpace space);
[[nodiscard]] StoredSpace stored_space(pipeline::ColorSpace space) noexcept;

// The offset and the type of a channel in a pixel of a part.
struct ChannelLayout {
    std::size_t offset = 0;
    StoredType type = StoredType::single;
};
[[nodiscard]] std::optional<ChannelLayout> find_channel(const PartHeader& header, const std::string& name);

// The writers and readers of the formats; image_io.cpp chooses. Readers throw InputError, writers SystemError.
void write_png(const std::string& path, const OutputColor& image);
void write_exr(const std::string& path, const OutputColor& image);
[[nodiscard]] std::vector<FileImage> read_png(const std::string& path);
[[nodiscard]] std::vector<FileImage> read_exr(const std::string& path);

// The targets of a flat part, or the fragments of a deep part. `number` is the part's index in the file.
[[nodiscard]] std::vector<FileImage> as_images(const StoredPart& part, int number, const std::string& path);
[[nodiscard]] DeepFragments as_fragments(const StoredPart& part, const std::string& path);

}  // namespace strata::scenes
