#include "tools/strata/sweep/journal.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "rasterizer/base/input_error.h"
#include "scenes/files/system_error.h"
#include "scenes/files/text_file.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// `number` counts from 0, the message from 1.
ordered_json parse_line(const std::string& path, std::size_t number, const std::string& text) {
    auto line = ordered_json::parse(text, nullptr, false);
    if (!line.is_object())
        throw InputError(path, fmt::format("line {}", number + 1), "one JSON object", "'" + text.substr(0, 40) + "'");
    return line;
}

// Every key that the plan knows beforehand must be there with the same value. JSON text is
// compared: numbers are written in one form.
void check_line(const std::string& path, std::size_t number, const ordered_json& line, const ordered_json& expected) {
    for (const auto& [key, value] : expected.items()) {
        const std::string found = line.contains(key) ? line[key].dump() : "nothing";
        if (found != value.dump())
            throw InputError(path, fmt::format("line {}: {}", number + 1, key),
                             value.dump() + ", as the plan has it (another plan needs another folder)", found);
    }
}

}  // namespace

Found read_journal(const std::string& path) {
    Found found;
    if (!std::filesystem::exists(path)) return found;
    // At most 2 GiB, far more than the lines of any sweep.
    const std::string text = scenes::read_text_file(path, std::size_t{1} << 31);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) {
            found.torn = true;
            break;
        }
        found.lines.push_back(parse_line(path, found.lines.size(), text.substr(begin, end - begin)));
        begin = found.whole_bytes = end + 1;
    }
    return found;
}

void check_journal(const std::string& path, const Lines& lines, const Lines& expected) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i == expected.size())
            throw InputError(path, fmt::format("line {}", i + 1), "no further line: the plan has no such cell",
                             "one (another plan needs another folder)");
        check_line(path, i, lines[i], expected[i]);
    }
}

Journal::Journal(const std::string& path, std::size_t whole_bytes) : path_{path} {
    // A torn last line is cut off before anything is appended: a line behind it would be lost with it.
    if (std::filesystem::exists(path)) std::filesystem::resize_file(path, whole_bytes);
    file_ = std::fopen(path.c_str(), "ab");
    if (file_ == nullptr) throw SystemError(path, "write", std::strerror(errno));
}

Journal::~Journal() { std::fclose(file_); }

// Flushed line by line: a kill costs the cell in work.
void Journal::append(const ordered_json& line) {
    const std::string text = line.dump() + '\n';
    const bool written = std::fwrite(text.data(), 1, text.size(), file_) == text.size() && std::fflush(file_) == 0;
    if (!written) throw SystemError(path_, "write", std::strerror(errno));
}

}  // namespace strata::tools
