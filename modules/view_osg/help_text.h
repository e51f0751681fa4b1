#pragma once
#include <string>
#include <vector>

#include "modules/view_osg/window_input.h"

namespace presa::view {

struct HelpLine {
  std::string keys, what;  ///< empty keys: a heading
};

/// All that mouse and keys do in this window, of a run or of a recording: what the key `?` shows.
std::vector<HelpLine> helpLines(const Controls& controls, bool recording);

}  // namespace presa::view
