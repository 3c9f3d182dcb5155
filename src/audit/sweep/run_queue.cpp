#include "audit/sweep/run_queue.h"

#include <algorithm>
#include <utility>

namespace plumb::audit::sweep {

RunQueue::RunQueue(const SweepPlan& plan, const std::vector<std::size_t>& runs) {
  for (const std::size_t run : runs) {
    const std::size_t group = plan.runs[run].group;
    if (groups_.empty() || groups_.back().group != group) groups_.emplace_back().group = group;
    groups_.back().runs.push_back(run);
  }
  for (Group& group : groups_) {
    std::stable_sort(group.runs.begin(), group.runs.end(), [&](std::size_t a, std::size_t b) {
      return plan.runs[a].view < plan.runs[b].view;
    });
  }
}

RunQueue::Task RunQueue::next() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stopped_) return {};
    bool is_waiting = false;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      Group& group = groups_[g];
      if (group.state == Group::State::Ready && group.taken < group.runs.size())
        return {Task::Kind::Run, g, group.runs[group.taken++]};
      is_waiting = is_waiting || group.state == Group::State::Preparing;
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].state != Group::State::Waiting) continue;
      groups_[g].state = Group::State::Preparing;
      return {Task::Kind::Prepare, g, 0};
    }
    if (!is_waiting) return {};
    changed_.wait(lock);
  }
}

void RunQueue::prepared(std::size_t group) {
  const std::lock_guard lock(mutex_);
  groups_[group].state = Group::State::Ready;
  changed_.notify_all();
}

std::vector<std::size_t> RunQueue::fail(std::size_t group) {
  const std::lock_guard lock(mutex_);
  groups_[group].state = Group::State::Ready;
  groups_[group].taken = groups_[group].runs.size();
  changed_.notify_all();
  return groups_[group].runs;
}

bool RunQueue::finished(std::size_t group) {
  const std::lock_guard lock(mutex_);
  return ++groups_[group].over == groups_[group].runs.size();
}

void RunQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace plumb::audit::sweep
