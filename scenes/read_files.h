// scenes/read_files.h - the files that a command has read, so that it does not replace one of them.
//
// Rule     A command that writes a result over its own scene, texture, picture, profile or pack destroys what its user
//          made. After protect_read_files() every file that the scenes library reads is remembered by device and inode,
//          and AtomicFile refuses to replace one of them. The folder of a pack is remembered, too: its manifest lists
//          all files in it, so another file would spoil it. A library does not protect: a program may read a file,
//          change its values and write it again.
// Tests    tests/scenes/read_files_test.cpp, tests/tools/strata/render/output_test.cpp
#pragma once
#include <string>

namespace strata::scenes {

// From now on, for the rest of the process.
void protect_read_files() noexcept;

// Called by every function that reads a named file; does nothing unless files are protected, or if there is no file.
void note_read_file(const std::string& path);
// Called by commands that are given a pack.
void note_read_pack(const std::string& folder);

// InputError if writing `path` would replace a file that was read, or add one to a pack that was read. A symbolic link
// is not its target: replacing it leaves the target as it is.
void check_not_read(const std::string& path);

}  // namespace strata::scenes
