// pipeline/region/region_targets.cpp - creates, clears, copies and reads a region's targets
// (pipeline/reference/execution.md 1.1).
#include "pipeline/region/region_targets.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "pipeline/device/check.h"
#include "pipeline/formats/convert.h"
#include "pipeline/formats/half.h"
#include "pipeline/formats/image_texels.h"
#include "pipeline/formats/packed.h"
#include "pipeline/formats/resolve.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

namespace {

// Reads consecutive pixels of the two most common layouts, whose words are nearly the image's codes; false for other
// layouts.
bool read_words(const Texels& from, std::size_t first, std::size_t count, std::uint32_t* out) {
    const std::uint32_t* const words = from.plane(0).words + first;
    const bool is_bytes = from.channels == 4 && from.bits_per_channel == 8;
    if (is_bytes)
        widen_words(words, count, out);
    else if (from.channels == 1 && from.bits_per_channel == 32)
        std::copy_n(words, count, out);
    else
        return false;
    return true;
}

// Bytes of all samples of all pixels, with the pixel sizes of formats.md 1, which counters use.
std::uint64_t bytes(const TargetStorage& s) {
    return s.pixels() * static_cast<std::uint64_t>(s.samples()) *
           static_cast<std::uint64_t>(info(s.format()).bytes_per_pixel);
}

// True if a channel in the word has an exponent of all ones.
bool holds_non_finite(Word word, ChannelType type) noexcept {
    constexpr Word single = 0x7f800000u, half = 0x7c00u;
    if (type == ChannelType::single) return (word & single) == single;
    return (word & half) == half || (word >> 16 & half) == half;
}

// True if one of the two halves in the word is the greatest, of either sign.
bool holds_half(Word word, Word greatest) noexcept {
    constexpr Word magnitude = 0x7fffu;
    return (word & magnitude) == greatest || (word >> 16 & magnitude) == greatest;
}

struct FoundPixels {
    std::uint64_t elements = 0;
    std::uint32_t first_pixel = ~0u;
};

FoundPixels pixels_where(const TargetStorage& storage, const RegionShared& shared, const auto& holds) {
    FoundPixels found;
    for (std::uint32_t element = 0; element < storage.pixels(); ++element) {
        bool is_found = false;
        for (int sample = 0; sample < storage.samples(); ++sample) {
            const Texels texels = storage.texels(sample);
            for (std::size_t word = 0; word < texels.words(); ++word)
                is_found |= holds(texels.plane(word).words[element], word);
        }
        if (!is_found) continue;
        ++found.elements;
        found.first_pixel = std::min(found.first_pixel, shared.pixel_of(element));
    }
    return found;
}

}  // namespace

// The opaque targets have indices 0 and 1 in every region. Priming them is the emulator's own work and is not counted.
Targets::Targets(const RegionShared& shared) : shared_{shared} {
    opaque_depth_ = make_depth();
    opaque_color_ = make(shared_.frame.behind_format());  // the background of layers that are blended from behind
    const UncountedWork priming{shared_.statistics};
    clear(opaque_depth_, {.depth = 1.0f});
    clear(opaque_color_, {.color = shared_.frame.background});
    opaque_depth_is_cleared_ = true;
}

void Targets::set_name(Target target, std::string_view name) const {
    if (const Alteration* a = shared_.instruments.alteration; a != nullptr && a->named) a->named(target, name);
    if (const Observer* o = shared_.instruments.observer; o != nullptr && o->named) o->named(target, name);
    if (shared_.frame.checks_targets) names_.emplace_back(target.id, name);
}

Target Targets::make_depth() { return make(target_format(shared_.frame.key_request().format)); }

Target Targets::make(Format format, int samples) {
    if (auto lacking = check_samples(shared_.profile(), samples)) throw Refused{shared_.profile(), *std::move(lacking)};
    storages_.emplace_back(format, samples, shared_.elements(), shared_.scratch.take_words());
    return {static_cast<int>(storages_.size()) - 1};
}

Target Targets::make_of_pixels(Format format) {
    storages_.emplace_back(format, 1, shared_.pixels(), shared_.scratch.take_words());
    return {static_cast<int>(storages_.size()) - 1};
}

std::size_t Targets::first_element(Target t, std::size_t sample) const {
    return at(t).pixels() == shared_.elements() ? sample * shared_.pixels() : 0;
}

void Targets::clear(Target given, const ClearValue& given_value, std::uint8_t sample_mask) {
    Target target = given;
    ClearValue value = given_value;
    if (const Alteration* a = shared_.alteration();
        a != nullptr && a->clear && !a->clear(shared_.region, target, value))
        return;
    note_written(target);
    TargetStorage& storage = at(target);
    const Format format = storage.format();
    if (is_color(format)) {
        for (int c = 0; c < info(format).channels; ++c)
            if (!std::isfinite(value.color[c])) cleared_non_finite_.push_back(target.id);
        storage.fill(color_codes(format, shared_.profile().color_rounding(), value.color), sample_mask);
    } else if (is_depth(format)) {
        // D32F is cleared unclamped on devices with NV_depth_buffer_float's unclamped clear, clamped elsewhere
        // (formats.md 5.5).
        const bool unclamped = format == Format::d32f && shared_.profile().has_unclamped_depth_clear;
        const std::uint32_t code = unclamped ? std::bit_cast<std::uint32_t>(value.depth)
                                             : rasterizer::to_depth_code(value.depth, depth_format(format),
                                                                         shared_.profile().raster.depth_rounding);
        storage.fill({code, 0, 0, 0}, sample_mask);
    }
    if (has_stencil(format)) storage.fill_stencil(value.stencil, sample_mask);
    shared_.count(of_clear(1, bytes(storage)));
    shared_.show({.step = Step::clear, .to = target, .clear = &value, .sample_mask = sample_mask});
}

// A bit copy of codes (formats.md 5.6): nothing is rounded, and -0 and NaN are kept.
void Targets::copy(Target given_from, Target given_to) {
    Target from = given_from, to = given_to;
    if (const Alteration* a = shared_.alteration(); a != nullptr && a->copy && !a->copy(shared_.region, from, to))
        return;
    assert(at(from).format() == at(to).format() && at(from).samples() == at(to).samples());
    at(to) = at(from);
    note_written(to);
    shared_.count(of_copy(1, bytes(at(from))));
    shared_.count_pass({.copies = 1});
    shared_.show({.step = Step::copy, .to = to, .from = from});
}

// Writes the part in this region; its source must also be in this region, because a tile cannot access its neighbours.
// Otherwise the frame is run again as a whole (execution.md 5.4).
void Targets::copy_rectangle(Target from, const rasterizer::Rect& from_rect, Target to, int dx, int dy) {
    const TargetStorage& source = at(from);
    TargetStorage& texture = at(to);
    assert(source.format() == texture.format() && source.samples() == 1 && texture.samples() == 1);
    note_written(to);
    const auto [x0, y0, x1, y1] = from_rect;
    const rasterizer::Rect written =
        rasterizer::intersection(shared_.rect(), rasterizer::Rect{x0 + dx, y0 + dy, x1 + dx, y1 + dy});
    if (intersection(rasterizer::Rect{written.x0 - dx, written.y0 - dy, written.x1 - dx, written.y1 - dy},
                     shared_.rect())
            .area() != written.area())
        throw NeedsFrame{};
    for (std::size_t sample = 0; sample < shared_.samples; ++sample)
        for (int y = written.y0; y < written.y1; ++y)
            copy_row(source, written, y, dx, dy, static_cast<std::uint32_t>(sample * shared_.pixels()), texture);
    shared_.count(
        of_copy(static_cast<std::uint64_t>(info(source.format()).bytes_per_pixel), written.area() * shared_.samples));
    shared_.count_pass({.copies = 1});
    shared_.show({.step = Step::copy, .to = to, .from = from});
}

// Copies row y of `written` in the sample whose first element is `first`. Overlapping copies within one target are not
// supported.
void Targets::copy_row(const TargetStorage& source, const rasterizer::Rect& written, int y, int dx, int dy,
                       std::uint32_t first, TargetStorage& texture) {
    const auto index = [&](int column, int row) {
        return first + static_cast<std::uint32_t>((row - shared_.rect().y0) * shared_.rect().width() + column -
                                                  shared_.rect().x0);
    };
    RegionScratch& s = shared_.scratch;
    for (int x = written.x0; x < written.x1; x += batch_capacity) {
        const int count = std::min(written.x1 - x, batch_capacity);
        Lanes<std::uint32_t>& pixel = s.screen.pixel;
        std::iota(pixel.begin(), pixel.begin() + count, index(x - dx, y - dy));
        source.gather(pixel, count, 0, s.codes);
        std::iota(pixel.begin(), pixel.begin() + count, index(x, y));
        std::fill_n(s.alive.begin(), count, ~0u);
        texture.scatter(pixel, s.alive, count, 0, 0xfu, s.codes);
    }
}

// `held` is the region in pixels of the frame's texture; a lookup outside it throws NeedsFrame.
DepthTexels Targets::depth_texels(Target depth, std::size_t sample) const {
    const rasterizer::Rect& frame = shared_.frame.rect();
    DepthTexels texels;
    texels.codes = at(depth).depth(0) + sample * shared_.pixels();
    texels.held = {shared_.rect().x0 - frame.x0, shared_.rect().y0 - frame.y0, shared_.rect().x1 - frame.x0,
                   shared_.rect().y1 - frame.y0};
    texels.width = frame.width();
    texels.height = frame.height();
    texels.format = depth_format(at(depth).format());
    texels.bottom_up = shared_.frame.transparent->geometry.state.y_direction == rasterizer::YDirection::up;
    return texels;
}

// Channels that the format lacks are 0, alpha 1, as for loads of a program.
Rgba Targets::color(Target target, std::uint32_t element, int own_sample) const {
    const TargetStorage& from = at(target);
    const FormatInfo format = info(from.format());
    Rgba color{0, 0, 0, 1};
    for (int c = 0; c < format.channels; ++c) {
        const std::uint32_t code = from.code(element, c, own_sample);
        color[static_cast<std::size_t>(c)] =
            is_packed(from.format()) ? packed_value(from.format(), c, code, shared_.profile().color_rounding())
            : format.type == ChannelType::unorm8 ? code_value(code, shared_.profile().unorm_rounding)
            : format.type == ChannelType::half
                ? half_value(static_cast<std::uint16_t>(code), shared_.profile().half_rounding)
                : std::bit_cast<float>(code);
    }
    return color;
}

Image Targets::image(Target target, std::size_t sample) const {
    const TargetStorage& from = at(target);
    Image image = Image::for_overwrite(from.format(), shared_.rect().width(), shared_.rect().height(), from.samples());
    for (int y = 0; y < shared_.rect().height(); ++y) read_row(target, y, &image.codes[image.index(0, y)], sample);
    finish_words();
    return image;
}

// Under reversed depth targets have keys, so the nearest depth always has the least code.
Image Targets::resolved(Target target) const {
    if (shared_.samples == 1) return image(target);
    const DeviceProfile& profile = shared_.profile();
    ColorResolve mean{static_cast<int>(shared_.samples), profile.resolve, profile.color_rounding()};
    Image nearest;
    const bool has_depths = is_depth(at(target).format());
    for (std::size_t sample = 0; sample < shared_.samples; ++sample)
        has_depths ? add_nearest(image(target, sample), nearest) : mean.add(image(target, sample));
    return has_depths ? nearest : std::move(mean).picture();
}

// One row of the region in Image order: pixels, their samples, their channels.
void Targets::read_row(Target target, int y, std::uint32_t* out, std::size_t of_sample) const {
    const TargetStorage& from = at(target);
    const auto width = static_cast<std::size_t>(shared_.rect().width()),
               first = first_element(target, of_sample) + static_cast<std::size_t>(y) * width;
    const auto channels = static_cast<std::size_t>(info(from.format()).channels);
    const auto samples = static_cast<std::size_t>(from.samples());
    if (samples == 1 && read_words(from.texels(0), first, width, out)) return;
    for (std::size_t x = 0; x < width; x += batch_capacity) {
        const std::size_t count = std::min<std::size_t>(width - x, batch_capacity);
        for (std::size_t sample = 0; sample < samples; ++sample) {
            ColorCodes& codes = shared_.scratch.codes;
            Lanes<std::uint32_t>& pixel = shared_.scratch.screen.pixel;
            for (std::size_t i = 0; i < count; ++i) pixel[i] = static_cast<std::uint32_t>(first + x + i);
            from.gather(pixel, static_cast<int>(count), static_cast<int>(sample), codes);
            if (samples * channels == 1)
                std::copy_n(codes[0].begin(), count, out + x);
            else if (samples == 1 && channels == 4)
                for (std::size_t i = 0; i < count; ++i)
                    for (std::size_t c = 0; c < 4; ++c) out[(x + i) * 4 + c] = codes[c][i];
            else
                for (std::size_t c = 0; c < channels; ++c)
                    for (std::size_t i = 0; i < count; ++i)
                        out[((x + i) * samples + sample) * channels + c] = codes[c][i];
        }
    }
}

bool Targets::has_ordered_surface() const {
    const TargetStorage& surface = at(opaque_depth_);
    const auto is_beyond = [format = depth_format(surface.format())](std::uint32_t code) {
        return rasterizer::is_beyond_range(code, format);
    };
    return !shared_.wraps_depths() || std::none_of(surface.depth(0), surface.depth(0) + shared_.elements(), is_beyond);
}

void Targets::require_equal(const std::vector<TargetStorage>& others) const {
    for (std::size_t t = 0; t < storages_.size(); ++t)
        for (int channel = 0; channel < std::max(1, info(storages_[t].format()).channels); ++channel)
            for (int sample = 0; sample < storages_[t].samples(); ++sample)
                for (std::size_t p = 0; p < storages_[t].pixels(); ++p)
                    if (storages_[t].code(p, channel, sample) != others[t].code(p, channel, sample))
                        throw std::logic_error(
                            "pass state: what a pass promises differs from its program in what it leaves in a target");
}

void Targets::report_overflow(Target published) const {
    const HalfRounding rounding = shared_.frame.profile->half_rounding;
    const Word greatest = stopping_half(rounding);
    for (int id = 0; id < count(); ++id) {
        const bool is_opaque = id == opaque_depth_.id || id == opaque_color_.id;
        if (shared_.frame.checks_targets ? is_opaque : id != published.id) continue;
        const TargetStorage& storage = storages_[static_cast<std::size_t>(id)];
        const ChannelType type = info(storage.format()).type;
        if (type != ChannelType::half && type != ChannelType::single) continue;
        if (std::ranges::find(cleared_non_finite_, id) != cleared_non_finite_.end()) continue;
        const auto named = std::ranges::find(names_, id, &std::pair<int, std::string>::first);
        const std::string name = named != names_.end() ? named->second
                                 : id == published.id  ? "result"
                                                       : std::to_string(id);
        const auto report = [&](Fault fault, const std::string& what, const auto& holds) {
            const FoundPixels found = pixels_where(storage, shared_, holds);
            shared_.report(fault, found.elements, found.first_pixel, "target " + name + what);
        };
        if (type == ChannelType::single || rounding != HalfRounding::no_infinity)
            report(Fault::non_finite_target, " holds infinity or NaN",
                   [&](Word word, std::size_t) { return holds_non_finite(word, type); });
        if (type == ChannelType::half && greatest != 0 && !is_packed(storage.format()))
            report(Fault::half_saturated, " holds the greatest half: its sums have stopped growing",
                   [&](Word word, std::size_t) { return holds_half(word, greatest); });
        if (is_packed(storage.format()) && type == ChannelType::half)
            report(Fault::half_saturated, " holds the greatest number of r11g11b10f: its sums have stopped growing",
                   [&](Word word, std::size_t place) { return holds_half(word, place == 0 ? 0x7bf0 : 0x7be0); });
    }
}

}  // namespace strata::pipeline
