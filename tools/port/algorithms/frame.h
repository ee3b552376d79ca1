// tools/port/algorithms/frame.h - the start and the end of every algorithm: the opaque scene, and the finished picture.
#pragma once
#include "tools/port/algorithms/job.h"

namespace strata::port {

inline constexpr std::array<float, 4> zero{};
inline constexpr float far_plane = 1.0f;

// Viewport, clip control and scissor; `clip_depth` is the scene's.
void set_window(FrameSize size, const PortSettings& settings, GLenum clip_depth);

// The opaque surfaces: colour over the background, and depth. A scene without any has the clear values.
class Opaque {
  public:
    // Depths are stored in the format `depth`, which must be that of the peel.
    Opaque(const JobInput& input, const PixelFormat& depth);
    void draw(const GpuScene& scene) const;

    // Copies the opaque depth into the depth of `framebuffer`, whose format must be equal.
    void copy_depth_to(const Handle& framebuffer) const;
    void copy_color_to(const Handle& framebuffer) const;
    [[nodiscard]] GLuint color() const { return color_.name(); }
    [[nodiscard]] GLuint depth() const { return depth_.name(); }
    // GLSL: `bool hidden(float z)`, true at and behind the opaque surface, for z as stored. The program declares the
    // sampler opaque_depth, and stored() if depths are not floats.
    [[nodiscard]] std::string hidden_text() const;

  private:
    FrameSize size_;
    PixelFormat format_, color_format_;
    std::array<float, 4> background_;
    bool exists_;
    PortSettings settings_;
    Handle color_, depth_, framebuffer_, program_;
};

// The last quad: the front over the colour behind it. `through` is a GLSL expression for the transmittance of `front`.
class FinalQuad {
  public:
    FinalQuad(const JobInput& input, const std::string& through);
    // Draws the quad and reads it back.
    void draw(GLuint front, GLuint behind, PixelCodes& picture, Record* record) const;

  private:
    JobInput input_;
    Handle target_, framebuffer_, program_;
};

// Of the finished target: the frame's, or srgb8 for a port that has such a target by mistake.
[[nodiscard]] PixelFormat picture_format(const JobInput& input);
// Reads a finished target of picture_format() in the form of the port's results.
[[nodiscard]] PixelCodes read_picture(GLuint texture, const JobInput& input);

// GLSL: `float stored(float z)`, a depth as the driver stores it and reads it back: the code times the binary32
// reciprocal of the greatest code, which for d24 may differ from the quotient. If z were compared directly, a fragment
// could be behind itself and the peel would never end.
[[nodiscard]] std::string stored_text(const PixelFormat& depth);

}  // namespace strata::port
