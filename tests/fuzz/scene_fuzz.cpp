#include <string>

#include "framework/scene/load.h"
#include "tests/fuzz/targets.h"

namespace presa::fuzz {

std::string scene(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  // the last line of the input doubles as an override, so that paths are explored too
  const std::string last_line =
      text.substr(text.find_last_of('\n') == std::string::npos ? 0 : text.find_last_of('\n') + 1);
  const auto equals = last_line.find('=');
  std::vector<Override> overrides;
  if (last_line.rfind("set ", 0) == 0 && equals != std::string::npos) {
    overrides.push_back({last_line.substr(4, equals - 4), last_line.substr(equals + 1)});
  }
  Diagnostics findings;
  const std::string scene_text = overrides.empty() ? text : text.substr(0, text.size() - last_line.size());
  const Scene read = parseScene(scene_text, "fuzz.xml", "/", overrides, findings);
  findings.text();
  if (findings.hasErrors() != read.resolved_xml.empty()) return "both a scene and errors, or neither";
  if (findings.hasErrors()) return {};
  Diagnostics again_findings;
  const Scene again = parseScene(read.resolved_xml, "again.xml", "/", {}, again_findings);
  if (again_findings.hasErrors() || again.resolved_xml != read.resolved_xml)
    return "the resolved form is another scene";
  return {};
}

}  // namespace presa::fuzz
