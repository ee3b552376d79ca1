// tests/fuzz/inputs.h - what people hand to the program, each kind by itself: any bytes are refused in a sentence, or
// keep a promise.
//
// Rule     profile, camera what is read and written reads back as it is. plan its cells are there, none twice. pack a
//          manifest beside the arrays of a small scene: what is read can be drawn. exr its targets have the digests
//          that are told without reading them whole. calls a sequence of calls on one renderer answers what each call
//          answers on a renderer of its own.
// Tests    tests/fuzz/corpus holds archives of inputs that reach different code; tests/fuzz/replay_inputs.cpp asks
//          each.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace strata::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Input {
    std::string_view name;
    // Throws std::logic_error for a broken promise; what is refused is no fault.
    void (*try_bytes)(Bytes bytes);
    // Files to start from.
    void (*write_seeds)(const std::filesystem::path& folder);
};

[[nodiscard]] std::span<const Input> inputs();

// Throws std::logic_error with these words unless it holds.
void require(bool holds, const char* promise);

void try_pack(Bytes bytes);
void write_packs(const std::filesystem::path& folder);
void try_exr(Bytes bytes);
void write_exrs(const std::filesystem::path& folder);
void try_calls(Bytes bytes);
void write_calls(const std::filesystem::path& folder);

}  // namespace strata::fuzz
