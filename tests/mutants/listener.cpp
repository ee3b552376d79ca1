// tests/mutants/listener.cpp - appends a line per test case to the file STRATA_REACHED: its name, its file, its seconds
// of processor time and the changes that it reached.
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>
#include <cstring>
#include <ctime>
#include <fstream>

#include "mutants/mutant.h"

namespace {

class ReachedListener : public Catch::TestEventListenerBase {
  public:
    using TestEventListenerBase::TestEventListenerBase;

    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        TestEventListenerBase::testCaseStarting(info);
        std::memset(strata_mutants::reached, 0, sizeof strata_mutants::reached);
        start_ = std::clock();
    }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        const char* const path = std::getenv("STRATA_REACHED");
        if (path == nullptr) return;
        const double seconds = static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
        std::ofstream file{path, std::ios::app};
        file << stats.testInfo.name << '\t' << stats.testInfo.lineInfo.file << '\t' << seconds << '\t';
        for (int n = 0; n < strata_mutants::most; ++n)
            if (strata_mutants::reached[n] != 0) file << n << ' ';
        file << '\n';
    }

  private:
    std::clock_t start_ = 0;
};

CATCH_REGISTER_LISTENER(ReachedListener)

}  // namespace
