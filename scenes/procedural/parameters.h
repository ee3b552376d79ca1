// scenes/procedural/parameters.h - parses the text of a procedural scene, "name:key=value,key=value".
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strata::scenes {

class Parameters {
  public:
    // InputError for an item that is not key=value, and for a key that occurs twice or is not among `keys`.
    Parameters(std::string spec, std::span<const std::string_view> keys);

    // The value of `key` or the default; InputError unless it is a whole number from `low` to `high`.
    [[nodiscard]] std::uint64_t integer(std::string_view key, std::uint64_t low, std::uint64_t high,
                                        std::uint64_t absent) const;
    // The position of the value among `choices`; 0 if the key is absent.
    [[nodiscard]] std::size_t choice(std::string_view key, std::span<const std::string_view> choices) const;

  private:
    // The text after the key's equals sign, or null if the key is absent.
    [[nodiscard]] const std::string* find(std::string_view key) const;

    // The whole text: errors quote it as the file's name.
    std::string spec_;
    std::vector<std::pair<std::string, std::string>> values_;
};

// "volume-beam" of "volume-beam:slices=3".
[[nodiscard]] std::string scene_name(const std::string& spec);

}  // namespace strata::scenes
