// peeling/audit/audit.h - compares a frame with the exact A-buffer of the same fragments: order errors, lost layers and
// colour error.
//
// Rule     Every region is audited when it ends, while its trace exists (the comparison: pixel_audit.h), with the
//          fragments of as many pixels at a time as fit into the audit's memory. A region whose trace or fragments do
//          not fit is run again after the frame, in parts that are halved until they fit, and the queries return the
//          frame's answers. So the results depend neither on the memory nor on tiles, threads and execution.
// Numbers  Each worker has an equal share of the memory; a part that does not fit into a share is audited alone with
//          all of it. Half of a share is for the trace, 16 bytes per entry; the rest for lists, 52 bytes per fragment:
//          28 in its list, 8 in each of three orders. In addition a region takes 24 bytes per sample of a pixel while
//          it is audited. With several samples, each is audited by itself, with its own picture; counts are sums over
//          the samples.
// Source   peeling/reference/audit.md 13; the comparison: audit.md 1 to 5.
// Tests    tests/peeling/audit/audit_test.cpp, tests/peeling/audit/audit_memory_test.cpp
#pragma once
#include <cstdint>
#include <memory>

#include "peeling/algorithms/algorithm.h"
#include "peeling/audit/audit_result.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/frame_result.h"
#include "pipeline/region/executor.h"

namespace strata::peeling {

struct AuditMemory {
    // The memory limit, which --fragment-memory sets.
    std::uint64_t bytes = 0;  // of all workers
    int workers = 1;          // number of workers that audit at the same time
    // Half of a worker's share is for traces, the other half for fragments.
    [[nodiscard]] std::uint64_t trace_bytes() const noexcept { return bytes / static_cast<unsigned>(workers) / 2; }
    [[nodiscard]] std::uint64_t fragments() const noexcept { return trace_bytes() / bytes_per_fragment; }
    static constexpr std::uint64_t bytes_per_fragment = 52;
};

// The audit of one frame. It must exist while the frame runs.
class Audit {
  public:
    // `frame` and `body` are those that the executor runs, and must outlive the audit. The frame's trace_bytes limits
    // the length of a region's trace. threads: 0 means all.
    Audit(const pipeline::Frame& frame, const pipeline::Body& body, const Algorithm& algorithm, std::uint64_t bytes,
          int threads);
    ~Audit();
    Audit(const Audit&) = delete;
    Audit& operator=(const Audit&) = delete;

    // The callbacks for the executor.
    [[nodiscard]] pipeline::RegionCallbacks callbacks();

    // Call after the frame has run. Throws InputError if the fragments of one pixel do not fit into the memory.
    [[nodiscard]] AuditResult finish(const pipeline::FrameResult& result);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace strata::peeling
