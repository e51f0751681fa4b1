#include "apps/common/options/show_option.h"

#include "framework/session/shown_parts.h"

namespace presa {

void addShowOption(CLI::App& command, std::vector<std::string>& show) {
  std::string parts;
  for (const std::string_view part : kShownPartNames) (parts += parts.empty() ? "" : ", ") += part;
  command
      .add_option("--show", show,
                  "what the picture shows besides its own choice, by commas: " + parts + ";\nno-PART leaves one out")
      ->delimiter(',')
      ->allow_extra_args(false);
}

}  // namespace presa
