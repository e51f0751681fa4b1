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

/// Follows a run with the guide of its assembly. Steps on the view's thread; the main thread takes what it has seen.
class VisitTap final : public Module {
 public:
  explicit VisitTap(std::shared_ptr<const World> world);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"what happened to the assembly, for the log"}; }

  struct Look {
    double time = 0;     ///< [s]
    double touched = 0;  ///< a finger was on something then, the last time [s]
    Guidance now;
    std::vector<Pose> X_WB;  ///< as Scene::bodies
  };
  Look look() const;
  /// Since the last call.
  std::vector<GuideEvent> takeEvents();

  /// Text under the time of that view, from the next step on; empty: none.
  void setBanner(const std::string& text);
  /// Whose banner it is: a view of the same run.
  void showOn(View* view) { view_.store(view, std::memory_order_relaxed); }

 private:
  In<ObjectState> objects_{*this, "object_state"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  std::shared_ptr<const World> world_;
  AssemblyGuide guide_;
  std::atomic<View*> view_{nullptr};
  mutable std::mutex mutex_;  // of all below
  Look look_;
  std::vector<GuideEvent> events_;
  std::string banner_;
  bool banner_changed_ = false;
};

}  // namespace presa::temple
