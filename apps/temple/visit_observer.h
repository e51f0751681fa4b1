#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "framework/assembly/assembly_guide.h"
#include "framework/core/graph/port.h"
#include "framework/scene/world.h"
#include "framework/session/view.h"

namespace presa::temple {

/// Runs the guide of the assembly and passes its events and state to the main thread. Thread: step() runs on the view's
/// thread; the other functions are for the main thread.
class VisitObserver final : public Module {
 public:
  explicit VisitObserver(std::shared_ptr<const World> world);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"what happened to the assembly, for the log"}; }

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
  In<AssemblyState> assembly_{*this, "assembly_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  std::shared_ptr<const World> world_;
  AssemblyGuide guide_;
  std::atomic<View*> view_{nullptr};
  mutable std::mutex mutex_;  // guards all members below
  Snapshot snapshot_;
  std::vector<GuideEvent> events_;
  std::string banner_;
  bool banner_changed_ = false;
};

}  // namespace presa::temple
