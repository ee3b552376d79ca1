// scenes/gltf/document/faults.h - all faults of a document, not the first alone: a part that is wrong does not keep the
// others from being looked at.
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
    // Runs the check of one part; its fault is kept, and the next part's turn comes. A part that is reached by two ways
    // counts once.
    void collect(auto&& check) {
        try {
            check();
        } catch (const InputError& fault) {
            if (!first_) first_ = fault;
            if (std::find(sentences_.begin(), sentences_.end(), fault.what()) == sentences_.end())
                sentences_.emplace_back(fault.what());
        }
    }
    // check(element) of each element of an array that may be absent.
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
    // InputErrors with all of them, if there is any.
    void report() const {
        if (first_) throw InputErrors{*first_, sentences_};
    }

  private:
    std::optional<InputError> first_;
    std::vector<std::string> sentences_;
};

}  // namespace strata::scenes
