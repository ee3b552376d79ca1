// tools/oracle/emulations/pass_evidence.h - compares the passes of a run with those of a candidate, target by target.
//
// Rule     Targets are paired by pass number and name; a target is alike if all of its codes are equal. Targets of only
//          one of the two are not compared. A target of several samples is one per sample. A target is far off if a
//          code differs by more than other rounding can explain: 64 codes of binary32, 16 of 24 bits, 2 of fp16, 1 of
//          fewer bits.
// Tests    tests/tools/oracle/emulations/pass_evidence_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strata::oracle {

struct TargetImage;  // tools/oracle/picture/picture.h

struct PassPicture;  // tools/oracle/pack/pack_pictures.h
struct PassReport;   // tools/oracle/passes/passes.h

struct PassAgreement {
    int targets = 0, alike = 0;       // targets: compared; alike: equal in all codes
    std::optional<int> first_unlike;  // the first pass with a target that is not alike
    std::optional<int> first_far;     // the first pass with a target that is far off
    std::vector<std::uint64_t> far;   // per pass, the number of far-off pixels in all targets
    [[nodiscard]] bool is_whole() const noexcept { return !first_unlike; }
    friend bool operator==(const PassAgreement&, const PassAgreement&) = default;
};

// True if a run's passes equal the candidate's, or first differ in a later pass than the correct run's, or have at most
// a twentieth of the correct run's far-off pixels in its first far-off pass, as from edges with other rounding.
[[nodiscard]] bool explains_origin(const PassAgreement& emulation, const PassAgreement& right);

// Receives a run's passes one after another.
class PassEvidence {
  public:
    // `candidate` must outlive this.
    explicit PassEvidence(const std::vector<PassPicture>& candidate) : candidate_{candidate} {}
    // A target that is not the candidate's may be replaced by the one of `instead` with its name.
    void add(const PassReport& pass, std::span<const TargetImage> instead = {});
    [[nodiscard]] const PassAgreement& found() const noexcept { return found_; }

  private:
    const std::vector<PassPicture>& candidate_;
    PassAgreement found_;
};

}  // namespace strata::oracle
