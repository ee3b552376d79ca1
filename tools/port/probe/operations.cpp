#include "tools/port/probe/operations.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "tools/port/npy.h"

namespace strata::port {

namespace {

constexpr int row_width = 64;  // inputs in a row of the texture that gives them
constexpr Format words_format{"rgba32ui", GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 4};

constexpr auto vertex_main = R"(
void main() {
    ivec2 size = textureSize(given, 0), at = ivec2(gl_VertexID % size.x, gl_VertexID / size.x);
    computed = uintBitsToFloat(operation(texelFetch(given, at, 0)));
    gl_Position = vec4((vec2(at) + 0.5) / vec2(size) * 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = 1.0;
}
)";
constexpr auto corners_main =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }";

Handle program_of(const KitOperation& operation) {
    std::string own = "uniform usampler2D given;\n";
    if (operation.texture)
        own += operation.texture->compares ? "uniform sampler2DShadow table;\n" : "uniform sampler2D table;\n";
    own += operation.body;
    ProgramText text;
    text.head = "#extension GL_ARB_shading_language_packing : enable\n";
    text.samplers = {"given", "table"};
    const bool is_srgb = operation.target == "srgb8";
    if (operation.stage == "fragment") {
        text.vertex = corners_main;
        text.fragment =
            own + "layout(location = 0) out " + (is_srgb ? "vec4" : "uvec4") +
            " result;\nvoid main() {\n    uvec4 found = operation(texelFetch(given, ivec2(gl_FragCoord.xy), 0));\n"
            "    result = " +
            (is_srgb ? "uintBitsToFloat(found)" : "found") + ";\n}\n";
    } else {
        const bool invariant = operation.stage == "invariant_vertex";
        text.vertex = own + (invariant ? "invariant " : "") + "flat out vec4 computed;\n" + vertex_main;
        text.fragment = std::string{invariant ? "invariant " : ""} +  // GLSL before 4.20 wants it said at both ends
                        "flat in vec4 computed;\nlayout(location = 0) out uvec4 result;\n"
                        "void main() { result = floatBitsToUint(computed); }\n";
    }
    return make_program(text);
}

// As OpenGL takes texels of the format. Of 24 bits the upper ones of a word count.
struct Upload {
    Format format;
    std::vector<std::uint8_t> bytes;
};
template <class Texel>
Upload upload_as(const Format& format, const std::vector<std::uint32_t>& words) {
    Upload upload{format, {}};
    for (const std::uint32_t word : words) {
        const auto texel = static_cast<Texel>(format == d24 ? word << 8 | word >> 16 : word);
        for (std::size_t i = 0; i < sizeof texel; ++i)
            upload.bytes.push_back(static_cast<std::uint8_t>(texel >> (8 * i)));
    }
    return upload;
}
Upload upload_of(const KitTexture& texture) {
    if (texture.format == "rgba8") return upload_as<std::uint32_t>(rgba8, texture.texels);
    if (texture.format == "srgb8") return upload_as<std::uint32_t>(srgb8, texture.texels);
    if (texture.format == "r32f") return upload_as<std::uint32_t>(r32f, texture.texels);
    if (texture.format == "d16") return upload_as<std::uint16_t>(d16, texture.texels);
    if (texture.format == "d24") return upload_as<std::uint32_t>(d24, texture.texels);
    if (texture.format == "d32f") return upload_as<std::uint32_t>(d32f, texture.texels);
    throw std::runtime_error("expected a texture's format, found " + texture.format);
}

Handle table_of(const KitTexture& texture) {
    const Upload upload = upload_of(texture);
    Handle table = make_texture(upload.format, texture.size);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texture.size.width, texture.size.height, upload.format.external,
                    upload.format.type, upload.bytes.data());
    const GLint filter = texture.is_linear ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    if (texture.compares) {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    return table;
}

// Four words for each input; bytes of an sRGB target become a word each.
std::vector<std::uint8_t> run(const KitOperation& operation) {
    const auto count = static_cast<int>(operation.inputs.size() / 4);
    const Size size{row_width, (count + row_width - 1) / row_width};
    std::vector<std::uint32_t> padded(4 * size.area());
    std::ranges::copy(operation.inputs, padded.begin());
    const Handle given = make_texture(words_format, size);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, words_format.external, words_format.type,
                    padded.data());
    const bool is_srgb = operation.target == "srgb8";
    const Format& format = is_srgb ? srgb8 : words_format;
    const Handle result = make_texture(format, size);
    const Handle table = operation.texture ? table_of(*operation.texture) : Handle{};
    const Handle program = program_of(operation);
    const Handle target = make_framebuffer({result.name()});
    bind({given.name(), table.name()});
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, size.width, size.height);
    (is_srgb ? glEnable : glDisable)(GL_FRAMEBUFFER_SRGB);
    glUseProgram(program.name());
    glDisable(GL_DEPTH_TEST);
    operation.stage == "fragment" ? glDrawArrays(GL_TRIANGLES, 0, 3) : glDrawArrays(GL_POINTS, 0, count);
    glDisable(GL_FRAMEBUFFER_SRGB);
    Image image = read_back(result.name(), format, size);
    if (is_srgb) {
        std::vector<std::uint8_t> words;
        for (const std::uint8_t byte : image.bytes) words.insert(words.end(), {byte, 0, 0, 0});
        image.bytes = std::move(words);
    }
    image.bytes.resize(static_cast<std::size_t>(count) * 16);
    check_errors(operation.name);
    return std::move(image.bytes);
}

}  // namespace

void answer_operations(const Kit& kit, const std::string& folder, nlohmann::ordered_json& missing) {
    if (kit.operations.empty()) return;
    std::filesystem::create_directories(folder);
    GLuint layout = 0;
    glGenVertexArrays(1, &layout);
    glBindVertexArray(layout);
    for (const KitOperation& operation : kit.operations) try {
            std::vector<std::uint8_t> bytes = run(operation);
            const auto count = static_cast<int>(bytes.size() / 16);
            constexpr Format word{"words", 0, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, 4};
            write_npy(folder + "/" + operation.name + ".npy", Image{word, {4, count}, std::move(bytes)});
        } catch (const std::runtime_error& error) {
            missing["operations/" + operation.name] = error.what();
        }
    glDeleteVertexArrays(1, &layout);
}

}  // namespace strata::port
