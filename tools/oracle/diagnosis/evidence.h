// tools/oracle/diagnosis/evidence.h - the pixels of a candidate that agree with the images of a diagnosis; shared by
// diagnosis.cpp and mistake_pairs.cpp.
#pragma once
#include <functional>

#include "tools/oracle/diagnosis/diagnosis.h"

namespace strata::oracle {

using Agreement = std::vector<bool>;  // one entry per pixel

// Codes of colours that are accepted in addition to the tolerances, if both images have codes of one type.
enum class Forgiven : std::uint8_t { none, one_code };

// The pixels of the candidate that are equal to those of `picture`.
[[nodiscard]] Agreement agreement(const Picture& picture, const Picture& candidate, const Tolerances& tolerances,
                                  Forgiven beside = Forgiven::none);

struct MistakeImages::Evidence {
    const Picture& candidate;
    const Tolerances& tolerances;
    pipeline::ColorSpace space;  // of the images
    Agreement right_agrees{};
    std::vector<Agreement> agrees{};  // of each suspect that changes the image

    [[nodiscard]] Agreement agreement_of(const Picture& picture) const;
    [[nodiscard]] Finding of(std::vector<const Mistake*> mistakes, const Picture& picture) const;
};

// Of rendered pairs.
inline constexpr std::size_t most_pixels_of_pairs = std::size_t{1} << 21;

// Calls body(i) for all i below count, on all cores.
void for_all(std::size_t count, const ShowProgress& progress, const std::function<void(std::size_t)>& body);

}  // namespace strata::oracle
