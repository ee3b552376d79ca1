// Tests packs that were changed: each is either read or rejected with one of the project's own exceptions that names
// the file and the position. Any other exception is a fault.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "peeling/registry.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "tests/support/own_folder.h"
#include "tests/support/random_numbers.h"
#include "tools/oracle/pack/golden.h"
#include "tools/oracle/pack/pack_pictures.h"

using namespace strata;
using namespace strata::oracle;
using nlohmann::json;

namespace {

struct Pack {
    test::OwnFolder folder{};
    std::string path = folder.path() + "/pack", file = path + "/manifest.json", manifest{};

    Pack() {
        Golden golden{.scene = scenes::load_scene("planes:count=1", {}),
                      .profile = *pipeline::find_profile("geforce8")};
        golden.options.width = golden.options.height = 4;
        golden.options.threads = 1;
        golden.scene.own_view = scenes::orbit_view(golden.scene.bounds, 30, 20, 1);
        golden.algorithms = {peeling::find_algorithm("front_to_back")};
        write_pack(golden, path);
        std::ifstream stream{file, std::ios::binary};
        manifest.assign(std::istreambuf_iterator<char>{stream}, {});
    }
    // The first reader that fails with another exception on this text, with its message; empty if there is none.
    [[nodiscard]] std::string fault_of(const std::string& text) const {
        std::ofstream{file, std::ios::binary} << text;
        const auto tried = [](const auto& read) -> std::string {
            try {
                read();
            } catch (const InputError& error) {
                return std::string{error.what()}.find(": expected ") == std::string::npos ? error.what() : "";
            } catch (const pipeline::Refused&) {
                return "";
            } catch (const std::exception& error) {
                return error.what();
            }
            return "";
        };
        return tried([&] { static_cast<void>(read_pack(path)); }) +
               tried([&] { static_cast<void>(expected_pictures(path)); }) +
               tried([&] { static_cast<void>(check_pack(path)); });
    }
};

}  // namespace

TEST_CASE("a manifest with one byte changed is read or rejected with an error message") {
    const Pack pack;
    REQUIRE(pack.fault_of(pack.manifest) == "");
    testing::Random random{41};
    std::string first;
    for (int trial = 0; trial < 150 && first.empty(); ++trial) {
        std::string text = pack.manifest;
        const auto at = static_cast<std::size_t>(testing::random_int(random, 0, static_cast<int>(text.size()) - 1));
        // Characters of JSON's syntax are more frequent than others.
        constexpr std::string_view signs = "[]{}\",:-.e019tn \\/";
        text[at] = trial % 3 == 0 ? static_cast<char>(testing::random_int(random, 0, 255))
                                  : signs[static_cast<std::size_t>(testing::random_int(random, 0, 17))];
        if (const std::string fault = pack.fault_of(text); !fault.empty()) first = std::to_string(at) + ": " + fault;
    }
    CHECK(first == "");
}

TEST_CASE("a manifest with a value of another type is read or rejected with an error message") {
    const Pack pack;
    const json right = json::parse(pack.manifest), flat = right.flatten();
    const json others[] = {nullptr,
                           true,
                           -1,
                           1e300,
                           "word",
                           json::array(),
                           json::object(),
                           json::array({json::array()}),
                           18446744073709551615u};
    std::set<std::string> places;  // JSON pointers of all values and of the objects and arrays around them
    for (const auto& [place, value] : flat.items())
        for (std::string rest = place; !rest.empty(); rest = rest.substr(0, rest.rfind('/'))) places.insert(rest);
    testing::Random random{42};
    std::string first;
    std::size_t number = 0;
    for (const std::string& place : places) {
        // All pointers near the root, and a random choice of the many below.
        if (std::count(place.begin(), place.end(), '/') > 4 && random() % 48 != 0) continue;
        json changed = right;
        changed[json::json_pointer{place}] = others[number++ % std::size(others)];
        if (const std::string fault = pack.fault_of(changed.dump()); !fault.empty() && first.empty())
            first = place + ": " + fault;
    }
    CHECK(first == "");
    CHECK(number > 100);
}
