// tools/lab/sweep/lock.h - one run at a time writes to a journal.
//
// Rule     A run holds the lock file `.NAME.lock` beside the journal NAME (flock). The system lets go of the lock when
//          the process ends, however it ends: a lock file that is not held means nothing.
// Tests    tests/tools/sweep_lock_test.cpp
#pragma once
#include <string>

namespace strata::tools {

class Lock {
  public:
    // Throws InputError, with process and host of the run that holds it. A file system without locks is a warning.
    explicit Lock(const std::string& journal);
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock();

  private:
    std::string path_;
    int descriptor_ = -1;
    int place_ = -1;  // in the table of files that a signal removes
};

}  // namespace strata::tools
