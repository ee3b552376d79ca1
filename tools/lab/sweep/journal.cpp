#include "tools/lab/sweep/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "pipeline/formats/value_digest.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/system_error.h"
#include "scenes/files/text_file.h"
#include "tools/strata/messages.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

std::string digest_of(std::string_view text) {
    pipeline::ValueDigest digest{"line"};
    for (const char c : text) digest.add(static_cast<unsigned char>(c));
    return digest.hexadecimal();
}

// The text that follows the part covered by the digest.
std::string ending_of(std::string_view text) { return fmt::format(",\"line_digest\":\"{}\"}}", digest_of(text)); }

// The object of a line without its newline; null if it was changed.
ordered_json parse_line(std::string_view line) {
    const std::size_t length = ending_of("").size();
    if (line.size() <= length) return nullptr;
    const std::string_view text = line.substr(0, line.size() - length);
    if (line.substr(text.size()) != ending_of(text)) return nullptr;
    auto object = ordered_json::parse(std::string(text) + '}', nullptr, false);
    return object.is_object() ? object : ordered_json(nullptr);
}

// JSON text is compared, because numbers are written in one form.
void check_description(const std::string& path, std::size_t number, const ordered_json& line,
                       const ordered_json& expected) {
    for (const auto& [key, value] : expected.items()) {
        const std::string found = line.contains(key) ? json_text(line[key]) : "nothing";
        if (found != json_text(value))
            throw InputError(path, fmt::format("line {}: {}", number, key),
                             json_text(value) + ", as the plan has it (another plan needs another folder)", found);
    }
}

// The index of the line's cell in `cells`, which is ascending.
std::size_t place_of(const std::string& path, std::size_t number, const ordered_json& line,
                     const std::vector<std::size_t>& cells) {
    const ordered_json cell = line.contains("cell") ? line["cell"] : ordered_json(nullptr);
    const auto found = std::find_if(cells.begin(), cells.end(),
                                    [&](std::size_t one) { return cell.is_number_integer() && cell == one; });
    if (found == cells.end())
        throw InputError(path, fmt::format("line {}: cell", number),
                         "a cell of the plan (another plan needs another folder)", json_text(cell));
    return static_cast<std::size_t>(found - cells.begin());
}

bool has_keys(const ordered_json& line, const std::vector<std::string>& keys) {
    return std::all_of(keys.begin(), keys.end(), [&](const std::string& key) { return line.contains(key); });
}

}  // namespace

std::string json_text(const ordered_json& value) {
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string line_text(const ordered_json& line) {
    std::string text = json_text(line);
    text.pop_back();  // the brace that closes the object
    return text + ending_of(text) + '\n';
}

JournalContents read_journal(const std::string& path) {
    JournalContents found;
    if (!std::filesystem::exists(path)) return found;
    // At most 2 GiB, far more than the lines of any sweep.
    const std::string text = scenes::read_text_file(path, std::size_t{1} << 31);
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) {
            found.torn = true;
            break;
        }
        ++number;
        auto line = parse_line(std::string_view(text).substr(begin, end - begin));
        if (line.is_null()) {
            found.changed.push_back(number);
        } else {
            found.lines.push_back(std::move(line));
            found.numbers.push_back(number);
        }
        begin = found.whole_bytes = end + 1;
    }
    return found;
}

Lines lines_of_cells(const std::string& path, JournalContents& found, const Expected& expected) {
    Lines lines(expected.cells.size());
    std::size_t last = 0;
    for (std::size_t i = 0; i < found.lines.size(); ++i) {
        ordered_json& line = found.lines[i];
        const std::size_t place = place_of(path, found.numbers[i], line, expected.cells);
        check_description(path, found.numbers[i], line, expected.described[place]);
        found.in_order = found.in_order && place >= last;
        last = place;
        if (lines[place].is_null() && has_keys(line, expected.keys))
            lines[place] = std::move(line);
        else
            found.changed.push_back(found.numbers[i]);
    }
    return lines;
}

Journal::Journal(const std::string& path, std::size_t whole_bytes) : path_{path} {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(whole_bytes)) != 0) {
        const int error = errno;
        if (descriptor_ >= 0) ::close(descriptor_);
        errno = error;
        fail();
    }
    errno = scenes::sync_folder(std::filesystem::path(path).parent_path().string());
    if (errno != 0) fail();
}

Journal::~Journal() { ::close(descriptor_); }

void Journal::fail() const { throw SystemError(path_, "write", std::strerror(errno)); }

// If the process is killed or the power fails, only the cell being measured is lost.
void Journal::append(const ordered_json& line) {
    const std::string text = line_text(line);
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t written = ::write(descriptor_, text.data() + done, text.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        done += static_cast<std::size_t>(written);
    }
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail();
}

std::string text_of(const Lines& lines) {
    std::string text;
    for (const ordered_json& line : lines)
        if (!line.is_null()) text += line_text(line);
    return text;
}

void warn_of(const std::string& path, const JournalContents& found) {
    constexpr std::size_t most_named = 8;
    const std::size_t named = std::min(found.changed.size(), most_named);
    for (std::size_t i = 0; i < named; ++i)
        say_warning(path + ": line " + std::to_string(found.changed[i]) +
                    " is not what was written; it is dropped, and its cell measured again");
    if (found.changed.size() > named)
        say_warning(path + ": the same of " + std::to_string(found.changed.size() - named) + " further lines");
    if (found.torn) say_warning(path + ": the last line was torn; its cell is measured again");
}

Journal journal_behind(const std::string& path, const JournalContents& found, const Lines& whole) {
    if (found.changed.empty()) return {path, found.whole_bytes};
    const std::string text = text_of(whole);
    scenes::write_file(path, text);
    return {path, text.size()};
}

}  // namespace strata::tools
