// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

// The thread sanitizer does not see oneTBB's own synchronisation and reports races that are none.
// Under it the loops run on plain threads, which it understands, so that what it reports is ours.
// (Sums then join in another order: bits differ.)
#if defined(__SANITIZE_THREAD__)
#define PLUMB_PLAIN_THREADS
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define PLUMB_PLAIN_THREADS
#endif
#endif

#ifdef PLUMB_PLAIN_THREADS
#include "core/plain_threads.h"
#endif

namespace plumb {

/// Calls body(i) for i in [0, count), in any order and on any thread: each call writes to its own
/// place.
template <class Body>
void parallel_for(std::int64_t count, std::int64_t grain, const Body& body) {
#ifdef PLUMB_PLAIN_THREADS
  plain_threads::for_pieces(count, grain, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
#else
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count, static_cast<std::size_t>(grain)),
                    [&](const tbb::blocked_range<std::int64_t>& range) {
                      for (std::int64_t i = range.begin(); i < range.end(); ++i) body(i);
                    });
#endif
}

/// Calls body(). Should it wait for a parallel loop of its own, its thread takes up no other
/// iteration of a loop around it meanwhile: bodies of that do not pile up on one stack.
template <class Body>
void in_isolation(const Body& body) {
#ifdef PLUMB_PLAIN_THREADS
  body();
#else
  tbb::this_task_arena::isolate(body);
#endif
}

/// Reduces [0, count) in pieces of about `grain` that are joined in a fixed tree, so that the
/// result has the same bits on any number of threads. accumulate(begin, end, value) -> value;
/// join(left, right) -> value.
template <class Value, class Accumulate, class Join>
Value parallel_ordered_reduce(std::int64_t count, std::int64_t grain, const Value& identity,
                              const Accumulate& accumulate, const Join& join) {
#ifdef PLUMB_PLAIN_THREADS
  struct Part {  // no vector of bool, whose neighbours share a word
    Value value;
  };
  std::vector<Part> parts(static_cast<std::size_t>((count + grain - 1) / grain), Part{identity});
  plain_threads::for_pieces(
      count, grain, [&](std::int64_t piece, std::int64_t begin, std::int64_t end) {
        parts[static_cast<std::size_t>(piece)].value = accumulate(begin, end, identity);
      });
  Value sum = identity;
  for (const Part& part : parts) sum = join(sum, part.value);
  return sum;
#else
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::int64_t>(0, count, static_cast<std::size_t>(grain)), identity,
      [&](const tbb::blocked_range<std::int64_t>& range, Value value) {
        return accumulate(range.begin(), range.end(), std::move(value));
      },
      join);
#endif
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
