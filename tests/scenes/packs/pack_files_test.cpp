// Tests the checksums of pack files on every change of one byte of a small file.
#include "scenes/packs/pack_files.h"

#include <catch2/catch.hpp>
#include <random>

using namespace strata::scenes;

TEST_CASE("two sums identify the byte of a file that changed and its old value") {
    std::mt19937 random{5};
    std::string file;
    for (int i = 0; i < 300; ++i) file += static_cast<char>(random() & 0xff);
    const ByteSums sums = sums_of(file);
    CHECK_FALSE(changed_byte(file, sums));
    int wrong = 0;
    for (std::size_t i = 0; i < file.size(); ++i)
        for (int value = 0; value < 256; ++value) {
            std::string other = file;
            other[i] = static_cast<char>(value);
            if (other[i] == file[i]) continue;
            const auto found = changed_byte(other, sums);
            const bool is_right = found && found->position == i && found->is == value &&
                                  found->was == static_cast<unsigned char>(file[i]);
            wrong += is_right ? 0 : 1;
        }
    CHECK(wrong == 0);
    std::string two = file;
    two[3] = static_cast<char>(two[3] ^ 1);
    two[250] = static_cast<char>(two[250] ^ 64);
    const auto guess = changed_byte(two, sums);
    // The sums of two changes may look like those of one: the digest then shows that the guess is wrong.
    if (guess) {
        two[guess->position] = static_cast<char>(guess->was);
        CHECK(digest_of_bytes(two) != digest_of_bytes(file));
    }
}
