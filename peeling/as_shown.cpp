// peeling/as_shown.cpp - flips rows and converts keys to depths for as_shown.h.
#include "peeling/as_shown.h"

#include <algorithm>
#include <span>

#include "peeling/audit/audit_result.h"
#include "peeling/audit/region_trace.h"
#include "peeling/render.h"
#include "rasterizer/rules/depth_key.h"

namespace strata::peeling {

using pipeline::Image;

namespace {

void turn_keys(Image& image) {
    if (!is_depth(image.format)) return;
    const rasterizer::DepthFormat format = pipeline::depth_format(image.format);
    for (std::uint32_t& code : image.codes) code = rasterizer::depth_key(code, format);
}

// Swaps the first row with the last, and so on.
template <class Values>
void exchange_rows(Values&& values, int height) {
    if (height <= 0) return;
    const std::size_t row = values.size() / static_cast<std::size_t>(height);
    const auto at = [&](int y) {
        return values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
    };
    for (int upper = 0, lower = height - 1; upper < lower; ++upper, --lower)
        std::swap_ranges(at(upper), at(upper + 1), at(lower));
}

}  // namespace

void AsShown::turn(Image& image) const {
    if (turns_keys_) turn_keys(image);
    if (turns_rows_) exchange_rows(image.codes, image.height);
}

void AsShown::turn(pipeline::FrameResult& result) const {
    turn(result.color);
    turn(result.depth);
    for (Image& sample : result.samples) turn(sample);
    for (pipeline::PeeledLayer& layer : result.layers) {
        if (turns_rows_) exchange_rows(layer.color.codes, layer.color.height);
        turn(layer.depth);
    }
    for (pipeline::Diagnostic& d : result.diagnostics)
        if (d.first_y >= 0) d.first_y = row(d.first_y);
}

void AsShown::turn(AuditResult& result) const noexcept {
    for (PixelCount* count : {&result.ties, &result.misordered, &result.opaque_ties})
        if (count->first_y >= 0) count->first_y = row(count->first_y);
}

void AsShown::turn(FrameFragments& fragments) const {
    for (pipeline::CapturedFragment& fragment : fragments.all) {
        if (turns_keys_) {
            fragment.shader_z = rasterizer::depth_key(fragment.shader_z);
            fragment.code = rasterizer::depth_key(fragment.code, format_);
            fragment.exact_code = rasterizer::depth_key(fragment.exact_code, format_);
        }
        fragment.pixel = pixel(fragment.pixel);
    }
    if (turns_keys_)
        for (std::uint32_t& code : fragments.opaque) code = rasterizer::depth_key(code, format_);
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (std::size_t first = 0; turns_rows_ && first < fragments.opaque.size(); first += pixels)
        exchange_rows(std::span{fragments.opaque}.subspan(first, pixels), height_);
}

void AsShown::turn(std::vector<RegionTrace>& traces) const {
    if (!turns_rows_) return;
    for (RegionTrace& trace : traces) {
        const auto width = static_cast<std::uint32_t>(trace.rect.width());
        const auto height = static_cast<std::uint32_t>(trace.rect.height());
        for (pipeline::TraceEntry& entry : trace.entries) {
            const std::uint32_t row = entry.pixel / width, sample = row / height;
            entry.pixel = (sample * height + height - 1 - row % height) * width + entry.pixel % width;
        }
        trace.rect = rect(trace.rect);
    }
}

void AsShown::turn_rows(std::vector<double>& numbers) const {
    if (turns_rows_) exchange_rows(numbers, height_);
}

}  // namespace strata::peeling
