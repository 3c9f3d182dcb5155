// What several runs of a sweep need and only one of them makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace plumb::audit::sweep {

/// Made by whoever asks first, while the others wait; gone when nobody holds it any more and
/// forget() was called.
template <class Value>
class SharedWork {
 public:
  /// make() -> Value. Throws what make() threw, again and again.
  template <class Make>
  std::shared_ptr<const Value> get(const Make& make) {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (value_ == nullptr) {
      try {
        value_ = make();
      } catch (...) {
        failure_ = std::current_exception();
        throw;
      }
    }
    return value_;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const Value> value_;
  std::exception_ptr failure_;
};

/// Works by name. The least lately used ones are forgotten where all together have more than
/// `most_bytes`.
template <class Value>
class SharedWorks {
 public:
  explicit SharedWorks(std::int64_t most_bytes) : most_bytes_(most_bytes) {}

  /// make() -> shared_ptr of a Value of `bytes`, called for a name that is not there.
  template <class Make>
  std::shared_ptr<const Value> get(const std::string& name, std::int64_t bytes, const Make& make) {
    return slot(name, bytes)->get(make);
  }
  /// Whoever holds it goes on.
  void forget(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) drop(found->second);
  }

 private:
  struct Entry {
    std::string name;
    std::int64_t bytes = 0;
    std::shared_ptr<SharedWork<Value>> work;
  };
  using Place = typename std::list<Entry>::iterator;

  std::shared_ptr<SharedWork<Value>> slot(const std::string& name, std::int64_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) {
      entries_.splice(entries_.begin(), entries_, found->second);
    } else {
      entries_.push_front({name, bytes, std::make_shared<SharedWork<Value>>()});
      by_name_[name] = entries_.begin();
      bytes_ += bytes;
      while (bytes_ > most_bytes_ && entries_.size() > 1) drop(std::prev(entries_.end()));
    }
    return entries_.front().work;
  }
  void drop(Place place) {
    bytes_ -= place->bytes;
    by_name_.erase(place->name);
    entries_.erase(place);
  }

  std::mutex mutex_;
  std::list<Entry> entries_;  // the latest first
  std::map<std::string, Place> by_name_;
  std::int64_t bytes_ = 0;
  std::int64_t most_bytes_;
};

}  // namespace plumb::audit::sweep
