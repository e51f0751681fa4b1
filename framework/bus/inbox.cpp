#include "framework/bus/inbox.h"

#include <chrono>

namespace presa::bus {
namespace {

struct Deliver {
  Listener& listener;
  std::int64_t at_ns;
  void operator()(const RunInfo& run) const { listener.onRun(run, at_ns); }
  void operator()(const ObjectSample& sample) const { listener.onObject(sample, at_ns); }
  void operator()(const FingerSample& sample) const { listener.onFinger(sample, at_ns); }
  void operator()(const FrameSample& sample) const { listener.onFrame(sample, at_ns); }
  void operator()(const Heartbeat& heartbeat) const { listener.onHeartbeat(heartbeat, at_ns); }
  void operator()(const Event& event) const { listener.onEvent(event, at_ns); }
};

}  // namespace

void Inbox::put(const Item& item, std::int64_t received_ns) {
  {
    const std::lock_guard lock(mutex_);
    if (items_.size() >= capacity_) {
      ++overrun_;
      return;
    }
    items_.push_back({item, received_ns});
  }
  arrived_.notify_one();
}

void Inbox::take(Listener& listener) {
  taken_.clear();
  {
    const std::lock_guard lock(mutex_);
    taken_.swap(items_);
  }
  for (const Received& received : taken_) std::visit(Deliver{listener, received.at_ns}, received.item);
}

void Inbox::wait(double seconds) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return !items_.empty(); });
}

std::uint64_t Inbox::overrun() const {
  const std::lock_guard lock(mutex_);
  return overrun_;
}

}  // namespace presa::bus
