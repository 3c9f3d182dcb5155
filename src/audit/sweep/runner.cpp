#include "audit/sweep/runner.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>

#include "audit/frame_audit.h"
#include "audit/frame_memory.h"
#include "audit/method_truth.h"
#include "audit/sweep/line_json.h"
#include "audit/sweep/run_queue.h"
#include "audit/sweep/shared_works.h"
#include "core/check.h"
#include "core/one_thread.h"
#include "core/stopwatch.h"

namespace plumb::audit::sweep {
namespace {

struct CastFrame {
  HitImage hits;
  double cast_s = 0.0;
};

// What all runs of a group share.
struct PreparedGroup {
  std::shared_ptr<const MethodTruth> truth;
  std::unique_ptr<const PreparedMethod> method;
  double wall_s = 0.0, cpu_s = 0.0;  // of preparing the method
};

// Truths are the same where these texts are: of one terrain and diagonal, or, where the method's
// parameters shape the truth, of those too.
std::string truth_name(const SweepPlan& plan, const RunGroup& group) {
  std::string name = fmt::format("{}", group.terrain);
  if (plan.terrains[group.terrain].field->stacks == nullptr)
    return name + " " + terrain::name_of(group.diagonal);
  name += " " + group.method->name;
  for (const auto& [key, value] : group.choice.parameters)
    name += fmt::format(" {}={}", key, value);
  return name;
}

std::string message_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::length_error&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  }
}

struct Draws {
  std::vector<double> wall_s, cpu_s;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

double spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

class Runner {
 public:
  Runner(const SweepPlan& plan, const std::vector<std::size_t>& runs, const MethodTable& table,
         const RunnerOptions& options, const LineListener& on_line)
      : plan_(plan),
        table_(table),
        options_(options),
        on_line_(on_line),
        queue_(plan, runs),
        groups_(queue_.groups()),
        truths_(std::numeric_limits<std::int64_t>::max()),
        frames_(options.frame_bytes) {
    for (std::size_t g = 0; g < queue_.groups(); ++g) ++truth_uses_[truth_of(g)];
  }

  void run() {
    std::vector<std::thread> threads;
    for (int k = 1; k < options_.threads; ++k) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const RunGroup& group_of(std::size_t g) const { return plan_.groups[queue_.plan_group(g)]; }
  std::string truth_of(std::size_t g) const { return truth_name(plan_, group_of(g)); }

  void work() {
    on_one_thread([this] {
      for (;;) {
        const RunQueue::Task task = queue_.next();
        if (task.kind == RunQueue::Task::Kind::Nothing) return;
        if (task.kind == RunQueue::Task::Kind::Prepare) {
          prepare(task.group);
        } else {
          do_run(task.group, task.run);
        }
      }
    });
  }

  void prepare(std::size_t g) {
    const RunGroup& group = group_of(g);
    const terrain::Heightfield& field = *plan_.terrains[group.terrain].field;
    try {
      auto made = std::make_shared<PreparedGroup>();
      made->truth = truths_.get(truth_of(g), 0, [&] {
        return std::make_shared<const MethodTruth>(field, group.diagonal, table_, group.method,
                                                   group.choice);
      });
      Stopwatch watch;
      const double cpu_s = thread_cpu_s();
      made->method = group.method->prepare(field, group.choice);
      made->cpu_s = thread_cpu_s() - cpu_s;
      made->wall_s = watch.lap_s();
      groups_[g] = std::move(made);
      queue_.prepared(g);
    } catch (...) {
      const std::string message = message_of(std::current_exception());
      for (const std::size_t run : queue_.fail(g)) tell(failed_line(plan_, run, message));
      release(g);
    }
  }

  void do_run(std::size_t g, std::size_t run) {
    try {
      tell(line_of(*groups_[g], run));
    } catch (...) {
      tell(failed_line(plan_, run, message_of(std::current_exception())));
    }
    if (queue_.finished(g)) release(g);
  }

  std::string line_of(const PreparedGroup& prepared, std::size_t index) {
    const PlannedRun& run = plan_.runs[index];
    const RunGroup& group = plan_.groups[run.group];
    const Camera& camera = plan_.terrains[group.terrain].views[run.view].placed;
    Draws draws;
    DrawnSurface surface;
    for (int k = 0; k < options_.draws; ++k) {
      // A new start each time: what `plumb audit` makes of this frame alone.
      const std::unique_ptr<MethodRun> frames = prepared.method->start();
      Stopwatch watch;
      const double cpu_s = thread_cpu_s();
      surface = frames->step(camera, run.tolerance);
      draws.cpu_s.push_back(thread_cpu_s() - cpu_s);
      draws.wall_s.push_back(watch.lap_s());
    }
    const std::shared_ptr<const CastFrame> frame = frame_of(prepared, group, run);
    AuditOptions measures;
    measures.band = band_of(*group.method, group.choice.variant, run.tolerance);
    AuditResult result =
        audit_frame(prepared.truth->terms(), frame->hits, surface, camera, measures);
    result.times.truth_s = frame->cast_s;
    return done_line(
        plan_, index, result,
        {prepared.wall_s, prepared.cpu_s, options_.draws, median(draws.wall_s), median(draws.cpu_s),
         spread(draws.wall_s), spread(draws.cpu_s), !options_.timed});
  }

  std::shared_ptr<const CastFrame> frame_of(const PreparedGroup& prepared, const RunGroup& group,
                                            const PlannedRun& run) {
    const Camera& camera = plan_.terrains[group.terrain].views[run.view].placed;
    const std::string name = fmt::format("{} seen by {}", truth_name(plan_, group), run.view);
    const std::int64_t bytes = kHitBytes * camera.width_px * camera.height_px;
    return frames_.get(name, bytes, [&] {
      auto frame = std::make_shared<CastFrame>();
      Stopwatch watch;
      frame->hits = cast_truth(prepared.truth->terms(), camera);
      frame->cast_s = watch.lap_s();
      return frame;
    });
  }

  void release(std::size_t g) {
    groups_[g].reset();
    const std::lock_guard lock(mutex_);
    if (--truth_uses_[truth_of(g)] == 0) truths_.forget(truth_of(g));
  }

  void tell(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (failure_) return;
    try {
      on_line_(line);
    } catch (...) {
      failure_ = std::current_exception();
      queue_.stop();
    }
  }

  const SweepPlan& plan_;
  const MethodTable& table_;
  const RunnerOptions& options_;
  const LineListener& on_line_;
  RunQueue queue_;
  std::vector<std::shared_ptr<const PreparedGroup>> groups_;  // of the queue; null: not in use
  SharedWorks<MethodTruth> truths_;
  SharedWorks<CastFrame> frames_;
  std::mutex mutex_;
  std::map<std::string, int> truth_uses_;  // groups that are not over
  std::exception_ptr failure_;
};

}  // namespace

void run_sweep(const SweepPlan& plan, const std::vector<std::size_t>& runs,
               const MethodTable& table, const RunnerOptions& options,
               const LineListener& on_line) {
  require(options.threads >= 1, "threads must be >= 1, got {}", options.threads);
  require(options.draws >= 1, "draws must be >= 1, got {}", options.draws);
  require(!options.timed || options.threads == 1, "timed runs have one thread, got {}",
          options.threads);
  std::vector<std::size_t> wanted;
  for (const std::size_t run : runs) {
    if (plan.runs[run].skipped.empty()) {
      wanted.push_back(run);
    } else {
      on_line(skipped_line(plan, run));
    }
  }
  Runner(plan, wanted, table, options, on_line).run();
}

}  // namespace plumb::audit::sweep
