// pipeline/region/frame_pictures.cpp - writes, copies and resolves the pictures of a frame (frame_pictures.h).
#include "pipeline/region/frame_pictures.h"

#include <algorithm>

#include "pipeline/formats/resolve.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::pipeline {

FramePictures::FramePictures(const Frame& frame, FrameResult& result) : frame_{frame}, result_{result} {
    const rasterizer::Rect rect = frame.rect();
    result.color = Image::for_overwrite(frame.picture_format(), rect.width(), rect.height());
    if (frame.samples() > 1 && (frame.keep_samples || frame.resolve == Resolve::quincunx))
        result.samples.assign(static_cast<std::size_t>(frame.samples()), result.color);
    if (frame.nearest_depth)
        result.depth = Image::for_overwrite(target_format(frame.key_request().format), rect.width(), rect.height());
}

void FramePictures::write(Region& region, Target published) {
    const RegionShortcuts shortcuts{region};
    for (std::size_t sample = 0; sample < result_.samples.size(); ++sample)
        shortcuts.write_image(published, sample, result_.samples[sample]);
    if (frame_.samples() == 1) return shortcuts.write_image(published, 0, result_.color);
    copy_into(region.targets().resolved(published), region.rect(), result_.color);
}

void FramePictures::write_nearest(Region& region) {
    RegionShortcuts shortcuts{region};
    const Target nearest = shortcuts.nearest_depth();
    if (frame_.samples() == 1) return shortcuts.write_image(nearest, 0, result_.depth);
    copy_into(region.targets().resolved(nearest), region.rect(), result_.depth);
}

void FramePictures::copy_into(const Image& part, const rasterizer::Rect& at, Image& whole) const {
    const auto row = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.channels());
    const rasterizer::Rect frame = frame_.rect();
    for (int y = 0; y < part.height; ++y)
        std::copy_n(
            part.codes.begin() + static_cast<std::ptrdiff_t>(part.index(0, y)), row,
            whole.codes.begin() + static_cast<std::ptrdiff_t>(whole.index(at.x0 - frame.x0, at.y0 - frame.y0 + y)));
}

void FramePictures::copy(const rasterizer::Rect& from, const rasterizer::Rect& to) {
    const rasterizer::Rect frame = frame_.rect();
    const auto copy_of = [&](Image& image) {
        const auto row = static_cast<std::size_t>(from.width()) * static_cast<std::size_t>(image.channels());
        const auto at = [&](const rasterizer::Rect& rect, int y) {
            return image.codes.begin() +
                   static_cast<std::ptrdiff_t>(image.index(rect.x0 - frame.x0, rect.y0 - frame.y0 + y));
        };
        for (int y = 0; y < from.height(); ++y) std::copy_n(at(from, y), row, at(to, y));
    };
    copy_of(result_.color);
    std::ranges::for_each(result_.samples, copy_of);
    if (frame_.nearest_depth) copy_of(result_.depth);
}

void FramePictures::finish() {
    if (frame_.samples() > 1 && frame_.resolve == Resolve::quincunx)
        result_.color = quincunx(result_.samples[0], result_.samples[1]);
    if (!frame_.keep_samples) result_.samples.clear();
}

}  // namespace strata::pipeline
