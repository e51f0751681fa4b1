#pragma once
#include <string>
#include <vector>

#include "apps/common/report/svg_plot.h"

namespace presa {

/// Adds a fault as an event of a plot, without the explanation after its semicolon. The same fault of another finger at
/// the same time joins the event before it: "thumb, index: device disconnected".
void addFault(double time, const std::string& text, std::vector<svg::Event>& events);

/// The faults of a recording, "12.345 s: what", as events. A text without a time has none.
std::vector<svg::Event> faultEvents(const std::vector<std::string>& faults);

}  // namespace presa
