// tools/probe/archive.h - the files of a pack by name, from a folder or from a tar archive of one.
//
// Rule     POSIX ustar: blocks of 512 bytes, names of up to 100 bytes after a prefix of up to 155, sizes in octal
//          digits. A first folder that all names share is left out, as `tar xf` and a look inside would do.
// Tests    tests/tools/probe/pack_test.cpp
#pragma once
#include <map>
#include <string>

namespace strata::probe {

// Names with slashes. InputError for what is neither a folder nor such an archive.
[[nodiscard]] std::map<std::string, std::string> read_files(const std::string& path);

}  // namespace strata::probe
