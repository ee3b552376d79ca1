// tools/oracle/mistakes/laboratory.h - makes pictures of one scene: the right one, and those of machines with mistakes.
//
// Rule     A picture has the colours as stored, and the nearest depth as stored where the caller wants depths. A wrong
//          machine may never end: it gets the passes of the limit that the caller knows; else twice those of the right
//          run, and eight, or as many, where the right run is endless itself. What a machine refuses, or cannot run, is
//          no picture.
// Tests    tests/tools/oracle/mistakes/laboratory_test.cpp
#pragma once
#include <optional>
#include <span>

#include "tools/oracle/mistakes/experiment.h"
#include "tools/oracle/mistakes/pass_evidence.h"
#include "tools/oracle/passes.h"

namespace strata::oracle {

struct Mistake;  // tools/oracle/mistakes/catalogue.h

enum class Depths : std::uint8_t { left_out, made };

class Laboratory {
  public:
    // Throws Refused where the right run is refused. What `input` refers to must live as long.
    // `limit`: the geometry passes after which the candidate gives up; 0: not known.
    Laboratory(const RunInput& input, const peeling::Algorithm& algorithm, Depths depths = Depths::left_out,
               int limit = 0);

    [[nodiscard]] const Picture& right() const noexcept { return right_; }
    [[nodiscard]] const RightRun& right_run() const noexcept { return right_run_; }

    // All of `mistakes` together, made in their order. Nothing where one of them cannot be made. From any thread.
    [[nodiscard]] std::optional<Picture> with(std::span<const Mistake* const> mistakes) const;
    [[nodiscard]] std::optional<Picture> with(const Mistake& mistake) const;

    // How far the passes of the machine with all of `mistakes`, or of the right one, are `candidate`'s.
    [[nodiscard]] std::optional<PassAgreement> compare_passes(std::span<const Mistake* const> mistakes,
                                                              const std::vector<PassPicture>& candidate) const;

  private:
    [[nodiscard]] Experiment experiment() const;
    [[nodiscard]] std::optional<Experiment> experiment(std::span<const Mistake* const> mistakes) const;
    [[nodiscard]] Picture run(const Experiment& experiment, RightRun* counted = nullptr) const;
    void find_enough_passes();

    RunInput input_;
    const peeling::Algorithm& algorithm_;
    Depths depths_;
    int limit_;
    RightRun right_run_;
    Picture right_;
};

// A picture's colours as an image to be written.
[[nodiscard]] pipeline::Image color_image(const Picture& picture);

// What a mistake of the finished picture makes of one.
[[nodiscard]] Picture changed(const Picture& picture, const Mistake& mistake);

}  // namespace strata::oracle
