// scenes/files/image_formats.h - the readers and writers behind image_io, and their common ground.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scenes/exr/parts.h"
#include "scenes/files/image_io.h"
#include "scenes/files/load_module.h"

namespace strata::scenes {

// The value of a colour code: k / 255, or the half's or the float's own, whose NaN payload may be lost.
[[nodiscard]] float channel_value(pipeline::ChannelType type, std::uint32_t code) noexcept;

// Writes one file: `write` answers "", or what failed. SystemError, with the system's own reason where there is one.
void write_with(const std::string& path, const std::function<std::string(const ByteSink& sink)>& write);
void write_exr_parts(const std::string& path, std::span<const PartSource> parts);

// Keys with "strata:" before them.
[[nodiscard]] Attributes prefixed(const Attributes& attributes);

// The attribute "strata:KEY", "" if there is none.
[[nodiscard]] std::string attribute(const PartHeader& header, const std::string& key);

// The caller's attributes with format, digest and colour space of the targets.
[[nodiscard]] Attributes described(const OutputColor& image);

// "encoded" or "linear".
[[nodiscard]] std::string name_of(pipeline::ColorSpace space);
[[nodiscard]] StoredSpace stored_space(pipeline::ColorSpace space) noexcept;

// Where a pixel of a part keeps a channel, and as what.
struct ChannelPlace {
    std::size_t offset = 0;
    StoredType type = StoredType::single;
};
[[nodiscard]] std::optional<ChannelPlace> find_channel(const PartHeader& header, const std::string& name);

// Writers and readers of one format each; image_io.cpp chooses. The readers throw InputError, the writers
// SystemError.
void write_png(const std::string& path, const OutputColor& image);
void write_exr(const std::string& path, const OutputColor& image);
[[nodiscard]] std::vector<FileImage> read_png(const std::string& path);
[[nodiscard]] std::vector<FileImage> read_exr(const std::string& path);

// A flat part's targets; a deep part's fragments. `number` is the part's place in the file.
[[nodiscard]] std::vector<FileImage> as_images(const StoredPart& part, int number, const std::string& path);
[[nodiscard]] DeepFragments as_fragments(const StoredPart& part, const std::string& path);

}  // namespace strata::scenes
