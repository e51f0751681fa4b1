#include "apps/common/report/fault_events.h"

#include <cmath>
#include <cstdlib>

namespace presa {

void addFault(double time, const std::string& text, std::vector<svg::Event>& events) {
  constexpr double kSameTime = 1e-4;  // [s], less than a haptic tick
  const std::string label = text.substr(0, text.find(';'));
  const std::size_t colon = label.find(": ");
  if (!events.empty() && colon != std::string::npos && std::abs(events.back().time - time) < kSameTime) {
    std::string& before = events.back().label;
    const std::string what = label.substr(colon);
    if (before.size() > what.size() && before.ends_with(what)) {
      before.insert(before.size() - what.size(), ", " + label.substr(0, colon));
      return;
    }
  }
  events.push_back({label, time});
}

std::vector<svg::Event> faultEvents(const std::vector<std::string>& faults) {
  std::vector<svg::Event> events;
  for (const std::string& fault : faults) {
    char* end = nullptr;
    const double time = std::strtod(fault.c_str(), &end);
    const std::string what = end;
    if (end != fault.c_str() && std::isfinite(time) && what.starts_with(" s: ")) addFault(time, what.substr(4), events);
  }
  return events;
}

}  // namespace presa
