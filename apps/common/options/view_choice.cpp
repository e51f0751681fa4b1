#include "apps/common/options/view_choice.h"

#include <cstdlib>

namespace presa {

RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn) {
  if (wanted == "window") return RunOptions::View::kWindow;
  if (wanted == "offscreen") return RunOptions::View::kOffscreen;
  if (wanted == "none") return RunOptions::View::kNone;
  const char* display = std::getenv("DISPLAY");
  if (live && display != nullptr && *display != '\0') return RunOptions::View::kWindow;
  return drawn ? RunOptions::View::kOffscreen : RunOptions::View::kNone;
}

}  // namespace presa
