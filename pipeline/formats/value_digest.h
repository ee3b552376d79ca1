// pipeline/formats/value_digest.h - the hash of an image's digest, for data that are not an Image.
//
// Rule     XXH3-128, seed 0, of a name in ASCII, a zero byte, then every word as u32, little-endian.
// Tests    tests/scenes/files/deep_exr_test.cpp
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace strata::pipeline {

class ValueDigest {
  public:
    explicit ValueDigest(std::string_view name);
    ~ValueDigest();
    ValueDigest(const ValueDigest&) = delete;
    ValueDigest& operator=(const ValueDigest&) = delete;

    void add(std::uint32_t word);
    [[nodiscard]] std::string hexadecimal();  // of all words so far; must be the last call

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::pipeline
