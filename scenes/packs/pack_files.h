// scenes/packs/pack_files.h - the files of a pack: put somewhere one after the other and listed, or looked up and read.
//
// Rule     tools/oracle/PACK.md, "Digests".
// Tests    tests/scenes/packs/pack_scene_test.cpp
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scenes/packs/npy.h"

namespace strata::scenes {

// XXH3-128 of bytes, as pipeline::digest prints it.
[[nodiscard]] std::string digest_of_bytes(std::string_view bytes);

// Two sums of bytes, modulo 2^61 - 1: they tell which byte has changed, if it is one.
struct ByteSums {
    std::uint64_t plain = 0, weighted = 0;
    friend bool operator==(const ByteSums&, const ByteSums&) = default;
};
[[nodiscard]] ByteSums sums_of(std::string_view bytes) noexcept;

// The one byte whose change explains other sums.
struct ChangedByte {
    std::size_t position = 0;
    std::uint8_t was = 0, is = 0;
};
// Empty if no single byte explains them. `bytes` are those that are there, `sums` those of the file as it was.
[[nodiscard]] std::optional<ChangedByte> changed_byte(std::string_view bytes, const ByteSums& sums) noexcept;

class PackFiles {
  public:
    using Sink = std::function<void(const std::string& name, const std::string& bytes)>;
    explicit PackFiles(Sink sink) : sink_{std::move(sink)} {}

    // Both hand the file's bytes on, list them, and answer the name. Names are paths in the pack, with slashes, none
    // twice.
    const std::string& add(const std::string& name, const NumberArray& array);
    const std::string& add_text(const std::string& name, const std::string& text);

    [[nodiscard]] const nlohmann::ordered_json& list() const noexcept { return list_; }

  private:
    Sink sink_;
    nlohmann::ordered_json list_ = nlohmann::ordered_json::object();
};

}  // namespace strata::scenes
