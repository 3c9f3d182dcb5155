// Loops on threads of the standard library, for the thread sanitizer.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace plumb::plain_threads {

/// visit(piece, begin, end) for each piece of `grain` of [0, count). The first exception is passed
/// on.
template <class Visit>
void for_pieces(std::int64_t count, std::int64_t grain, const Visit& visit) {
  const std::int64_t pieces = (count + grain - 1) / grain;
  std::atomic<std::int64_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (std::int64_t piece = next++; piece < pieces; piece = next++) {
        visit(piece, piece * grain, std::min((piece + 1) * grain, count));
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = pieces;
    }
  };
  // Few threads are enough to race, and loops inside loops start their own.
  constexpr int kThreads = 3;
  std::vector<std::thread> threads;
  for (int k = 1; k < std::min<std::int64_t>(kThreads, pieces); ++k) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace plumb::plain_threads
