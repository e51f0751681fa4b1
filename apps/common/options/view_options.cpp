#include "apps/common/options/view_options.h"

#include <cstdlib>

#include "framework/session/shown_parts.h"

namespace presa {

RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn) {
  if (wanted == "window") return RunOptions::View::kWindow;
  if (wanted == "offscreen") return RunOptions::View::kOffscreen;
  if (wanted == "none") return RunOptions::View::kNone;
  const char* display = std::getenv("DISPLAY");
  if (live && display != nullptr && *display != '\0') return RunOptions::View::kWindow;
  return drawn ? RunOptions::View::kOffscreen : RunOptions::View::kNone;
}

void addShowOption(Command command, std::vector<std::string>& show) {
  std::string parts;
  for (const std::string_view part : kShownPartNames) (parts += parts.empty() ? "" : ", ") += part;
  command
      .option("--show", show,
              "parts that the picture shows in addition to its default, separated by commas: " + parts +
                  ";\nno-PART leaves one out")
      .separatedBy(',')
      .oneValueEach();
}

}  // namespace presa
