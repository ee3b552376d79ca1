// tools/oracle/history_report.h - the history of a pixel in words, as JSON that is enough to do it again, and as a
// drawing.
#pragma once
#include <span>

#include "tools/oracle/history.h"

namespace strata::oracle {

[[nodiscard]] std::string to_text(const History& history);
// Colours that programs give out are 32-bit words in hexadecimal; all else that has bits has them as integers. One
// object, on one line.
[[nodiscard]] std::string to_json(const History& history);
// A document with several of them, and where they part ways.
[[nodiscard]] std::string to_json(std::span<const History> histories);
// The column of fragments, near at the top, a column an algorithm: what each took, from which end, in which pass.
[[nodiscard]] std::string to_svg(std::span<const History> histories);

// Where each further algorithm composites other fragments than the first, as sentences; and whether the pictures
// differ.
[[nodiscard]] std::vector<std::string> partings(std::span<const History> histories);

}  // namespace strata::oracle
