#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <thread>

#include "framework/bus/remote_guide.h"

namespace presa {

/// The guide of a viewer, on a thread of its own: a slow picture holds up no decision. Thread: main; the thread ends
/// with this object.
class GuideThread {
 public:
  /// Throws InputError: E769 the run has its guide beside the dynamics, or no assembly; E720.
  GuideThread(std::shared_ptr<const World> world, const bus::RunInfo& run, const BusSettings& settings);
  ~GuideThread();
  GuideThread(const GuideThread&) = delete;
  GuideThread& operator=(const GuideThread&) = delete;

  void undo() noexcept { guide_.undo(); }
  bus::RemoteGuide::Now now() { return guide_.now(); }

 private:
  bus::RemoteGuide guide_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace presa
