#include "apps/common/options/show_option.h"

#include "framework/session/shown_parts.h"

namespace presa {

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
