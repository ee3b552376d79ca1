// tests/mutants/listener.cpp - writes to STRATA_REACHED, a line a test case: its name, its file, its seconds and the changes that it
// reached.
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <fstream>

#include "mutants/mutant.h"

namespace {

class ReachedListener : public Catch::TestEventListenerBase {
  public:
    using TestEventListenerBase::TestEventListenerBase;

    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        TestEventListenerBase::testCaseStarting(info);
        std::memset(strata_mutants::reached, 0, sizeof strata_mutants::reached);
        start_ = std::chrono::steady_clock::now();
    }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        const char* const path = std::getenv("STRATA_REACHED");
        if (path == nullptr) return;
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
        std::ofstream file{path, std::ios::app};
        file << stats.testInfo.name << '\t' << stats.testInfo.lineInfo.file << '\t' << taken.count() << '\t';
        for (int n = 0; n < strata_mutants::most; ++n)
            if (strata_mutants::reached[n] != 0) file << n << ' ';
        file << '\n';
    }

  private:
    std::chrono::steady_clock::time_point start_{};
};

CATCH_REGISTER_LISTENER(ReachedListener)

}  // namespace
