// peeling/audit/audit.h - a frame against the exact A-buffer of the same fragments: what the algorithm did, and what it
// lost.
//
// Rule     Every region is looked at when it ends, while its trace is there (pixel_audit.h says what is compared), with
//          the fragments of as many pixels at a time as fit into the audit's memory. What does not fit, a trace or a
//          pixel's fragments, is run again after the frame, in parts that are halved until they fit, with the frame's
//          answers for a script. So the figures depend neither on the memory nor on tiles, threads and execution.
// Numbers  A worker has an equal share of the memory, and what does not fit into a share is done alone with all of it.
//          Half of a share is for the trace, 16 bytes an entry; the rest for lists, 52 bytes a fragment: 28 in its
//          list, 8 in each of three orders. Beside it a pixel of a region takes 24 bytes while the region is looked at.
// Source   audit.md 13; what is compared, 1 to 5.
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
    // The limit of --fragment-memory.
    std::uint64_t bytes = 0;  // of all workers
    int workers = 1;          // as many as look at once
    // Half of a worker's share is for traces, the other half for fragments.
    [[nodiscard]] std::uint64_t trace_bytes() const noexcept { return bytes / static_cast<unsigned>(workers) / 2; }
    [[nodiscard]] std::uint64_t fragments() const noexcept { return trace_bytes() / bytes_a_fragment; }
    static constexpr std::uint64_t bytes_a_fragment = 52;
};

// One frame's. It must be there while the frame runs.
class Audit {
  public:
    // `frame` and `body` are what the executor runs, and must outlive the audit. The frame's own trace_bytes say how
    // long its regions' traces get. threads: 0: all.
    Audit(const pipeline::Frame& frame, const pipeline::Body& body, const Algorithm& algorithm, std::uint64_t bytes,
          int threads);
    ~Audit();
    Audit(const Audit&) = delete;
    Audit& operator=(const Audit&) = delete;

    // For the executor.
    [[nodiscard]] pipeline::Watch watch();

    // Once the frame has run. Throws InputError if one pixel's fragments alone do not fit into the memory.
    [[nodiscard]] AuditResult finish(const pipeline::FrameResult& result);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace strata::peeling
