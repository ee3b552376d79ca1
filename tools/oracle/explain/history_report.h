// tools/oracle/explain/history_report.h - the history of a pixel as text, as JSON from which it can be repeated, and as
// a drawing.
#pragma once
#include <span>

#include "tools/oracle/explain/history.h"

namespace strata::oracle {

[[nodiscard]] std::string to_text(const History& history);
// Outputs of programs are 32-bit words in hexadecimal; all other bits are integers. One object, on one line.
[[nodiscard]] std::string to_json(const History& history);
// A document with several histories and their differences.
[[nodiscard]] std::string to_json(std::span<const History> histories);
// A section for each sample, and the resolved pixel. In JSON a document with the histories of all samples.
[[nodiscard]] std::string to_text(const SampledHistory& history);
[[nodiscard]] std::string to_json(std::span<const SampledHistory> histories);
// The per-pixel list of fragments, near at the top, and one column per algorithm: the fragments it took, from which
// end, in which pass.
[[nodiscard]] std::string to_svg(std::span<const History> histories);

// For each further algorithm, the first place where it composites other fragments than the first algorithm, as text;
// and whether the images differ.
[[nodiscard]] std::vector<std::string> first_differences(std::span<const History> histories);
// Of each sample.
[[nodiscard]] std::vector<std::string> first_differences(std::span<const SampledHistory> histories);

}  // namespace strata::oracle
