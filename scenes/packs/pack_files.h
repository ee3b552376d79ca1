// scenes/packs/pack_files.h - the files of a pack: written one after another and listed, or looked up and read.
//
// Rule     tools/oracle/pack/PACK.md, "Digests".
// Tests    tests/scenes/packs/pack_scene_test.cpp
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scenes/packs/npy.h"

namespace strata::scenes {

// XXH3-128 of bytes, in the form of pipeline::digest.
[[nodiscard]] std::string digest_of_bytes(std::string_view bytes);

// Two sums of bytes, modulo 2^61 - 1, which identify a single changed byte.
struct ByteSums {
    std::uint64_t plain = 0, weighted = 0;
    friend bool operator==(const ByteSums&, const ByteSums&) = default;
};
[[nodiscard]] ByteSums sums_of(std::string_view bytes) noexcept;

// The single byte whose change explains the difference of two sums.
struct ChangedByte {
    std::size_t position = 0;
    std::uint8_t was = 0, is = 0;
};
// Empty if no single byte explains the difference. `bytes` are the present ones, `sums` those of the original file.
[[nodiscard]] std::optional<ChangedByte> changed_byte(std::string_view bytes, const ByteSums& sums) noexcept;

class PackFiles {
  public:
    using Sink = std::function<void(const std::string& name, const std::string& bytes)>;
    explicit PackFiles(Sink sink) : sink_{std::move(sink)} {}

    // Both pass on the file's bytes, add it to the list and return the name. Names are paths in the pack, with slashes;
    // each may be used once.
    const std::string& add(const std::string& name, const NumberArray& array);
    const std::string& add_text(const std::string& name, const std::string& text);

    [[nodiscard]] const nlohmann::ordered_json& list() const noexcept { return list_; }

  private:
    Sink sink_;
    nlohmann::ordered_json list_ = nlohmann::ordered_json::object();
};

}  // namespace strata::scenes
