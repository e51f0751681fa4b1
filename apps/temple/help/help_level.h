#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "apps/temple/help/grasp_help.h"
#include "framework/assembly/guide_module.h"
#include "framework/core/graph/port.h"

namespace presa::temple {

/// The strength of the help after a block was placed, for the log.
struct HelpNote {
  double time = 0, strength = 1;  ///< [s], [-]
  GraspHelp::Need need;           ///< of this block
  bool own = false;               ///< placed without help
};

/// Lets the help fade with the visitor's skill: every placed block takes kEach off its strength, one placed without
/// help kOwn; a dropped block gives kEach back. Tells the help what stands and where a held block belongs. Thread:
/// view; takeNotes() any.
class HelpLevel final : public Module {
 public:
  HelpLevel(std::shared_ptr<const World> world, std::shared_ptr<GraspHelp> help);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"fade the help with the blocks that were placed"}; }

  static constexpr double kEach = 0.07, kOwn = 0.25;
  std::vector<HelpNote> takeNotes();

 private:
  void note(double time, bool placed);

  In<GuideState> guide_{*this, "guidance"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
  std::shared_ptr<const World> world_;
  std::shared_ptr<GraspHelp> help_;
  double strength_ = 1;
  std::mutex mutex_;  // guards notes_
  std::vector<HelpNote> notes_;
};

}  // namespace presa::temple
