#pragma once
#include <string>
#include <vector>

#include "modules/view_osg/window_input.h"

namespace presa::view {

struct HelpLine {
  std::string keys, what;  ///< empty `keys`: `what` is a heading
};

/// The help table of this window, for a run or a recording, shown by the key `?`.
std::vector<HelpLine> helpLines(const Controls& controls, bool recording);

}  // namespace presa::view
