// tools/lab/sweep/lock.h - a lock file that prevents two runs from writing the same journal.
//
// Rule     A run holds the lock file `.NAME.lock` in the folder of the journal NAME (flock). The kernel releases the
//          flock when the process exits or is killed, so a leftover lock file is harmless.
// Tests    tests/tools/sweep_lock_test.cpp
#pragma once
#include <string>

namespace strata::tools {

class Lock {
  public:
    // Throws InputError with the process and host that hold the lock. If the file system does not support flock, warns
    // and continues unlocked.
    explicit Lock(const std::string& journal);
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock();

  private:
    std::string path_;
    int descriptor_ = -1;
    int slot_ = -1;  // slot in scenes/files/unfinished_files.h; -1: the file system has no locks
};

}  // namespace strata::tools
