#include "tools/port/probe/kit.h"

#include <array>
#include <bit>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace strata::port {

namespace {

using nlohmann::json;

const std::map<std::string, GLenum> equations{{"add", GL_FUNC_ADD},
                                              {"subtract", GL_FUNC_SUBTRACT},
                                              {"reverse_subtract", GL_FUNC_REVERSE_SUBTRACT},
                                              {"min", GL_MIN},
                                              {"max", GL_MAX}};
const std::map<std::string, GLenum> factors{
    {"zero", GL_ZERO},           {"one", GL_ONE},
    {"src_color", GL_SRC_COLOR}, {"one_minus_src_color", GL_ONE_MINUS_SRC_COLOR},
    {"dst_color", GL_DST_COLOR}, {"one_minus_dst_color", GL_ONE_MINUS_DST_COLOR},
    {"src_alpha", GL_SRC_ALPHA}, {"one_minus_src_alpha", GL_ONE_MINUS_SRC_ALPHA},
    {"dst_alpha", GL_DST_ALPHA}, {"one_minus_dst_alpha", GL_ONE_MINUS_DST_ALPHA}};

std::array<float, 2> pair_of(const json& digits) {
    const std::vector<std::uint32_t> words = words_of(digits.get<std::string>());
    return {std::bit_cast<float>(words.at(0)), std::bit_cast<float>(words.at(1))};
}

PixelFormat format_of(const json& name) {
    const PixelFormat* const format = find_format(name.get<std::string>());
    if (format == nullptr) throw std::runtime_error("expected a target's format, found " + name.dump());
    return *format;
}

KitDraw draw_of(const json& described) {
    KitDraw draw;
    draw.words = words_of(described.at("corners").get<std::string>());
    if (const json& blend = described.at("blend"); !blend.is_null())
        draw.blend = {equations.at(blend.at(0).get<std::string>()), factors.at(blend.at(1).get<std::string>()),
                      factors.at(blend.at(2).get<std::string>())};
    if (const json& offset = described.at("polygon_offset"); !offset.is_null()) draw.polygon_offset = pair_of(offset);
    if (const json& above = described.at("alpha_above"); !above.is_null())
        draw.alpha_above = std::bit_cast<float>(words_of(above.get<std::string>()).at(0));
    return draw;
}

KitItem item_of(const json& described) {
    KitItem item;
    item.name = described.at("name").get<std::string>();
    item.size = {described.at("size").at(0).get<int>(), described.at("size").at(1).get<int>()};
    item.color = format_of(described.at("color"));
    if (!described.at("depth").is_null()) item.depth = format_of(described.at("depth"));
    item.depth_range = pair_of(described.at("depth_range"));
    const std::vector<std::uint32_t> clear = words_of(described.at("clear").get<std::string>());
    for (std::size_t c = 0; c < 4; ++c) item.clear[c] = std::bit_cast<float>(clear.at(c));
    for (const json& draw : described.at("draws")) item.draws.push_back(draw_of(draw));
    return item;
}

}  // namespace

std::vector<std::uint32_t> words_of(const std::string& digits) {
    std::vector<std::uint32_t> words;
    for (std::size_t at = 0; at + 8 <= digits.size(); at += 8)
        words.push_back(static_cast<std::uint32_t>(std::stoul(digits.substr(at, 8), nullptr, 16)));
    return words;
}

Kit read_kit(const std::string& folder) {
    const std::string file = folder + "/kit.json";
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file + ": expected a kit, found no file that can be read");
    try {
        const json document = json::parse(stream);
        if (document.at("format") != "strata-kit" || document.at("version") != 1)
            throw std::runtime_error("expected a kit of version 1");
        Kit kit{.digest = document.at("digest").get<std::string>(), .items = {}};
        for (const json& item : document.at("items")) kit.items.push_back(item_of(item));
        return kit;
    } catch (const std::exception& error) {
        throw std::runtime_error(file + ": " + error.what());
    }
}

}  // namespace strata::port
