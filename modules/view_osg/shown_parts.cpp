#include "modules/view_osg/shown_parts.h"

#include <algorithm>

#include "framework/core/diagnostics/refuse.h"

namespace presa::view {

ShownParts::ShownParts(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const bool hides = name.starts_with("no-");
    const std::string part = hides ? name.substr(3) : name;
    const auto* found = std::find(kShownPartNames.begin(), kShownPartNames.end(), part);
    if (found == kShownPartNames.end()) {
      std::vector<std::string> known(kShownPartNames.begin(), kShownPartNames.end());
      std::string list;
      for (const std::string& each : known) list += (list.empty() ? "" : ", ") + each;
      refuse(704, "--show", "the picture has no part '" + part + "'" + didYouMean(part, known),
             "parts: " + list + "; no-PART leaves one out");
    }
    shown_[static_cast<std::size_t>(found - kShownPartNames.begin())] = !hides;
  }
}

}  // namespace presa::view
