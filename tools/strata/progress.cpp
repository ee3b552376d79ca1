#include "tools/strata/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/strata/messages.h"

namespace strata::tools {

Progress::Progress(std::string label, Remaining remaining)
    : label_{std::move(label)},
      remaining_{remaining},
      is_shown_{shows_progress()},
      start_{std::chrono::steady_clock::now()} {}

Progress::~Progress() {
    // Overwrites the line with spaces and returns to its beginning.
    if (shown_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown_), "");
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    say_detail(label_ + ": " + seconds_text(passed.count()));
}

void Progress::show(double share) {
    if (!is_shown_) return;
    const std::lock_guard lock(mutex_);
    const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    // The bar never moves back, although threads may report their fractions out of order.
    if (percent <= percent_ || passed.count() < 1) return;
    percent_ = percent;
    constexpr int bar_width = 30;
    const auto filled = static_cast<std::size_t>(percent * bar_width / 100);
    std::string line = label_ + " [" + std::string(filled, '=') + std::string(bar_width - filled, ' ') + "] " +
                       std::to_string(percent) + "%";
    if (remaining_ == Remaining::shown && share > 0)
        line += ", " + std::to_string(std::lround(passed.count() * (1 - share) / share)) + " s left";
    // Padded to the longest line so far, to overwrite all of that one.
    line.resize(std::max(line.size(), shown_), ' ');
    shown_ = std::max(shown_, line.size());
    std::fprintf(stderr, "\r%s", line.c_str());
    std::fflush(stderr);
}

}  // namespace strata::tools
