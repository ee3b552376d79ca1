// scenes/gltf/document/warnings.h - warnings about features of a file that are not supported: one message per feature,
// with the JSON pointer of its first use.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace strata::scenes {

class Warnings {
  public:
    // If the message is already known, only its count increases.
    void add(const std::string& pointer, const std::string& message) {
        const auto [known, is_new] = index_.emplace(message, kinds_.size());
        if (is_new) kinds_.push_back({message, pointer});
        ++kinds_[known->second].places;
    }
    // One line per message, in the order of their first uses.
    [[nodiscard]] std::vector<std::string> messages() const {
        std::vector<std::string> lines;
        for (const Kind& k : kinds_) {
            const std::string more = k.places > 1 ? " (and " + std::to_string(k.places - 1) + " more)" : "";
            lines.push_back(k.pointer + more + ": " + k.message);
        }
        return lines;
    }

  private:
    struct Kind {
        std::string message, pointer;
        std::size_t places = 0;
    };
    std::vector<Kind> kinds_;  // in the order of their first uses
    std::map<std::string, std::size_t> index_;
};

}  // namespace strata::scenes
