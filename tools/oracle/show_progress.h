// tools/oracle/show_progress.h - how a long function of the oracle reports its progress.
#pragma once
#include <functional>

namespace strata::oracle {

// `share` is the finished part, 0 to 1. It is called from any thread, and may be empty.
using ShowProgress = std::function<void(double share)>;

}  // namespace strata::oracle
