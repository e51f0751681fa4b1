#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/assembly_guide.h"
#include "framework/core/graph/port.h"
#include "framework/scene/world.h"

namespace presa {

/// Port "guidance". Written by: view thread (GuideModule).
struct GuideState {
  Guidance now;
  /// Events of this step, in order; valid until the guide's next step, so for readers in the view group only.
  const std::vector<GuideEvent>* events = nullptr;
};

/// Runs the guide of the scene's assembly at the view's rate, for the picture and for the log of a visit. In ports:
/// object_state, contact_exchange, and assembly_state; a remote viewer has no assembly_state and estimates it from the
/// poses. Thread: view.
class GuideModule final : public Module {
 public:
  explicit GuideModule(std::shared_ptr<const World> world);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"follow the assembly: progress, hesitation, events"}; }

 private:
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<AssemblyState> assembly_{*this, "assembly_state", In<AssemblyState>::Optional{}};
  Out<GuideState> guidance_{*this, "guidance"};
  std::shared_ptr<const World> world_;
  AssemblyGuide guide_;
};

}  // namespace presa
