// tools/oracle/mistakes/pass_evidence.h - how far the passes of a machine are those of a candidate, target by target.
//
// Rule     Targets are paired by the number of the pass and their names; one is alike if all of its codes are. What one
//          side alone has is not compared. A target is far off if a code is further away than the rounding of another
//          way to the same values explains: 64 codes of binary32, 16 of 24 bits, 2 of fp16, 1 of fewer bits.
// Tests    tests/tools/oracle/mistakes/pass_evidence_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strata::oracle {

struct Target;  // tools/oracle/picture.h

struct PassPicture;  // tools/oracle/pack/pack_pictures.h
struct PassShown;    // tools/oracle/passes.h

struct PassAgreement {
    int targets = 0, alike = 0;       // compared; equal to the last code
    std::optional<int> first_unlike;  // the first pass with a target that is not
    std::optional<int> first_far;     // the first pass with a target that is far off
    std::vector<std::uint64_t> far;   // pixels of each pass that are far off, of all targets; by the number of the pass
    [[nodiscard]] bool is_whole() const noexcept { return !first_unlike; }
    friend bool operator==(const PassAgreement&, const PassAgreement&) = default;
};

// Whether a machine's passes are the candidate's, to the last code or nearly, where the right machine's first are not:
// nearly is also a twentieth of the pixels that are far off there, as an edge of another rounding leaves them.
[[nodiscard]] bool explains_origin(const PassAgreement& machine, const PassAgreement& right);

// Takes a machine's passes one after the other.
class PassEvidence {
  public:
    // `candidate` must live as long.
    explicit PassEvidence(const std::vector<PassPicture>& candidate) : candidate_{candidate} {}
    // A target that is not the candidate's may stand as one of `instead` with its name.
    void add(const PassShown& pass, std::span<const Target> instead = {});
    [[nodiscard]] const PassAgreement& found() const noexcept { return found_; }

  private:
    const std::vector<PassPicture>& candidate_;
    PassAgreement found_;
};

}  // namespace strata::oracle
