#include <cstdint>
#include <cstdlib>
#include <string>

#include "framework/scene/load.h"

/// Any input gives either a scene or errors, never both or neither; a scene can be read back from its resolved form.
/// Run:  scene_fuzz CORPUS config/scenes -max_len=8192
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  // the last line of the input doubles as an override, so that paths are explored too
  const std::string last_line =
      text.substr(text.find_last_of('\n') == std::string::npos ? 0 : text.find_last_of('\n') + 1);
  const auto equals = last_line.find('=');
  std::vector<presa::Override> overrides;
  if (last_line.rfind("set ", 0) == 0 && equals != std::string::npos) {
    overrides.push_back({last_line.substr(4, equals - 4), last_line.substr(equals + 1)});
  }
  presa::Diagnostics findings;
  const std::string scene_text = overrides.empty() ? text : text.substr(0, text.size() - last_line.size());
  const presa::Scene scene = presa::parseScene(scene_text, "fuzz.xml", "/", overrides, findings);
  findings.text();
  if (findings.hasErrors() != scene.resolved_xml.empty()) std::abort();
  if (findings.hasErrors()) return 0;
  presa::Diagnostics again_findings;
  const presa::Scene again = presa::parseScene(scene.resolved_xml, "again.xml", "/", {}, again_findings);
  if (again_findings.hasErrors() || again.resolved_xml != scene.resolved_xml) std::abort();
  return 0;
}
