#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "framework/assembly/assembly_guide.h"

namespace presa {

/// What a guide in another process tells its user, for the log of a visit and the run's own view. Port "guide_report".
/// Written by: bus thread (framework/bus/publisher).
struct GuideReport {
  static constexpr std::size_t kKept = 32;
  Guidance now;
  std::uint64_t told = 0;                ///< number of events since the start of the run
  std::array<GuideEvent, kKept> events;  ///< event n, counted from 0, at n % kKept

  void tell(const GuideEvent& event) noexcept { events[told++ % kKept] = event; }
};

inline constexpr const char* kGuideReportPort = "guide_report";

}  // namespace presa
