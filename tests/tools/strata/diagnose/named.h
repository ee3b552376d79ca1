// tests/tools/strata/diagnose/named.h - the emulation that `strata diagnose` says a picture equals.
#pragma once
#include <string>

#include "tests/tools/program.h"

namespace strata::test {

// Its words, such as "front faces culled instead of back faces (culls_front)"; empty if the picture equals none.
[[nodiscard]] inline std::string named_emulation(const CommandResult& said) {
    for (const std::string& line : lines_of(said.out))
        for (const std::string begin : {"wrong: every pixel is that of: ", "  100 % of the pixels are those of: ",
                                        "right under other options: every pixel is that of: ",
                                        "  right under other options: every pixel is that of: "})
            if (line.starts_with(begin)) return line.substr(begin.size());
    return "";
}

}  // namespace strata::test
