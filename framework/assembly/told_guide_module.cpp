#include "framework/assembly/told_guide_module.h"

#include <algorithm>

namespace presa {

ToldGuideModule::ToldGuideModule(const Scene& scene) : Module("told_guide", RateGroup::kView) {
  guidance_.value.now.all = static_cast<std::int32_t>(scene.assembly->goals.size());
  guidance_.value.now.elapsed = scene.assembly->elapsed;
}

void ToldGuideModule::step(const Tick&) noexcept {
  events_.clear();
  if (report_.hasValue()) {
    const GuideReport& report = report_.value();
    if (report.told > passed_ + GuideReport::kKept) passed_ = report.told - GuideReport::kKept;
    for (; passed_ < report.told; ++passed_) events_.push_back(report.events[passed_ % GuideReport::kKept]);
    if (report.now.all > 0) guidance_.value.now = report.now;
  }
  guidance_.value.events = &events_;
}

}  // namespace presa
