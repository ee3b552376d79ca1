// pipeline/formats/digest.cpp - the digest of a target: one string that depends on all of its bits.
//
// Rule     XXH3-128, seed 0, of: the format's name in ASCII, a zero byte, u32 width, height and samples, then the codes
//          in the order of Image: UNORM8 and stencil u8, half u16, binary32 and every depth format (D16 too) u32; all
//          little-endian.
// Source   pipeline/reference/formats.md 8
// Tests    tests/scenes/digest_test.cpp, against a buffer serialized independently
#include <xxhash.h>

#include <array>
#include <memory>
#include <new>
#include <string_view>

#include "pipeline/formats/image.h"
#include "pipeline/formats/value_digest.h"

namespace strata::pipeline {
namespace hashing {  // external linkage, because ValueDigest::State has a Hash member

struct FreeState {
    void operator()(XXH3_state_t* state) const noexcept { XXH3_freeState(state); }
};

// Collects codes in a buffer, so that the hash receives many bytes at once.
class Hash {
  public:
    Hash() : state_{XXH3_createState()} {
        if (state_ == nullptr) throw std::bad_alloc{};
        XXH3_128bits_reset(state_.get());
    }

    void text(std::string_view bytes) { XXH3_128bits_update(state_.get(), bytes.data(), bytes.size()); }

    // Appends the lowest `size` bytes of `code`, least significant first.
    void word(std::uint32_t code, int size) {
        if (used_ + 4 > buffer_.size()) flush();
        for (int i = 0; i < size; ++i) buffer_[used_++] = static_cast<unsigned char>(code >> (8 * i));
    }

    [[nodiscard]] std::string hexadecimal() {
        flush();
        XXH128_canonical_t bytes{};
        XXH128_canonicalFromHash(&bytes, XXH3_128bits_digest(state_.get()));
        std::string result;
        for (const unsigned char byte : bytes.digest) {
            result += "0123456789abcdef"[byte >> 4];
            result += "0123456789abcdef"[byte & 15];
        }
        return result;
    }

  private:
    void flush() {
        XXH3_128bits_update(state_.get(), buffer_.data(), used_);
        used_ = 0;
    }

    std::unique_ptr<XXH3_state_t, FreeState> state_;
    std::array<unsigned char, 16384> buffer_{};
    std::size_t used_ = 0;
};

}  // namespace hashing

namespace {

// Bytes per code in the digest. They differ from those of the format: D16 takes four (formats.md 8).
int code_bytes(ChannelType type) noexcept {
    switch (type) {
        case ChannelType::unorm8: return 1;
        case ChannelType::unorm10:
        case ChannelType::half: return 2;
        case ChannelType::single: return 4;
        case ChannelType::depth: return 4;
        case ChannelType::stencil: break;
    }
    return 1;
}

}  // namespace

std::string digest(const Image& image) {
    const FormatInfo format = info(image.format);
    hashing::Hash hash;
    hash.text(format.name);
    hash.word(0, 1);
    for (const int number : {image.width, image.height, image.samples})
        hash.word(static_cast<std::uint32_t>(number), 4);
    const int size = code_bytes(format.type);
    for (const std::uint32_t code : image.codes) hash.word(code, size);
    return hash.hexadecimal();
}

struct ValueDigest::State {
    hashing::Hash hash;
};

ValueDigest::ValueDigest(std::string_view name) : state_{std::make_unique<State>()} {
    state_->hash.text(name);
    state_->hash.word(0, 1);
}

ValueDigest::~ValueDigest() = default;

void ValueDigest::add(std::uint32_t word) { state_->hash.word(word, 4); }

std::string ValueDigest::hexadecimal() { return state_->hash.hexadecimal(); }

}  // namespace strata::pipeline
