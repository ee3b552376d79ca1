// Tests packs of answers: ustar archives are built by hand (POSIX pax, ustar header block) and the files of written
// packs are edited.
#include "tools/lab/probe/files/pack.h"

#include <bit>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "scenes/packs/npy.h"
#include "tests/support/own_folder.h"
#include "tools/lab/probe/files/archive.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/search/comparison.h"

using namespace strata;
using namespace strata::probe;

namespace {

// Kit scenes for d16, d24, d32f and rgba16f; some have no depth buffer.
std::vector<Item> some_items() {
    std::vector<Item> items;
    for (const Item& item : kit())
        if (item.name == "coverage.ties" || item.name == "depth.d24" || item.name == "depth.d16" ||
            item.name == "color.halves" || item.name == "offset.d32f")
            items.push_back(item);
    return items;
}

// One ustar member: a 512-byte header, then the content padded to 512 bytes.
std::string tar_entry(const std::string& name, const std::string& content) {
    std::string header(512, '\0');
    header.replace(0, name.size(), name);
    std::string size(11, '0');
    std::size_t rest = content.size();
    for (std::size_t i = 11; i-- > 0; rest /= 8) size[i] = static_cast<char>('0' + rest % 8);
    header.replace(124, 11, size);
    header[156] = '0';
    header.replace(257, 5, "ustar");
    std::string padded = content;
    padded.resize((content.size() + 511) / 512 * 512, '\0');
    return header + padded;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream{path, std::ios::binary} << text;
}

}  // namespace

TEST_CASE("answers and rejections and device features are unchanged after writing and reading a pack") {
    const strata::test::OwnFolder folder;
    const std::vector<Item> items = some_items();
    const ProbePack written = answer(*pipeline::find_profile("geforce3"), items, {YDirection::up, YDirection::down});
    const std::string path = folder.path() + "/pack";
    write_pack(written, items, path);
    const ProbePack read = read_pack(path, items);
    CHECK(read.made_by == written.made_by);
    CHECK(nlohmann::json::parse(read.device.dump()) == nlohmann::json::parse(written.device.dump()));
    for (const auto& [y, answers] : written.answers)
        for (const auto& [name, reply] : answers) {
            INFO(name);
            const Reply& other = read.answers.at(y).at(name);
            CHECK(other.answer == reply.answer);
            CHECK(other.refusal == reply.refusal);
        }
}

TEST_CASE("a 24-bit depth image read as binary32 becomes d24 if every texel is nearest to a code and else d32f") {
    const strata::test::OwnFolder folder;
    const std::vector<Item> items = some_items();
    for (const bool holds_floats : {false, true}) {
        pipeline::DeviceProfile device = *pipeline::find_profile("swiftshader");
        device.depth24 = holds_floats ? pipeline::Depth24::binary32 : pipeline::Depth24::codes;
        ProbePack pack = answer(device, items, {YDirection::down});
        const ProbePack drawn = pack;
        // A page reads depth through a shader, which returns a float for either storage format.
        pipeline::Image& depth = *pack.answers[YDirection::down]["depth.d24"].answer->depth;
        pipeline::Image texels{pipeline::Format::d32f, depth.width, depth.height};
        for (std::size_t i = 0; i < depth.codes.size(); ++i) {
            const float value = static_cast<float>(depth.codes[i] / 16777215.0);
            texels.codes[i] = holds_floats ? depth.codes[i] : std::bit_cast<std::uint32_t>(value);
        }
        depth = texels;
        const std::string path = folder.path() + (holds_floats ? "/floats" : "/codes");
        write_pack(pack, items, path);
        const ProbePack read = read_pack(path, items);
        for (const auto& [name, reply] : drawn.answers.at(YDirection::down)) {
            INFO(name);
            CHECK(read.answers.at(YDirection::down).at(name).answer == reply.answer);
        }
        // Drawn by a profile with a binary32 depth buffer: if the pack holds codes, its floats are converted to the
        // nearest codes before the comparison.
        const KitComparison held{read, items, YDirection::down};
        pipeline::DeviceProfile floats = device;
        floats.depth24 = pipeline::Depth24::binary32;
        for (const std::size_t i : held.items_of({"depth.d24"})) {
            const Reply again = held.drawn(floats, i);
            CHECK(again.answer->depth->format == (holds_floats ? pipeline::Format::d32f : pipeline::Format::d24));
            const std::uint64_t differ = difference(held.answer(i), *again.answer).depth;
            CHECK((!holds_floats || differ == 0));
        }
    }
}

TEST_CASE("a tar of a pack is read like the folder with or without a leading folder in the member names") {
    const strata::test::OwnFolder folder;
    for (const std::string prefix : {"", "answers/"}) {
        const std::string bytes = tar_entry(prefix + "candidate.json", "{}") +
                                  tar_entry(prefix + "probe/up/a/color.npy", std::string(700, 'x')) +
                                  std::string(1024, '\0');
        write_text(folder.path() + "/pack.tar", bytes);
        const auto files = read_files(folder.path() + "/pack.tar");
        REQUIRE(files.size() == 2);
        CHECK(files.at("candidate.json") == "{}");
        CHECK(files.at("probe/up/a/color.npy") == std::string(700, 'x'));
    }
}

TEST_CASE("a truncated tar and a file that is not a tar are rejected with the offset of the error") {
    const strata::test::OwnFolder folder;
    const std::string path = folder.path() + "/pack.tar";
    write_text(path, tar_entry("a", std::string(700, 'x')).substr(0, 1024));
    CHECK_THROWS_WITH(read_files(path),
                      path + ": byte 124: expected a file that ends within the archive, found 700 bytes");
    write_text(path, std::string(600, 'q'));
    CHECK_THROWS_WITH(read_files(path),
                      path + ": byte 0: expected a header of a tar archive (ustar), found another text");
}

TEST_CASE("depths read by a shader are converted to the nearest codes") {
    const strata::test::OwnFolder folder;
    const std::vector<Item> items = some_items();
    const ProbePack written = answer(*pipeline::find_profile("ideal"), items, {YDirection::up});
    const std::string path = folder.path() + "/pack";
    write_pack(written, items, path);
    for (const std::string name : {"depth.d24", "depth.d16"}) {
        const pipeline::Image& codes = *written.answers.at(YDirection::up).at(name).answer->depth;
        const double greatest = name == "depth.d24" ? 16777215.0 : 65535.0;
        scenes::NumberArray texels{
            .element = scenes::Element::f4,
            .shape = {static_cast<std::size_t>(codes.height), static_cast<std::size_t>(codes.width)}};
        for (const std::uint32_t code : codes.codes)
            texels.append(std::bit_cast<std::uint32_t>(static_cast<float>(code / greatest)));
        write_text(folder.path() + "/pack/probe/up/" + name + "/depth.npy", scenes::to_npy(texels));
    }
    const ProbePack read = read_pack(path, items);
    for (const std::string name : {"depth.d24", "depth.d16"})
        CHECK(read.answers.at(YDirection::up).at(name).answer == written.answers.at(YDirection::up).at(name).answer);
}

TEST_CASE("answers with a missing picture or a link or another version are rejected by name") {
    const strata::test::OwnFolder folder;
    const std::vector<Item> items = some_items();
    const ProbePack written = answer(*pipeline::find_profile("llvmpipe"), items, {YDirection::up});
    const std::string path = folder.path() + "/pack", picture = path + "/probe/up/depth.d24/color.npy";
    const auto message = [&]() -> std::string {
        try {
            static_cast<void>(read_pack(path, items));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    write_pack(written, items, path);
    CHECK(message() == "");
    std::filesystem::rename(picture, folder.path() + "/elsewhere.npy");
    CHECK(message() == path + ": probe/up/depth.d24/color.npy: expected the picture of a scene, or the reason in " +
                           "/probe/missing why there is none, found neither");
    std::filesystem::create_symlink(folder.path() + "/elsewhere.npy", picture);
    CHECK(message() == path + ": probe/up/depth.d24/color.npy: expected a file inside this folder, found a link");
    std::filesystem::remove(picture);
    std::filesystem::rename(folder.path() + "/elsewhere.npy", picture);
    std::ifstream file{path + "/candidate.json"};
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string version = "\"version\": 1";
    REQUIRE(text.find(version) != std::string::npos);
    write_text(path + "/candidate.json", text.replace(text.find(version), version.size(), "\"version\": 2"));
    CHECK(message() == path + "/candidate.json: /version: expected 1, the version that this program reads, found 2");
}

TEST_CASE("answers to another kit are rejected because its digest differs") {
    const strata::test::OwnFolder folder;
    std::vector<Item> items = some_items();
    const std::string path = folder.path() + "/pack";
    write_pack(answer(*pipeline::find_profile("ideal"), items, {YDirection::up}), items, path);
    items.pop_back();
    CHECK_THROWS_AS(read_pack(path, items), InputError);
}
