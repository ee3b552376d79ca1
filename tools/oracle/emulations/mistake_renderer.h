// tools/oracle/emulations/mistake_renderer.h - renders images of one scene: the correct one, and those with mistakes.
//
// Rule     An image has the stored colours, and the stored nearest depth if the caller requests depths. A run with a
//          mistake may not terminate: its passes are limited to the caller's limit, if given; otherwise to twice those
//          of the correct run plus eight, or to the same number if the correct run does not terminate either. If a run
//          is refused or cannot be made, there is no image. Of several samples per pixel the image is the resolved one;
//          programs that load other samples or run once a pixel have the renderer's limit instead.
// Tests    tests/tools/oracle/emulations/mistake_renderer_test.cpp
#pragma once
#include <optional>
#include <span>

#include "tools/oracle/emulations/altered_run.h"
#include "tools/oracle/emulations/pass_evidence.h"
#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

struct Mistake;  // tools/oracle/emulations/catalogue.h

enum class Depths : std::uint8_t { left_out, made };

class MistakeRenderer {
  public:
    // Throws Refused if the correct run is refused. Objects that `input` refers to must outlive this. `limit`: the
    // number of geometry passes after which the candidate gives up; 0: unknown.
    MistakeRenderer(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                    Depths depths = Depths::left_out, int limit = 0);

    // Of a part of the picture: pixels outside it are not drawn. Its runs have the passes of this renderer's.
    [[nodiscard]] MistakeRenderer within(const rasterizer::Rect& part) const;

    [[nodiscard]] const Picture& right() const noexcept { return right_; }
    [[nodiscard]] const RightRun& right_run() const noexcept { return right_run_; }
    [[nodiscard]] pipeline::ColorSpace space() const noexcept { return input_.space; }
    [[nodiscard]] std::size_t samples() const noexcept {
        return static_cast<std::size_t>(input_.options.sampling.samples);
    }
    // The pixels whose samples have different fragments, row by row; empty if a pixel has one sample.
    [[nodiscard]] std::vector<bool> edges() const;

    // Applies all of `mistakes` in their order. Empty if one of them is not applicable. Thread-safe.
    [[nodiscard]] std::optional<Picture> with(std::span<const Mistake* const> mistakes) const;
    [[nodiscard]] std::optional<Picture> with(const Mistake& mistake) const;

    // Compares the passes of the run with all of `mistakes`, or of the correct run, with `candidate`.
    [[nodiscard]] std::optional<PassAgreement> compare_passes(std::span<const Mistake* const> mistakes,
                                                              const std::vector<PassPicture>& candidate) const;

  private:
    [[nodiscard]] AlteredRun altered_run() const;
    // Empty if one of the mistakes is not applicable.
    [[nodiscard]] std::optional<AlteredRun> altered_run(std::span<const Mistake* const> mistakes) const;
    [[nodiscard]] Picture run(const AlteredRun& experiment, RightRun* counted = nullptr) const;
    void find_enough_passes();

    peeling::FrameRequest input_;
    const peeling::Algorithm& algorithm_;
    Depths depths_;
    int limit_;
    RightRun right_run_;
    Picture right_;
};

// An image's colours, to be written to a file.
[[nodiscard]] pipeline::Image color_image(const Picture& picture);

// Applies a mistake of the finished image.
[[nodiscard]] Picture changed(const Picture& picture, const Mistake& mistake);

}  // namespace strata::oracle
