// rasterizer/walk/batch_sink.h - the callback that receives the batches of a walk.
#pragma once
#include <type_traits>

namespace strata::rasterizer {

struct FragmentBatch;

// A non-owning reference to a callable, which is called once per batch.
class BatchSink {
  public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, BatchSink>) explicit BatchSink(F& f) noexcept
        : object_{&f}, call_{[](void* object, FragmentBatch& batch) { (*static_cast<F*>(object))(batch); }} {}
    void operator()(FragmentBatch& batch) const { call_(object_, batch); }

  private:
    void* object_;
    void (*call_)(void*, FragmentBatch&);
};

}  // namespace strata::rasterizer
