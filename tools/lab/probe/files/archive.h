// tools/lab/probe/files/archive.h - reads the files of a pack by name, from a folder or a tar archive.
//
// Rule     POSIX ustar: blocks of 512 bytes, names of up to 100 bytes after a prefix of up to 155, sizes in octal
//          digits. A leading folder that all names share is removed.
// Tests    tests/tools/lab/probe/pack_test.cpp
#pragma once
#include <map>
#include <string>

namespace strata::probe {

// Names contain slashes. InputError if the path is neither a folder nor such an archive.
[[nodiscard]] std::map<std::string, std::string> read_files(const std::string& path);

}  // namespace strata::probe
