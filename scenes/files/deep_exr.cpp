// scenes/files/deep_exr.cpp - a layered depth image: every fragment of every pixel in one deep EXR file.
//
// Rule     Channels R G B A (FLOAT, premultiplied), Z (FLOAT), Zbits and id (UINT32: depth code and primitive). Samples
//          are in the order of `fragments`, which need not be sorted by Z.
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <memory>
#include <numeric>

#include "pipeline/formats/value_digest.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_formats.h"

namespace strata::scenes {
namespace {

constexpr std::size_t words_per_fragment = 7;
constexpr std::array<const char*, words_per_fragment> names{"R", "G", "B", "A", "Z", "Zbits", "id"};
constexpr std::size_t first_integer = 5;  // the words before it are FLOAT

using Words = std::array<std::uint32_t, words_per_fragment>;

PartHeader header_of(const DeepFragments& fragments, const Attributes& attributes) {
    PartHeader header{.width = fragments.width, .height = fragments.height, .is_deep = true};
    for (std::size_t i = 0; i < words_per_fragment; ++i)
        header.channels.push_back({names[i], i < first_integer ? StoredType::single : StoredType::word});
    header.attributes = prefixed(attributes);
    header.space = stored_space(fragments.space);
    header.attributes["strata:colour"] = name_of(fragments.space);
    header.attributes["strata:digest.fragments"] = digest(fragments);
    return header;
}

// A fragment as stored in the file: premultiplied. Each float is stored as its bits: a NaN keeps its payload.
Words words_of(const DeepFragments& fragments, std::size_t i) noexcept {
    const pipeline::Rgba& c = fragments.rgba[i];
    const float scale = fragments.premultiplied ? 1.0f : c[3];
    return {std::bit_cast<std::uint32_t>(c[0] * scale),
            std::bit_cast<std::uint32_t>(c[1] * scale),
            std::bit_cast<std::uint32_t>(c[2] * scale),
            std::bit_cast<std::uint32_t>(c[3]),
            std::bit_cast<std::uint32_t>(fragments.z[i]),
            fragments.depth_code[i],
            fragments.primitive[i]};
}

// The inverse of words_of() for a premultiplied colour.
void append(const Words& words, DeepFragments& fragments) {
    pipeline::Rgba color{};
    for (std::size_t c = 0; c < 4; ++c) color[c] = std::bit_cast<float>(words[c]);
    fragments.rgba.push_back(color);
    fragments.z.push_back(std::bit_cast<float>(words[4]));
    fragments.depth_code.push_back(words[5]);
    fragments.primitive.push_back(words[6]);
}

// Provides the fragments row by row, from the top.
class FragmentRows {
  public:
    explicit FragmentRows(const DeepFragments& fragments) : fragments_{fragments} {}

    [[nodiscard]] const std::byte* encode(int first, int last) {
        const auto width = static_cast<std::size_t>(fragments_.width);
        // first and last are rows, count is per pixel. The writer requests the rows once and in order, which `next_`
        // relies on.
        const auto begin = fragments_.count.begin() + static_cast<std::ptrdiff_t>(first * width);
        const auto end = fragments_.count.begin() + static_cast<std::ptrdiff_t>(last * width);
        words_.clear();
        for (std::size_t left = std::accumulate(begin, end, std::size_t{0}); left > 0; --left)
            words_.push_back(words_of(fragments_, next_++));
        return std::as_bytes(std::span{words_}).data();
    }

  private:
    const DeepFragments& fragments_;
    std::size_t next_ = 0;
    std::vector<Words> words_;
};

// The offset of each word of Words in a fragment of the file.
std::array<std::size_t, words_per_fragment> offsets_in(const PartHeader& header, const std::string& path) {
    std::array<std::size_t, words_per_fragment> offsets{};
    for (std::size_t i = 0; i < words_per_fragment; ++i) {
        const auto channel = find_channel(header, names[i]);
        const StoredType type = i < first_integer ? StoredType::single : StoredType::word;
        // A deep file of another program has other channels and is rejected.
        if (!channel || channel->type != type)
            throw InputError(path, "part 0", std::string{"the channel "} + names[i] + " in the type that strata writes",
                             "no such channel");
        offsets[i] = channel->offset;
    }
    return offsets;
}

}  // namespace

std::string digest(const DeepFragments& fragments) {
    const FloatEnvironment environment;
    pipeline::ValueDigest hash{"deep"};
    hash.add(static_cast<std::uint32_t>(fragments.width));
    hash.add(static_cast<std::uint32_t>(fragments.height));
    for (const std::uint32_t count : fragments.count) hash.add(count);
    for (std::size_t i = 0; i < fragments.z.size(); ++i)
        for (const std::uint32_t word : words_of(fragments, i)) hash.add(word);
    return hash.hexadecimal();
}

void write_deep(const std::string& path, std::span<const DeepFragments> samples, const Attributes& attributes) {
    const FloatEnvironment environment;
    if (image_file(path) != ImageFile::exr)
        throw InputError(path, "name", "a file name that ends in .exr", "another ending");
    std::vector<PartSource> parts;
    for (std::size_t sample = 0; sample < samples.size(); ++sample) {
        const DeepFragments& fragments = samples[sample];
        // The counts must add up to the length of the lists, or rows would exceed them.
        assert(std::accumulate(fragments.count.begin(), fragments.count.end(), std::size_t{0}) == fragments.z.size());
        const auto rows = std::make_shared<FragmentRows>(fragments);
        parts.push_back({.header = header_of(fragments, attributes),
                         .rows = [rows](int first, int last) { return rows->encode(first, last); },
                         .samples = fragments.count});
        if (samples.size() > 1) parts.back().header.name = "sample." + std::to_string(sample);
    }
    write_exr_parts(path, parts);
}

DeepFragments as_fragments(const StoredPart& part, const std::string& path) {
    if (!part.header.is_deep || !part.is_whole)
        throw InputError(path, "part 0", "a deep image",
                         part.is_whole ? "a flat image" : "a truncated or damaged image");
    const auto offsets = offsets_in(part.header, path);
    DeepFragments fragments{.width = part.header.width, .height = part.header.height, .premultiplied = true};
    if (attribute(part.header, "colour") == name_of(pipeline::ColorSpace::linear))
        fragments.space = pipeline::ColorSpace::linear;
    fragments.count = part.samples;
    const std::size_t stride = pixel_bytes(part.header);
    // One fragment per iteration; its seven words may be in any order in the file.
    for (std::size_t at = 0; at < part.bytes.size(); at += stride) {
        Words words{};
        for (std::size_t i = 0; i < words_per_fragment; ++i)
            std::memcpy(&words[i], &part.bytes[at + offsets[i]], sizeof words[i]);
        append(words, fragments);
    }
    return fragments;
}

std::vector<DeepFragments> read_deep_samples(const std::string& path) {
    const FloatEnvironment environment;
    std::vector<DeepFragments> samples;
    exr::read_parts(path, [&](StoredPart&& part) { samples.push_back(as_fragments(part, path)); });
    return samples;  // read_parts() reads at least one part or throws
}

DeepFragments read_deep(const std::string& path) { return read_deep_samples(path).front(); }

}  // namespace strata::scenes
