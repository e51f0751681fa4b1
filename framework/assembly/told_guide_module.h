#pragma once
#include <vector>

#include "framework/assembly/guide_module.h"
#include "framework/assembly/guide_report.h"

namespace presa {

/// Stands for the guide where it runs in another process: passes on what that one tells, as GuideModule does with its
/// own. In port: guide_report. Thread: view.
class ToldGuideModule final : public Module {
 public:
  explicit ToldGuideModule(const Scene& scene);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"pass on what the guide in the viewer tells"}; }

 private:
  In<GuideReport> report_{*this, kGuideReportPort, In<GuideReport>::Optional{}};
  Out<GuideState> guidance_{*this, "guidance"};
  std::uint64_t passed_ = 0;
  std::vector<GuideEvent> events_;
};

}  // namespace presa
