// pipeline/region/region.cpp - a region's targets: made, cleared, copied, read; and the opaque scene that is there
// before the body starts (execution.md 1.1). Passes stand in region_stages.cpp, queries in region_control.cpp.
#include "pipeline/region/region.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

#include "pipeline/device/check.h"
#include "pipeline/formats/convert.h"
#include "pipeline/formats/half.h"
#include "pipeline/formats/image_words.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/fragments/tile_cache.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

namespace {

// Neighbouring pixels of the two commonest layouts, whose words are nearly the image's codes; false for the others.
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

// All samples of all pixels, in the sizes of formats.md 1: those that counters are told in.
std::uint64_t bytes(const TargetStorage& s) {
    return s.pixels() * static_cast<std::uint64_t>(s.samples()) *
           static_cast<std::uint64_t>(info(s.format()).bytes_per_pixel);
}

}  // namespace

Region::Region(const Frame& frame, const RegionPlace& place, RegionBooks& books, const Instruments& instruments,
               RegionScratchPool* pool)
    : frame_{frame},
      rect_{place.rect},
      tile_{place.tile},
      extent_{place.extent},
      books_{books},
      instruments_{instruments},
      pool_{pool},
      scratch_{pool == nullptr ? std::make_unique<RegionScratch>() : pool->take()},
      rasterizer_{std::make_unique<rasterizer::TileRasterizer>(place.rect)} {
    scratch_->trace.start(frame.trace_bytes);
    // The opaque targets are numbers 0 and 1 in every region. Priming them is the emulator's own work and counted
    // nowhere.
    opaque_depth_ = make_depth();
    opaque_color_ = make_color();
    const UncountedWork priming{books_};
    clear(opaque_depth_, {.depth = 1.0f});
    clear(opaque_color_, {.color = frame.background});
    opaque_depth_is_cleared_ =
        frame.opaque == nullptr || (extent_ == Extent::tile && frame.opaque->geometry.bin(tile_).empty());
    if (!opaque_depth_is_cleared_) draw_opaque();
}

Trace& Region::traced() noexcept { return scratch_->trace; }

// Scratch goes back to the pool, so that the next region finds memory that is already there.
Region::~Region() {
    if (pool_ == nullptr) return;
    scratch_->keep_words(storages_);
    pool_->give(std::move(scratch_));
}

Target Region::make(Format format, int samples) {
    if (auto lacking = check_samples(profile(), samples)) throw Refused{profile(), *std::move(lacking)};
    storages_.emplace_back(format, samples, rect_.area(), scratch_->take_words());
    return {static_cast<int>(storages_.size()) - 1};
}

void Region::clear(Target given, const ClearValue& given_value, std::uint8_t sample_mask) {
    Target target = given;
    ClearValue value = given_value;
    if (const Alteration* a = alteration(); a != nullptr && a->clear && !a->clear(*this, target, value)) return;
    opaque_depth_is_cleared_ &= target != opaque_depth_;
    TargetStorage& storage = at(target);
    const Format format = storage.format();
    if (is_color(format)) {
        for (int c = 0; c < info(format).channels; ++c)
            if (!std::isfinite(value.color[c])) cleared_non_finite_.push_back(target.id);
        storage.fill(color_codes(format, profile().color_rounding(), value.color), sample_mask);
    } else if (is_depth(format)) {
        // D32F is cleared as it is on devices with NV_depth_buffer_float's unclamped clear, clamped elsewhere (formats.md 5.5).
        const bool unclamped = format == Format::d32f && profile().has_unclamped_depth_clear;
        const std::uint32_t code =
            unclamped ? std::bit_cast<std::uint32_t>(value.depth)
                      : rasterizer::to_depth_code(value.depth, depth_format(format), profile().raster.depth_rounding);
        storage.fill({code, 0, 0, 0}, sample_mask);
    }
    if (has_stencil(format)) storage.fill_stencil(value.stencil, sample_mask);
    count(of_clear(1, bytes(storage)));
    show({.step = Step::clear, .to = target, .clear = &value, .sample_mask = sample_mask});
}

// A bit copy of codes (formats.md 5.6): it rounds nothing, and -0 and NaN stay what they are.
void Region::copy(Target given_from, Target given_to) {
    Target from = given_from, to = given_to;
    if (const Alteration* a = alteration(); a != nullptr && a->copy && !a->copy(*this, from, to)) return;
    assert(at(from).format() == at(to).format() && at(from).samples() == at(to).samples());
    at(to) = at(from);
    opaque_depth_is_cleared_ &= to != opaque_depth_;
    count(of_copy(1, bytes(at(from))));
    count_pass({.copies = 1});
    show({.step = Step::copy, .to = to, .from = from});
}

// The part that lies in this region is written, and its source must lie here, too: a tile knows no neighbour. Else the
// frame is run again as a whole (execution.md 5.4).
void Region::copy_rectangle(Target from, const rasterizer::Rect& from_rect, Target to, int dx, int dy) {
    const TargetStorage& source = at(from);
    TargetStorage& texture = at(to);
    assert(source.format() == texture.format() && source.samples() == 1 && texture.samples() == 1);
    opaque_depth_is_cleared_ &= to != opaque_depth_;
    const auto [x0, y0, x1, y1] = from_rect;
    const rasterizer::Rect written =
        rasterizer::intersection(rect_, rasterizer::intersection({x0 + dx, y0 + dy, x1 + dx, y1 + dy}, frame_.rect()));
    if (intersection(rasterizer::Rect{written.x0 - dx, written.y0 - dy, written.x1 - dx, written.y1 - dy}, rect_)
            .area() != written.area())
        throw NeedsFrame{};
    for (int y = written.y0; y < written.y1; ++y) copy_row(source, written, y, dx, dy, texture);
    count(of_copy(static_cast<std::uint64_t>(info(source.format()).bytes_per_pixel), written.area()));
    count_pass({.copies = 1});
    show({.step = Step::copy, .to = to, .from = from});
}

// Row y of `written`; overlapping copies within one target are not asked for.
void Region::copy_row(const TargetStorage& source, const rasterizer::Rect& written, int y, int dx, int dy,
                      TargetStorage& texture) {
    const auto index = [&](int column, int row) {
        return static_cast<std::uint32_t>((row - rect_.y0) * rect_.width() + column - rect_.x0);
    };
    RegionScratch& s = *scratch_;
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
DepthTexels Region::depth_texels(Target depth) const {
    const rasterizer::Rect& frame = frame_.rect();
    DepthTexels texels;
    texels.codes = storage(depth).depth(0);
    texels.held = {rect_.x0 - frame.x0, rect_.y0 - frame.y0, rect_.x1 - frame.x0, rect_.y1 - frame.y0};
    texels.width = frame.width();
    texels.height = frame.height();
    texels.format = depth_format(storage(depth).format());
    texels.bottom_up = frame_.transparent->geometry.state.y_direction == rasterizer::YDirection::up;
    return texels;
}

void Region::draw_opaque() {
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = opaque_depth_;
    state.color[0] = opaque_color_;
    auto program = [](const FragmentBatch& in, const Loads&, Outputs& out) {
        out.color[0] = in.color;
        out.color[0][3].fill(1.0f);  // alphaMode OPAQUE ignores alpha, and what MASK keeps is opaque
    };
    static_cast<void>(draw_list(state, *frame_.opaque, program));
}

// Coverage is counted first, before MASK, so that the list is allocated once and not moved while it grows.
std::vector<CapturedFragment> Region::capture(Bookkeeping bookkeeping) {
    std::optional<UncountedWork> look;
    if (bookkeeping == Bookkeeping::silent) look.emplace(books_);
    std::uint64_t fragments = 0;
    std::vector<std::uint32_t> coverage(rect_.area());
    RegionShortcuts{*this}.count_coverage(coverage);
    for (const std::uint32_t of_pixel : coverage) fragments += of_pixel;
    std::vector<CapturedFragment> all;
    all.reserve(fragments);
    PassState state;
    state.needs = {
        .shader_z = true, .code = true, .exact_code = true, .color = true, .texcoord = false, .facing = false};
    static_cast<void>(draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            if (out.alive[i] == 0) continue;
            all.push_back({in.pixel[i],
                           in.primitive[i],
                           in.code[i],
                           in.exact_code[i],
                           in.shader_z[i],
                           {in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]}});
        }
    }));
    return all;
}

// Channels that the format lacks are 0, alpha 1, as a program loads them.
Rgba Region::color(Target target, std::uint32_t pixel, int sample) const {
    const TargetStorage& from = storage(target);
    const FormatInfo format = info(from.format());
    Rgba color{0, 0, 0, 1};
    for (int c = 0; c < format.channels; ++c) {
        const std::uint32_t code = from.code(pixel, c, sample);
        color[static_cast<std::size_t>(c)] =
            format.type == ChannelType::unorm8 ? code_value(code, profile().unorm_rounding)
            : format.type == ChannelType::half ? half_value(static_cast<std::uint16_t>(code), profile().half_rounding)
                                               : std::bit_cast<float>(code);
    }
    return color;
}

Image Region::image(Target target) const {
    const TargetStorage& from = storage(target);
    Image image = Image::for_overwrite(from.format(), rect_.width(), rect_.height(), from.samples());
    for (int y = 0; y < rect_.height(); ++y) read_row(from, y, &image.codes[image.index(0, y)]);
    finish_words();
    return image;
}

// One row of the region as Image orders it: pixels, their samples, their channels.
void Region::read_row(const TargetStorage& from, int y, std::uint32_t* out) const {
    const auto width = static_cast<std::size_t>(rect_.width()), first = static_cast<std::size_t>(y) * width;
    const auto channels = static_cast<std::size_t>(info(from.format()).channels);
    const auto samples = static_cast<std::size_t>(from.samples());
    if (samples == 1 && read_words(from.texels(0), first, width, out)) return;
    for (std::size_t x = 0; x < width; x += batch_capacity) {
        const std::size_t count = std::min<std::size_t>(width - x, batch_capacity);
        for (std::size_t sample = 0; sample < samples; ++sample) {
            ColorCodes& codes = scratch_->codes;
            Lanes<std::uint32_t>& pixel = scratch_->screen.pixel;
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

}  // namespace strata::pipeline
