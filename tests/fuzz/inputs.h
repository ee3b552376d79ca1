// tests/fuzz/inputs.h - the kinds of input that users give to the program: any bytes must be rejected with an error
// message, or satisfy the rule below.
//
// Rule     profile, camera: what is read and written is unchanged when read again. plan: all of its cells exist,
//          without duplicates. pack: a manifest with the arrays of a small scene; if it is read, it can be drawn. exr:
//          its targets have the digests that are computed without reading them completely. calls: each call of a
//          sequence on one renderer returns what it returns on a new renderer.
// Tests    tests/fuzz/corpus has archives of inputs that reach different code; tests/fuzz/replay_inputs.cpp runs each.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace strata::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Input {
    std::string_view name;
    // Throws std::logic_error if the rule is broken; rejecting the bytes is not a fault.
    void (*try_bytes)(Bytes bytes);
    // Writes a corpus to start from.
    void (*write_seeds)(const std::filesystem::path& folder);
};

[[nodiscard]] std::span<const Input> inputs();

// Throws std::logic_error with this message unless `holds`.
void require(bool holds, const char* promise);

void try_pack(Bytes bytes);
void write_packs(const std::filesystem::path& folder);
void try_exr(Bytes bytes);
void write_exrs(const std::filesystem::path& folder);
void try_calls(Bytes bytes);
void write_calls(const std::filesystem::path& folder);

}  // namespace strata::fuzz
