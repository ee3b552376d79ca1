// tools/oracle/pack/manifest_value.h - reads the results of a manifest that another program may have changed: keys may
// be missing, but values that are present must have their type.
//
// Tests    tests/tools/oracle/pack/changed_packs_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace strata::oracle {

// A value with its JSON pointer for errors: InputError{file, pointer} if the value is not of the requested type.
class ManifestValue {
  public:
    // `value` and `file` must outlive it.
    ManifestValue(const nlohmann::json& value, const std::string& file) : ManifestValue{value, file, ""} {}

    [[nodiscard]] ManifestValue object(const std::string& key) const;             // empty if missing or null
    [[nodiscard]] std::vector<ManifestValue> list(const std::string& key) const;  // of objects
    [[nodiscard]] std::string text(const std::string& key) const;
    [[nodiscard]] int whole(const std::string& key, int fallback, int lowest, int highest) const;
    // The name of an existing algorithm.
    [[nodiscard]] std::string algorithm(const std::string& key) const;
    // A name without a slash, so that it can be part of a path.
    [[nodiscard]] std::string name(const std::string& key) const;
    [[nodiscard]] const nlohmann::json& value() const noexcept { return *value_; }
    [[nodiscard]] std::string pointer_to(const std::string& key) const { return pointer_ + "/" + key; }
    [[noreturn]] void fail(const std::string& key, const std::string& expected) const;

  private:
    ManifestValue(const nlohmann::json& value, const std::string& file, std::string pointer);

    const nlohmann::json* value_;
    const std::string* file_;
    std::string pointer_;
};

}  // namespace strata::oracle
