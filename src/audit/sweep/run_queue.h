// Which run a thread takes next.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <vector>

#include "audit/sweep/plan.h"

namespace plumb::audit::sweep {

/// Hands out runs group by group, so that little is prepared at a time.
class RunQueue {
 public:
  /// runs  indices of plan.runs; none of them is skipped
  RunQueue(const SweepPlan& plan, const std::vector<std::size_t>& runs);

  struct Task {
    enum class Kind { Prepare, Run, Nothing } kind = Kind::Nothing;
    std::size_t group = 0;  // of this queue
    std::size_t run = 0;    // of the plan
  };
  /// A run of a group that is prepared; else a group to be prepared by the caller; else waits for
  /// one that others prepare. Nothing: all is handed out, or stopped.
  Task next();
  /// The group's runs may be handed out.
  void prepared(std::size_t group);
  /// The group cannot be prepared: returns its runs, which are not handed out.
  std::vector<std::size_t> fail(std::size_t group);
  /// A run of the group is over; true if it was the last.
  bool finished(std::size_t group);
  /// Hands out nothing more.
  void stop();

  std::size_t groups() const { return groups_.size(); }
  /// Of the plan.
  std::size_t plan_group(std::size_t group) const { return groups_[group].group; }

 private:
  struct Group {
    std::size_t group = 0;          // of the plan
    std::vector<std::size_t> runs;  // by view, so that a cast frame serves several at once
    std::size_t taken = 0, over = 0;
    enum class State { Waiting, Preparing, Ready } state = State::Waiting;
  };

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Group> groups_;
  bool stopped_ = false;
};

}  // namespace plumb::audit::sweep
