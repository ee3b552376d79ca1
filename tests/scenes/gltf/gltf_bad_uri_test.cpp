// Tests that a scene reads the files of its own folder and nothing else. A file outside exists in each case, so that
// following the uri would succeed.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
namespace fs = std::filesystem;

// outside.bin and scene/{inside.bin, folder/, link -> ../outside.bin, inner -> inside.bin, up -> ..}, deleted at the
// end.
class Folder {
  public:
    Folder() : root_{fs::temp_directory_path() / ("strata_gltf_uri_" + std::to_string(::getpid()))} {
        fs::remove_all(root_);
        fs::create_directories(root_ / "scene" / "folder");
        write(root_ / "outside.bin", file_.bin);
        write(root_ / "scene" / "inside.bin", file_.bin);
        write(root_ / "scene" / "a b.bin", file_.bin);
        fs::create_symlink("../outside.bin", root_ / "scene" / "link");
        fs::create_symlink("inside.bin", root_ / "scene" / "inner");
        fs::create_symlink("..", root_ / "scene" / "up");
        fs::create_symlink("loop", root_ / "scene" / "loop");
    }
    ~Folder() { fs::remove_all(root_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] fs::path root() const { return root_; }
    [[nodiscard]] std::string refusal_of(const std::string& uri) const {
        Json document = file_.json;
        document["buffers"] = Json::array({{{"byteLength", file_.bin.size()}, {"uri", uri}}});
        const fs::path path = root_ / "scene" / "scene.gltf";
        write(path, to_bytes(document.dump()));
        try {
            (void)strata::scenes::load_gltf(path.string(), {});
        } catch (const strata::InputError& error) {
            return error.what();
        }
        return "";
    }

  private:
    static GltfFile triangle() {
        GltfFile file;
        file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
        return file;
    }
    static void write(const fs::path& path, const ByteVector& bytes) {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }

    GltfFile file_ = triangle();
    fs::path root_;
};

void check_refused(const std::string& message, const std::string& code) {
    INFO(message);
    CHECK(message.find(": /buffers/0/uri: expected ") != message.npos);
    CHECK(message.ends_with(" [" + code + "]"));
}

}  // namespace

TEST_CASE("a uri gives access only to files in the scene's folder and never to a folder") {
    const Folder folder;
    for (const char* uri :
         {"inside.bin", "./inside.bin", "inner", "a%20b.bin", "a b.bin", "folder/.//inside.bin/../x"}) {
        INFO(uri);
        CHECK(folder.refusal_of(uri).empty() == (std::string(uri) != "folder/.//inside.bin/../x"));
    }
    const std::string outside = (folder.root() / "outside.bin").string();
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("folder/../../outside.bin"), std::string("%2e%2e/outside.bin"),
          std::string("..%2Foutside.bin"), outside, "%2F" + outside.substr(1), "file://" + outside, "FILE:" + outside,
          std::string("http://localhost/x.bin"), std::string("C:\\x.bin"), std::string("up/outside.bin"),
          std::string("link")})
        check_refused(folder.refusal_of(uri), "NON_RELATIVE_URI");
    for (const char* uri : {"", "inside.bin?x", "inside.bin#x", "in%side.bin", "inside.bi%6", "inside.bin%00",
                            "inside\n.bin", "folder\\x"})
        check_refused(folder.refusal_of(uri), "INVALID_URI");
    for (const char* uri : {"missing.bin", "folder", ".", "folder/", "loop", "inside.bin/x"})
        check_refused(folder.refusal_of(uri), "FILE_NOT_FOUND");
}

TEST_CASE("a data uri must have base64 data of the right kind") {
    const Folder folder;
    for (const char* uri :
         {"data:", "data:,abc", "data:application/octet-stream,abc", "data:application/octet-stream;base64,ab!d",
          "data:application/octet-stream;base64,abcde", "data:application/octet-stream;base64,ab=d"})
        check_refused(folder.refusal_of(uri), "INVALID_URI");
    check_refused(folder.refusal_of("data:text/plain;base64,AAAA"), "BUFFER_DATA_URI_MIME_TYPE_INVALID");
    CHECK(folder.refusal_of("data:application/gltf-buffer;base64,AAAA")
              .ends_with("[BUFFER_EXTERNAL_BYTELENGTH_MISMATCH]"));
}

TEST_CASE("a scene that is not a regular file is rejected and one in memory opens no file") {
    for (const char* path : {"/", "/dev/zero", "/nowhere/scene.gltf", ""}) {
        INFO(path);
        CHECK_THROWS_AS(strata::scenes::load_gltf(path, {}), strata::InputError);
    }
    Json document = everything().document();
    document["buffers"][0]["uri"] = "inside.bin";
    CHECK(refusal(to_bytes(document.dump())).ends_with("[FILE_NOT_FOUND]"));
}
