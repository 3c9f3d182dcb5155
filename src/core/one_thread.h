// Work that keeps to the thread that does it, so that its CPU time can be told.
#pragma once

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <ctime>

#include "core/parallel.h"

namespace plumb {

/// Runs body() with every loop in it on the calling thread alone.
template <class Body>
void on_one_thread(const Body& body) {
#ifdef PLUMB_PLAIN_THREADS
  body();
#else
  tbb::task_arena arena(1);
  arena.execute(body);
#endif
}

/// Seconds that the calling thread has computed so far.
inline double thread_cpu_s() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Threads that this process may run at the same time, at least 1.
inline int available_threads() { return tbb::info::default_concurrency(); }

}  // namespace plumb
