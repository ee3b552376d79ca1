// tools/strata/diagnose/reduce.cpp - strata reduce: finds the smallest scene for which a user's renderer still produces
// a wrong picture.
#include "tools/oracle/reduce/reduce.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "rasterizer/base/input_error.h"
#include "scenes/files/system_error.h"
#include "scenes/files/unfinished_files.h"
#include "scenes/packs/new_folder.h"
#include "scenes/packs/pack_scene.h"
#include "scenes/read_files.h"
#include "tools/request/choices.h"
#include "tools/strata/command.h"
#include "tools/strata/compare/tolerances.h"
#include "tools/strata/diagnose/shell_command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/shell_words.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

const std::vector<Choice<oracle::FrameExtent>> frames{{"cut", oracle::FrameExtent::cut},
                                                      {"whole", oracle::FrameExtent::whole}};

struct ReduceOptions {
    std::string pack, command, ending = ".exr", output, algorithm;
    std::optional<oracle::RawLayout> layout{};
    oracle::ReduceRules rules{};
    double seconds = 600;  // time limit of each execution of the command
};

// A temporary folder. It is deleted with its contents by the destructor, or by the signal handler if a signal ends the
// process. Its path needs no quotes in a shell, so it can replace a word of a command line.
class OwnFolder {
  public:
    OwnFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "strata-reduce-XXXXXX").string();
        if (shell_word(name) != name)
            throw InputError("TMPDIR", "folder", "a name without blanks and other characters that a shell reads",
                             "'" + name + "'");
        if (mkdtemp(name.data()) == nullptr) throw SystemError(name, "make the folder", std::strerror(errno));
        path_ = name;
        slot_ = scenes::enter_unfinished_folder(name);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
    ~OwnFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
        scenes::forget_unfinished_file(slot_);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int slot_ = 0;
};

std::string with(std::string text, const std::string& word, const std::string& value) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
        text.replace(at, word.size(), value);
    return text;
}

// Describes the failure of an execution; empty if it produced a picture.
std::string fault_of(const EndOfCommand& end, double seconds, bool has_picture) {
    switch (end.way) {
        case EndOfCommand::Way::timed_out: return fmt::format("no end within {} s (--timeout)", seconds);
        case EndOfCommand::Way::killed: return fmt::format("signal {}", end.number);
        case EndOfCommand::Way::exited: break;
    }
    if (end.number != 0) return fmt::format("exit status {}", end.number);
    return has_picture ? "" : "exit status 0 and no picture";
}

// Runs the command on a pack of the scene. A failed command counts as having no picture, whatever it wrote; if it fails
// on the user's own pack, that is an error.
class Runner {
  public:
    explicit Runner(const ReduceOptions& options) : options_{options} {}

    // Links to the user's own pack, which may be large and may have any name.
    void use(const std::string& pack) {
        std::filesystem::create_directory_symlink(std::filesystem::canonical(scenes::pack_folder(pack)),
                                                  folder_.path() / "pack");
        has_given_ = true;
    }

    std::optional<oracle::Picture> operator()(const oracle::Golden& scene) {
        const std::filesystem::path picture = folder_.path() / ("picture" + options_.ending);
        const std::string pack = (folder_.path() / "pack").string();
        const bool is_first = std::exchange(has_given_, false);
        if (!is_first) {
            std::filesystem::remove_all(pack);  // removes a link, but not its target
            oracle::write_pack(scene, pack);
        }
        std::filesystem::remove_all(picture);
        const std::string line = with(with(options_.command, "{pack}", pack), "{picture}", picture.string());
        const EndOfCommand end = run_in_shell(line, options_.seconds);
        const std::string fault = fault_of(end, options_.seconds, std::filesystem::exists(picture));
        if (!fault.empty() && is_first) throw InputError(options_.command, "end", "exit status 0 and a picture", fault);
        if (!fault.empty()) return std::nullopt;
        return oracle::read_picture(picture.string(), options_.layout);
    }

  private:
    const ReduceOptions& options_;
    OwnFolder folder_;
    bool has_given_ = false;
};

int reduce(const ReduceOptions& options) {
    if (scenes::is_procedural(options.pack) || !scenes::is_pack(options.pack))
        throw CLI::ValidationError("PACK", "expected a pack's folder, which `strata golden " +
                                               (options.pack.empty() ? "SCENE" : shell_word(options.pack)) +
                                               " -o PACK` writes, found '" + options.pack + "'");
    for (const char* word : {"{pack}", "{picture}"})
        if (options.command.find(word) == std::string::npos)
            throw CLI::ValidationError("COMMAND", fmt::format("expected {} in it, found '{}'", word, options.command));
    if (options.output.empty()) throw CLI::ValidationError("-o is missing: the folder for the pack");
    if (!options.ending.starts_with('.') || options.ending.find('/') != std::string::npos ||
        shell_word(options.ending) != options.ending)
        throw CLI::ValidationError("--picture", "expected an ending such as .exr, found '" + options.ending + "'");
    scenes::note_read_pack(scenes::pack_folder(options.pack));
    scenes::check_new_folder(options.output);
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
        scene, [&](const oracle::Golden& tried) { return runner(tried); }, show, options.rules);
    if (is_terminal && runs > 1) std::fprintf(stderr, "\r%40s\r", "");
    if (!found) {
        const bool is_exact = options.rules.tolerances == oracle::Tolerances{};
        print("right: the command draws " + options.pack + " as it should be" +
              (is_exact ? "" : ", within the tolerance") + "; there is nothing to reduce\n");
        return 1;
    }
    oracle::write_pack(found->scene, options.output);
    print(found->description() + '\n');
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
    add_tolerance_option(*app, options->rules.tolerances);
    add_channels_option(*app, options->rules.tolerances);
    add_choice(
        *app, options->rules.frame, "--frame", frames,
        "a smaller window becomes a frame of its own (cut), or the frame stays whole and a scissor cuts it: for what "
        "shows at that size alone (default cut)");
    add_option(*app, options->seconds,
               {"--timeout", "SECONDS", "how long one run of the command may take; then it is killed (default 600)",
                "a number of seconds above 0, at most 86400"},
               [](std::string_view text) {
                   const auto seconds = to_number<double>(text);
                   return seconds && *seconds > 0 && *seconds <= 86400 ? seconds : std::nullopt;
               });
    app->footer(
        "A command that ends with another exit status than 0, leaves no picture or takes longer than --timeout is an "
        "error on\n"
        "PACK itself; a smaller scene on which it does so is not taken. The kind of the failure (strata compare) "
        "stays. Codes of\n"
        "--tolerance count in every scene, its pixels in PACK alone. The command is a process group of its own, which "
        "is killed with all\n"
        "that it started when the run or strata ends; it reads nothing, and what it prints is not shown.\n"
        "Examples:\n"
        "  strata golden showroom --size 32x32 --algorithm front_to_back -o room\n"
        "  strata reduce room \"strata render {pack} --algorithm front_to_back --mistake one_pass_too_few -o "
        "{picture}\" "
        "-o small\n"
        "Exit status: 0 reduced, 1 nothing to reduce, 2 bad input or usage, 3 the system failed, 130 interrupted.");
    return {app, [options] { return reduce(*options); }};
}

}  // namespace strata::tools
