// peeling/render.h - one call from a draw list to a finished frame with its statistics: what tools and tests use.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "peeling/audit/audit.h"
#include "peeling/audit/region_trace.h"
#include "peeling/registry.h"
#include "peeling/sort.h"
#include "pipeline/region/executor.h"

namespace strata::peeling {

inline constexpr int tile_sizes[] = {8, 16, 32, 64, 128};
inline constexpr std::uint64_t least_audit_memory = std::uint64_t{16} << 20;

// How the first pass of a peel computes its positions (default: as the view says), and how further ones do (default: alike).
struct VertexPaths {
    std::optional<pipeline::VertexPath> first{}, second{};
    friend bool operator==(const VertexPaths&, const VertexPaths&) = default;
};

struct RenderOptions {
    int width = 1024, height = 1024;
    std::optional<pipeline::DepthFormat> depth;       // default: d32f where the profile has it, else d24
    std::optional<rasterizer::DepthPath> depth_path;  // default: the profile's
    std::optional<rasterizer::DepthPath>
        reference_path;                        // the depth that passes compare; default: the one that they store
    pipeline::CompareEpsilon compare_epsilon;  // added to a stored depth before it is compared
    bool quantize_reference =
        true;  // false: compare a depth that is not rounded like the stored one; true: as the profile
    VertexPaths vertex_paths;
    const pipeline::DrawList* second_list = nullptr;  // the same surfaces split otherwise, for all passes but the first
    std::optional<bool> second_depth_clamp;           // and their depth clamp
    std::optional<pipeline::Format> color_format;     // default: rgba8; rgba32f on a profile with exact depth ("ideal")
    std::optional<float> alpha;                       // draws everything as transparent, its own alpha times this
    pipeline::Rgba background{0, 0, 0, 1};
    pipeline::Termination termination;
    pipeline::Formulation formulation = pipeline::Formulation::resolved;
    Sort sort;  // the order in which triangles are submitted
    std::vector<std::string>
        sorted;  // meshes or materials that arrive front to back, for hybrid; beside those that the scene names
    int max_passes = 0;
    pipeline::Execution execution = pipeline::Execution::replay;
    // Bytes that replay may hold in captured fragments; and the audit as many, but no fewer than least_audit_memory.
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
    std::optional<int> tile_size;  // pixels; default: tile_size_of
    int threads = 0;
    pipeline::Effects effects = pipeline::Effects::needed;
    pipeline::Effect once_more = pipeline::Effect::none;  // pipeline/frame/frame.h; never replayed
    pipeline::Format average_count = pipeline::Format::r16f;
    bool keep_layers = false;
    bool trust_idle = true;                 // pipeline/frame/frame.h
    bool audit = true;                      // order_errors and the other comparisons with the a_buffer
    bool nearest_depth = true;              // make the Z image
    pipeline::PassLog* pass_log = nullptr;  // pipeline/frame/frame.h
    // The viewport's corner on its surface, in pixels; positions move with it exactly.
    std::array<int, 2> window_origin{0, 0};
    // Conventions; the viewport is set from width, height and window_origin.
    rasterizer::RasterState raster;
};

// The side of the tiles of `algorithm`'s frame, in pixels: what was asked for, or else 64; 128 where one pass is all and the frame has many
// tiles: triangles are divided among fewer. (More passes keep more a pixel, and want it in the caches.)
[[nodiscard]] int tile_size_of(const RenderOptions& options, const Algorithm& algorithm) noexcept;

enum class Outcome : std::uint8_t { done, refused };

struct Seconds {
    double geometry = 0, passes = 0;
    double audit = 0;  // of what the audit looked at while regions ran: its share of the wall clock
};

struct RenderResult {
    Outcome outcome = Outcome::done;
    std::optional<pipeline::Refusal> refusal;
    pipeline::FrameResult frame;
    AuditResult audit;
    Seconds seconds;
};

struct FrameFragments {
    std::vector<pipeline::CapturedFragment> all;  // in submission order; `pixel` is row-major in the frame
    std::vector<std::uint32_t> opaque;            // of each pixel: the opaque surface's depth in the algorithm's key
    static constexpr std::uint64_t bytes_a_fragment = 64;  // itself, and beside it what a file's writer makes of it
};

// Holds what is done once for all algorithms of a command: transform, clip, set-up and bins.
class Renderer {
  public:
    // Throws InputError, which names the field, for options that no profile could mean and for a list whose parts do not fit
    // together. `list` must outlive the renderer.
    Renderer(const pipeline::DrawList& list, const pipeline::View& view, const pipeline::DeviceProfile& profile,
             const RenderOptions& options);
    ~Renderer();

    // A combination that the profile cannot run is refused: an outcome, not an exception. Throws InputError if the fragments of
    // one pixel are more than the audit's memory holds.
    [[nodiscard]] RenderResult render(const Algorithm& algorithm, const std::function<void(double)>& progress = {});

    // The same without an audit; `traces` gets the trace of every region.
    [[nodiscard]] RenderResult render_traced(const Algorithm& algorithm, std::vector<RegionTrace>& traces);

    // One depth pass of the same triangles drawn as opaque (LESS, no colour): the measure of what peeling costs. Z in frame.depth.
    [[nodiscard]] RenderResult depth_pass(const std::function<void(double)>& progress = {});

    // Every fragment of the frame, with key and colour: what `strata layers --deep` writes. Throws Refused, and InputError if the
    // fragments take more than the audit's memory.
    [[nodiscard]] FrameFragments fragments(const Algorithm& algorithm);

    [[nodiscard]] pipeline::DepthFormat depth_format() const noexcept;
    [[nodiscard]] pipeline::Format color_format() const noexcept;
    [[nodiscard]] const rasterizer::SetupCounters& setup_counters() const noexcept;  // of the transparent list

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::peeling
