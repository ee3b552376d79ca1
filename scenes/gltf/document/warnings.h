// scenes/gltf/document/warnings.h - what a file asks for and does not get: one sentence a feature, with the first place
// that asks.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace strata::scenes {

class Warnings {
  public:
    // A sentence that is already known only counts one place more.
    void add(const std::string& pointer, const std::string& sentence) {
        const auto [known, is_new] = index_.emplace(sentence, kinds_.size());
        if (is_new) kinds_.push_back({sentence, pointer});
        ++kinds_[known->second].places;
    }
    // A line for each sentence, in the order of their first places.
    [[nodiscard]] std::vector<std::string> sentences() const {
        std::vector<std::string> lines;
        for (const Kind& k : kinds_) {
            const std::string more = k.places > 1 ? " (and " + std::to_string(k.places - 1) + " more)" : "";
            lines.push_back(k.pointer + more + ": " + k.sentence);
        }
        return lines;
    }

  private:
    struct Kind {
        std::string sentence, pointer;
        std::size_t places = 0;
    };
    std::vector<Kind> kinds_;  // in the order of their first places
    std::map<std::string, std::size_t> index_;
};

}  // namespace strata::scenes
