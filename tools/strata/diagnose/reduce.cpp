// tools/strata/diagnose/reduce.cpp - strata reduce: the smallest scene on which somebody's renderer still goes wrong.
#include "tools/oracle/reduce/reduce.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "rasterizer/base/input_error.h"
#include "scenes/files/system_error.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"
#include "tools/strata/tolerances.h"

namespace strata::tools {

namespace {

struct ReduceOptions {
    std::string pack, command, ending = ".exr", output, algorithm;
    std::optional<oracle::RawLayout> layout{};
    bool json = false;
};

// A folder that goes with everything in it.
class OwnFolder {
  public:
    OwnFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "strata-reduce-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw SystemError(name, "make the folder", std::strerror(errno));
        path_ = name;
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
    ~OwnFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string with(std::string text, const std::string& word, const std::string& value) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
        text.replace(at, word.size(), value);
    return text;
}

// Runs the command on a pack of the scene. A command that fails has drawn nothing, whatever it left; of the user's own pack that is an error.
class Runner {
  public:
    explicit Runner(const ReduceOptions& options) : options_{options} {}

    // The user's own pack is there already, and may be large.
    void use(const std::string& pack) { given_ = pack; }

    std::optional<oracle::Picture> operator()(const oracle::Golden& scene) {
        const std::filesystem::path picture = folder_.path() / ("picture" + options_.ending);
        const std::string pack = given_.empty() ? (folder_.path() / "pack").string() : given_;
        if (given_.empty()) {
            std::filesystem::remove_all(pack);
            oracle::write_pack(scene, pack);
        }
        const bool is_first = !std::exchange(given_, {}).empty();
        std::filesystem::remove(picture);
        const std::string line = with(with(options_.command, "{pack}", pack), "{picture}", picture.string());
        const int status = std::system((line + " >/dev/null 2>&1").c_str());
        if (status == -1) throw SystemError(line, "start the command", std::strerror(errno));
        const std::string fault = !WIFEXITED(status)         ? fmt::format("signal {}", WTERMSIG(status))
                                  : WEXITSTATUS(status) != 0 ? fmt::format("exit status {}", WEXITSTATUS(status))
                                  : !std::filesystem::exists(picture) ? "exit status 0 and no picture"
                                                                      : "";
        if (!fault.empty() && is_first) throw InputError(line, "end", "exit status 0 and a picture", fault);
        if (!fault.empty()) return std::nullopt;
        return oracle::read_picture(picture.string(), options_.layout);
    }

  private:
    const ReduceOptions& options_;
    OwnFolder folder_;
    std::string given_;
};

int reduce(const ReduceOptions& options) {
    for (const char* word : {"{pack}", "{picture}"})
        if (options.command.find(word) == std::string::npos)
            throw CLI::ValidationError("COMMAND", fmt::format("expected {} in it, found '{}'", word, options.command));
    if (options.output.empty()) throw CLI::ValidationError("-o is missing: the folder for the pack");
    oracle::Golden scene = oracle::read_pack(options.pack);
    if (!options.algorithm.empty())
        std::erase_if(scene.algorithms, [&](const peeling::Algorithm* a) { return a->name != options.algorithm; });
    if (scene.algorithms.empty())
        throw CLI::ValidationError("--algorithm",
                                   "expected an algorithm of the pack, found '" + options.algorithm + "'");
    scene.algorithms.resize(1);
    Runner runner{options};
    runner.use(options.pack);
    const bool is_terminal = shows_progress();
    int runs = 0;
    const auto show = [&](const oracle::Golden& tried) {
        ++runs;
        if (is_terminal && runs > 1)
            std::fprintf(stderr, "\rrun %d: %zu meshes, %dx%d   ", runs, tried.scene.list.meshes.size(),
                         tried.options.width, tried.options.height);
    };
    const auto found = oracle::reduce(
        scene, [&](const oracle::Golden& tried) { return runner(tried); }, show);
    if (is_terminal && runs > 1) std::fprintf(stderr, "\r%40s\r", "");
    if (!found) {
        print("right: the command draws " + options.pack + " as it should be; there is nothing to reduce\n");
        return 1;
    }
    oracle::write_pack(found->scene, options.output);
    print(found->sentence() + '\n');
    return 0;
}

}  // namespace

Command add_reduce(CLI::App& root) {
    auto* app = root.add_subcommand("reduce", "make a scene small on which a renderer goes wrong: delta debugging");
    const auto options = std::make_shared<ReduceOptions>();
    app->add_option("PACK", options->pack, "a golden pack that the command draws wrong")->required()->type_name("");
    app->add_option("COMMAND", options->command,
                    "what draws {pack} into {picture}, for the shell; both words are replaced")
        ->required()
        ->type_name("");
    add_path(*app, options->output,
             {"-o,--output", "PACK", "gets the smallest pack that still fails", "a folder's name"});
    add_path(*app, options->algorithm,
             {"--algorithm", "NAME", "the one of the pack that the command runs (default: its first)", "a name"});
    add_path(*app, options->ending,
             {"--picture", "ENDING", "of {picture}: .exr, .png or .npy, or another one with --layout (default .exr)",
              "an ending"});
    add_layout_option(*app, options->layout);
    app->footer(
        "A command that ends with another exit status than 0, or leaves no picture, is an error on PACK itself; a "
        "smaller\n"
        "scene on which it does so is not taken. The kind of the failure (strata compare) stays.\n"
        "Examples:\n"
        "  strata golden showroom --size 32x32 --algorithm front_to_back -o room\n"
        "  strata reduce room \"strata render {pack} --algorithm front_to_back --mistake one_pass_too_few -o "
        "{picture}\" "
        "-o small\n"
        "Exit status: 0 reduced, 1 nothing to reduce, 2 bad input or usage, 3 the system failed, 130 interrupted.");
    return {app, [options] { return reduce(*options); }};
}

}  // namespace strata::tools
