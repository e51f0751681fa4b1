#pragma once
#include <atomic>
#include <mutex>
#include <vector>

#include "framework/assembly/guide_module.h"
#include "framework/scene/world.h"
#include "framework/session/view.h"

namespace presa::temple {

/// Passes the events and the state of the assembly's guide to the main thread. Thread: step() runs on the view's
/// thread; the other functions are for the main thread.
class VisitObserver final : public Module {
 public:
  explicit VisitObserver(const World& world);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"collect the events of the assembly for the log"}; }

  struct Snapshot {
    double time = 0;     ///< [s]
    double touched = 0;  ///< last time that a finger was in contact [s]
    Guidance now;
    std::vector<Pose> X_WB;  ///< in the order of Scene::bodies
  };
  Snapshot snapshot() const;
  /// The events since the last call.
  std::vector<GuideEvent> takeEvents();

  /// Sets the text below the time in the view, from the next step on; empty: no text.
  void setBanner(const std::string& text);
  /// Sets the view that shows the banner; it must belong to the same run.
  void showOn(View* view) { view_.store(view, std::memory_order_relaxed); }

 private:
  In<ObjectState> objects_{*this, "object_state"};
  In<GuideState> guidance_{*this, "guidance"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  std::atomic<View*> view_{nullptr};
  mutable std::mutex mutex_;  // guards all members below
  Snapshot snapshot_;
  std::vector<GuideEvent> events_;
  std::string banner_;
  bool banner_changed_ = false;
};

}  // namespace presa::temple
