// scenes/exr/byte_sink.h - the interface through which image libraries write a file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace strata::scenes {

// The functions never throw: they return failures to the caller, which then stops writing.
struct ByteSink {
    std::string path;  // only for messages
    std::function<std::size_t(const void* bytes, std::size_t size)> write;
    std::function<bool(std::int64_t position)> seek;
    std::function<std::int64_t()> position;
};

}  // namespace strata::scenes
