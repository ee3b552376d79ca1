// tools/oracle/pack/result_json.h - writes an object of "results" in a pack: image, layers and passes of one algorithm.
#pragma once
#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

[[nodiscard]] nlohmann::ordered_json result_json(const Golden& golden, const peeling::Algorithm& algorithm,
                                                 scenes::PackFiles& files);

}  // namespace strata::oracle
