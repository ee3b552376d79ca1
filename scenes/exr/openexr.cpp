// scenes/exr/openexr.cpp - frame buffers over interleaved pixels, and the library's threads.
#include "scenes/exr/openexr.h"

#include <OpenEXR/ImfThreading.h>

#include "rasterizer/base/parallel.h"
#include "rasterizer/base/thread_loop.h"

namespace strata::scenes::exr {

// OpenEXR 3.1 terminates the process if it cannot create a thread (observed with a thread limit), so this creates them
// first.
int start_threads() {
    static const int started = [] {
        constexpr std::size_t usual_stack = std::size_t{8} << 20;
        const int wanted = thread_count(0);
        const int found = wanted > 1 && available_threads(wanted, usual_stack) == wanted ? wanted : 0;
        Imf::setGlobalThreadCount(found);
        return found;
    }();
    return started;
}

Imf::FrameBuffer flat_frame(const PartHeader& header, const Imath::Box2i& window, const std::byte* bytes) {
    Imf::FrameBuffer frame;
    const std::size_t stride = pixel_bytes(header);
    for (const StoredChannel& channel : header.channels) {
        frame.insert(channel.name, Imf::Slice::Make(pixel_type(channel.type), bytes, window, stride,
                                                    stride * static_cast<std::size_t>(header.width)));
        bytes += size_of(channel.type);
    }
    return frame;
}

DeepRows::DeepRows(const PartHeader& header, std::size_t pixels)
    : counts(pixels), header_{header}, places_(header.channels.size(), std::vector<std::byte*>(pixels)) {}

Imf::DeepFrameBuffer DeepRows::frame(const Imath::Box2i& window) {
    // The library adds x * xStride + y * yStride of the window's own coordinates to the base.
    const auto base = [&](void* first, std::size_t size) {
        const std::int64_t pixel = window.min.x + std::int64_t{window.min.y} * header_.width;
        return static_cast<char*>(first) - pixel * static_cast<std::int64_t>(size);
    };
    const auto width = static_cast<std::size_t>(header_.width);
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice(
        Imf::Slice{Imf::UINT, base(counts.data(), sizeof counts[0]), sizeof counts[0], sizeof counts[0] * width});
    for (std::size_t c = 0; c < places_.size(); ++c) {
        const std::size_t size = sizeof places_[c][0];
        frame.insert(header_.channels[c].name,
                     Imf::DeepSlice{pixel_type(header_.channels[c].type), base(places_[c].data(), size), size,
                                    size * width, pixel_bytes(header_)});
    }
    return frame;
}

void DeepRows::point_at(std::byte* bytes) {
    for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
        std::byte* place = bytes;
        for (std::size_t c = 0; c < places_.size(); place += size_of(header_.channels[c++].type))
            places_[c][pixel] = place;
        bytes += counts[pixel] * pixel_bytes(header_);
    }
}

}  // namespace strata::scenes::exr
