// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cstdint>
#include <memory>

namespace plumb {

/// Calls body(i) for i in [0, count), in any order and on any thread: each call writes to its own
/// place.
template <class Body>
void parallel_for(std::int64_t count, std::int64_t grain, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count, static_cast<std::size_t>(grain)),
                    [&](const tbb::blocked_range<std::int64_t>& range) {
                      for (std::int64_t i = range.begin(); i < range.end(); ++i) body(i);
                    });
}

/// Reduces [0, count) in pieces of `grain` that are joined in a fixed tree, so that the result has
/// the same bits on any number of threads. accumulate(begin, end, value) -> value; join(left,
/// right) -> value.
template <class Value, class Accumulate, class Join>
Value parallel_ordered_reduce(std::int64_t count, std::int64_t grain, const Value& identity,
                              const Accumulate& accumulate, const Join& join) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::int64_t>(0, count, static_cast<std::size_t>(grain)), identity,
      [&](const tbb::blocked_range<std::int64_t>& range, Value value) {
        return accumulate(range.begin(), range.end(), std::move(value));
      },
      join);
}

/// Limits the threads of this process while it lives; 0 leaves the number alone.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0) {
      control_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                       static_cast<std::size_t>(threads));
    }
  }

 private:
  std::unique_ptr<tbb::global_control> control_;
};

}  // namespace plumb
