// tools/oracle/mistakes/diagnosis.h - which wrong machine made a picture.
//
// Rule     Every mistake's own picture is compared with the candidate, pixel by pixel and code by code; a finding's
//          rank is the number of pixels that agree. The right machine comes before all mistakes that explain no more
//          than it does, and a mistake before those behind it in the catalogue; options of machine_options.h, where
//          there are any, come before all mistakes. A mistake whose picture is the right one here is no finding. If no
//          single one explains every pixel, pairs are tried: first all that end in a mistake of the finished picture,
//          then those that contradict the candidate least where only one of the two shows; none for a candidate of one
//          colour everywhere without passes, which is no evidence of two. Where none explains every pixel to the last
//          code, one that explains half of them so and all within one code counts as nearly explaining them, unless the
//          right machine does. A candidate's passes, where it has any, decide between those who leave the same picture;
//          a machine whose passes differ from the candidate's no later than the right machine's do is not the one that
//          made it.
// Tests    tests/tools/oracle/mistakes/diagnosis_test.cpp
#pragma once
#include <functional>
#include <span>

#include "tools/oracle/compare.h"
#include "tools/oracle/mistakes/laboratory.h"

namespace strata::oracle {

struct Finding {
    std::vector<const Mistake*> mistakes{};  // none: the right machine
    std::uint64_t agreeing = 0;              // pixels that are the candidate's
    std::uint64_t explained = 0;             // of those that are not the right machine's
    std::uint64_t contradicted = 0;          // the right machine's, but not this one's
    std::uint64_t nearly = 0;                // pixels that are the candidate's within one code
    std::vector<const Mistake*>
        alike{};  // others that leave the same picture of this scene, and passes that agree as far
    std::optional<PassAgreement> passes{};  // of those that leave the candidate's picture, and of the best
};

enum class Verdict : std::uint8_t {
    right,
    other_options,  // of a right machine: all that is named is allowed
    one_mistake,
    two_mistakes,
    right_structure,  // no machine's picture is the candidate's, but its layers are right apart from rounding
    none_of_mine      // the best finding leaves pixels that it does not explain
};

struct SuiteScene;  // tools/oracle/mistakes/suite.h

struct Diagnosis {
    Verdict verdict{};
    std::uint64_t pixels = 0, differing = 0;  // differing: from the right picture, beyond the tolerances
    bool is_blank = false;                    // the candidate has one colour everywhere
    bool is_nearly = false;                   // what is named explains some pixels only within one code
    bool passes_contradict = false;  // the picture is that of the first finding, but no known machine's passes are
    std::optional<PassAgreement> right_passes{};  // of the right machine
    std::vector<Finding> findings{};              // the best first; never empty
    std::string structure{};  // what the layers say where no machine's picture is the candidate's; empty: not asked
    std::string structure_json{};
    const SuiteScene* telling = nullptr;  // tells the first finding and those that are alike apart, or the leads
    int tried = 0, hidden = 0, impossible = 0, pairs_tried = 0;
};

using ShowProgress = std::function<void(double share)>;

// The pictures of all mistakes, made once for any number of candidates.
class Lineup {
  public:
    // `laboratory` and `options` must live as long.
    explicit Lineup(const Laboratory& laboratory, const ShowProgress& progress = {},
                    std::span<const Mistake> options = {});

    // `passes` are the candidate's; null where it has none.
    [[nodiscard]] Diagnosis diagnose(const Picture& candidate, const Tolerances& tolerances = {},
                                     const ShowProgress& progress = {},
                                     const std::vector<PassPicture>* passes = nullptr) const;

    // The machine with those of `mistakes` that can be made on this scene. It fits if the candidate's picture is its
    // own, or is so within one code where the right machine's is not, and its passes do not contradict.
    struct Judged {
        Finding finding{};
        bool fits = false;
    };
    [[nodiscard]] Judged judge(std::span<const Mistake* const> mistakes, const Picture& candidate,
                               const Tolerances& tolerances, const std::vector<PassPicture>* passes) const;

    // Null where the mistake cannot be made on this scene.
    [[nodiscard]] const Picture* picture_of(const Mistake& mistake) const;
    [[nodiscard]] bool shows(const Mistake& mistake) const;

  private:
    struct Suspect {
        const Mistake* mistake = nullptr;
        std::optional<Picture> picture{};
        std::vector<bool> unchanged{};  // its pixels that are the right picture's; of one that shows
        bool shows = false;
        std::size_t like = 0;  // the first suspect with this picture
    };
    struct Evidence;
    [[nodiscard]] bool cancels(std::size_t first, std::size_t second, const Picture& both) const;
    void try_pairs(const Evidence& evidence, const ShowProgress& progress, Diagnosis& diagnosis) const;
    void weigh_nearly_whole(const std::vector<PassPicture>& passes, Diagnosis& diagnosis) const;
    void weigh_passes(const Evidence& evidence, const std::vector<PassPicture>& passes, Diagnosis& diagnosis) const;

    const Laboratory& laboratory_;
    std::vector<Suspect> suspects_;
};

}  // namespace strata::oracle
