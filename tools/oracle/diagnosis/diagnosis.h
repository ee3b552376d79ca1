// tools/oracle/diagnosis/diagnosis.h - finds the mistake with which an image was rendered.
//
// Rule     The image of every mistake is compared with the candidate, pixel by pixel and code by code; findings are
//          ranked by the number of pixels that agree. The correct run precedes all mistakes that explain no more
//          pixels, and a mistake precedes those after it in the catalogue; options of allowed_options.h, if there are
//          any, precede all mistakes. A mistake that does not change the image of this scene is not a finding. If no
//          single mistake explains every pixel, pairs are tried: first all that end with a mistake of the finished
//          image, then those that contradict the candidate least where only one of the two changes the pixel. For a
//          candidate of one colour everywhere and without passes no pairs are tried, because it is no evidence of two
//          mistakes. If none explains every pixel exactly, one that explains all within one code counts as nearly
//          explaining them, unless the correct run does, if it explains half of those that differ exactly, or if it is
//          a single mistake and half of them differ from the correct image by more than one code. If the candidate has
//          passes, they decide between mistakes with the same image; a run whose passes differ from the candidate's no
//          later than the correct run's do did not make it.
// Tests    tests/tools/oracle/diagnosis/diagnosis_test.cpp
#pragma once
#include <span>

#include "tools/oracle/compare/compare.h"
#include "tools/oracle/emulations/mistake_renderer.h"
#include "tools/oracle/show_progress.h"

namespace strata::oracle {

struct Finding {
    std::vector<const Mistake*> mistakes{};  // empty: the correct run
    std::uint64_t agreeing = 0;              // pixels equal to the candidate's
    std::uint64_t explained = 0;             // of those, pixels that differ from the correct image
    std::uint64_t contradicted = 0;          // pixels of the candidate that are correct but not equal to this image
    std::uint64_t nearly = 0;                // pixels within one code of the candidate's
    std::vector<const Mistake*>
        alike{};  // other mistakes with the same image of this scene, and passes that agree as far
    std::optional<PassAgreement> passes{};  // of findings with the candidate's image, and of the best finding
};

enum class Conclusion : std::uint8_t {
    right,
    other_options,  // a correct run with other options
    one_mistake,
    two_mistakes,
    right_structure,  // set by a judge: no image equals the candidate's, but its layers are correct except for rounding
    unknown_mistake   // the best finding leaves pixels unexplained
};

struct SuiteScene;  // tools/oracle/suite/suite.h

struct Diagnosis {
    Conclusion conclusion{};
    std::uint64_t pixels = 0, differing = 0;      // differing: from the correct image, beyond the tolerances
    std::uint64_t differing_far = 0;              // of `differing`, by more than one code beyond them
    std::optional<std::uint64_t> at_edges{};      // of `differing`, if pixels have several samples
    bool is_blank = false;                        // the candidate has one colour everywhere
    bool is_nearly = false;                       // the finding explains some pixels only within one code
    bool passes_contradict = false;               // the image equals the first finding's, but no known run's passes do
    std::optional<PassAgreement> right_passes{};  // of the correct run
    std::vector<Finding> findings{};              // the best first; never empty
    const SuiteScene* distinguishing_scene =
        nullptr;  // a scene that distinguishes the first finding from those alike, or the leads
    int tried = 0, hidden = 0, impossible = 0, pairs_tried = 0;
};

// True if mistakes that explain all pixels within one code do so not by accident: of the pixels that differ from the
// correct image half are explained exactly, or, by a single mistake, half differ by more than one code (differing_far).
[[nodiscard]] bool is_evidence(std::span<const Mistake* const> mistakes, std::uint64_t explained,
                               std::uint64_t differing, std::uint64_t differing_far) noexcept;

// The images of all mistakes, rendered once for any number of candidates.
class MistakeImages {
  public:
    // `mistake_renderer` and `options` must outlive this.
    explicit MistakeImages(const MistakeRenderer& mistake_renderer, const ShowProgress& progress = {},
                           std::span<const Mistake> options = {});

    // `passes` are the candidate's, or null.
    [[nodiscard]] Diagnosis diagnose(const Picture& candidate, const Tolerances& tolerances = {},
                                     const ShowProgress& progress = {},
                                     const std::vector<PassPicture>* passes = nullptr) const;

    // Judges the run with those of `mistakes` that are applicable to this scene. It fits if the candidate's image
    // equals its image, or is within one code of it where the correct image is not, and its passes do not contradict.
    struct Judgement {
        Finding finding{};
        bool fits = false;
    };
    [[nodiscard]] Judgement judge(std::span<const Mistake* const> mistakes, const Picture& candidate,
                                  const Tolerances& tolerances, const std::vector<PassPicture>* passes) const;

    // Null if the mistake is not applicable to this scene.
    [[nodiscard]] const Picture* picture_of(const Mistake& mistake) const;
    [[nodiscard]] bool shows(const Mistake& mistake) const;

  private:
    struct Suspect {
        const Mistake* mistake = nullptr;
        std::optional<Picture> picture{};
        std::vector<bool> unchanged{};  // the pixels equal to the correct image; only if `shows`
        bool shows = false;
        std::size_t like = 0;  // index of the first suspect with this image
    };
    struct Evidence;
    [[nodiscard]] bool cancels(std::size_t first, std::size_t second, const Picture& both) const;
    void try_pairs(const Evidence& evidence, const ShowProgress& progress, Diagnosis& diagnosis) const;
    void weigh_nearly_whole(const std::vector<PassPicture>& passes, Diagnosis& diagnosis) const;
    void weigh_passes(const Evidence& evidence, const std::vector<PassPicture>& passes, Diagnosis& diagnosis) const;

    const MistakeRenderer& mistake_renderer_;
    std::vector<Suspect> suspects_;
    std::vector<bool> edges_;  // of MistakeRenderer::edges
};

}  // namespace strata::oracle
