#include "apps/common/options/show_option.h"

#include "framework/session/shown_parts.h"

namespace presa {

void addShowOption(Command command, std::vector<std::string>& show) {
  std::string parts;
  for (const std::string_view part : kShownPartNames) (parts += parts.empty() ? "" : ", ") += part;
  command
      .option("--show", show,
              "what the picture shows besides its own choice, by commas: " + parts + ";\nno-PART leaves one out")
      .separatedBy(',')
      .oneValueEach();
}

}  // namespace presa
