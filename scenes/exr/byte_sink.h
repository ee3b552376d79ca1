// scenes/exr/byte_sink.h - a file that is being written, as the image libraries see it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace strata::scenes {

// The functions never throw: they report failures to their owner, who asks for no more.
struct ByteSink {
    std::string path;  // for messages alone
    std::function<std::size_t(const void* bytes, std::size_t size)> write;
    std::function<bool(std::int64_t position)> seek;
    std::function<std::int64_t()> position;
};

}  // namespace strata::scenes
