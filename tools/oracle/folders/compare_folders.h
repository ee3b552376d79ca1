// tools/oracle/folders/compare_folders.h - compares the pictures of two folders, one name after the other.
//
// Rule     A candidate is compared with every reference of its name. The first one that it equals is kept, else the
//          first one that accepts it within the tolerances, else the one from which the fewest pixels differ. A picture
//          without a reference or without a candidate, of another size, or that cannot be read is a failed case. Cases
//          are taken in the order of names; only a fixed number of pictures is in memory at a time.
// Tests    tests/tools/oracle/folders/compare_folders_test.cpp, tests/tools/strata/compare/compare_folders_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/compare/compare.h"
#include "tools/oracle/folders/picture_folders.h"
#include "tools/oracle/show_progress.h"

namespace strata::oracle {

enum class CaseState : std::uint8_t { equal, accepted, different, other_size, missing, extra, unreadable };
inline constexpr std::size_t case_state_count = 7;
// "other size"
[[nodiscard]] std::string_view name(CaseState state) noexcept;

// A small picture of a failed case, as a PNG file.
struct CasePicture {
    std::string png, words;
};

struct FolderCase {
    std::string name{};
    CaseState state = CaseState::equal;
    std::string reference{}, candidate{};    // paths in the folders; empty: there is none
    std::size_t references = 0;              // number of pictures that were accepted under this name
    std::string sentence{};                  // what is wrong, or differs; empty if the pictures are equal
    std::optional<Comparison> comparison{};  // without what is kept of every pixel; empty: none was possible
    std::vector<CasePicture> pictures{};
    [[nodiscard]] bool is_accepted() const noexcept {
        return state == CaseState::equal || state == CaseState::accepted;
    }
};

struct FolderQuestion {
    std::string reference{}, candidate{};
    PictureNames names{};
    Tolerances tolerances{};
    Background background{};
    // How a file becomes a picture.
    std::function<Picture(const std::string&path)> read_reference{}, read_candidate{};
    bool has_pictures = false;  // failed cases get small pictures
    ShowProgress progress{};
};

struct FolderSummary {
    std::array<std::size_t, case_state_count> cases{};
    std::size_t left_out = 0;  // files that are no pictures
    [[nodiscard]] std::size_t of(CaseState state) const noexcept { return cases[static_cast<std::size_t>(state)]; }
    [[nodiscard]] std::size_t all() const noexcept;
    [[nodiscard]] std::size_t failed() const noexcept { return all() - of(CaseState::equal) - of(CaseState::accepted); }
};

// Calls `take` for each case, in the order of names, from one thread. InputError as pair_folders().
FolderSummary compare_folders(const FolderQuestion& question, const std::function<void(FolderCase&&)>& take);

}  // namespace strata::oracle
