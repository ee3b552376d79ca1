// scenes/gltf/document/faults.h - collects all faults of a document instead of stopping at the first: a faulty part
// does not prevent the others from being checked.
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/document/input_errors.h"
#include "scenes/gltf/document/json.h"

namespace strata::scenes {

class Faults {
  public:
    // Runs the check of one part and keeps its fault. The same fault found in two ways is kept once.
    void collect(auto&& check) {
        try {
            check();
        } catch (const InputError& fault) {
            if (!first_) first_ = fault;
            if (std::find(sentences_.begin(), sentences_.end(), fault.what()) == sentences_.end())
                sentences_.emplace_back(fault.what());
        }
    }
    // Runs check(element) for each element of an array that may be absent.
    void collect_each(const JsonAt& owner, const char* key, auto&& check) {
        collect([&] {
            for (const JsonAt& element : owner.elements(key)) collect([&] { check(element); });
        });
    }
    void add(const Faults& further) {
        if (!first_) first_ = further.first_;
        sentences_.insert(sentences_.end(), further.sentences_.begin(), further.sentences_.end());
    }
    [[nodiscard]] bool empty() const noexcept { return sentences_.empty(); }
    // Throws InputErrors with all faults, if there are any.
    void report() const {
        if (first_) throw InputErrors{*first_, sentences_};
    }

  private:
    std::optional<InputError> first_;
    std::vector<std::string> sentences_;
};

}  // namespace strata::scenes
