#include "tools/strata/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace strata::tools {

Progress::Progress(std::string label)
    : label_{std::move(label)}, is_terminal_{isatty(STDERR_FILENO) == 1}, start_{std::chrono::steady_clock::now()} {}

Progress::~Progress() {
    if (shown_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown_), "");
}

void Progress::show(double share) {
    if (!is_terminal_) return;
    const std::lock_guard lock(mutex_);
    const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100);
    if (percent <= percent_ || std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
    percent_ = percent;
    constexpr int bar_width = 30;
    const auto filled = static_cast<std::size_t>(percent * bar_width / 100);
    const std::string line = label_ + " [" + std::string(filled, '=') + std::string(bar_width - filled, ' ') + "] " +
                             std::to_string(percent) + "%";
    shown_ = std::max(shown_, line.size());
    std::fprintf(stderr, "\r%s", line.c_str());
    std::fflush(stderr);
}

}  // namespace strata::tools
