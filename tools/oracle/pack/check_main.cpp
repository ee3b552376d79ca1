// tools/oracle/pack/check_main.cpp - strata_pack_check PACK...: checks golden packs on every available instruction set,
// without the command's libraries. For builds with other compilers; called by check_elsewhere.sh.
#include <fmt/format.h>

#include <exception>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/simd.h"
#include "tools/oracle/pack/golden.h"

namespace {

// The number of files that differ from the derived ones.
std::size_t check(const std::string& pack) {
    std::size_t faults = 0;
    for (const strata::Simd simd : strata::available_simd()) {
        const auto found = strata::oracle::check_pack(pack, simd);
        for (const strata::oracle::PackFault& fault : found) fmt::print("{}/{}: {}\n", pack, fault.file, fault.message);
        fmt::print("{}, {}: {}\n", pack, strata::enum_name(simd),
                   found.empty() ? "every file is what is derived here" : "differs");
        faults += found.size();
    }
    return faults;
}

}  // namespace

int main(int count, char** words) {
    try {
        std::size_t faults = 0;
        for (int i = 1; i < count; ++i) faults += check(words[i]);
        return count < 2 ? 2 : faults == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "strata_pack_check: {}\n", error.what());
        return 2;
    }
}
