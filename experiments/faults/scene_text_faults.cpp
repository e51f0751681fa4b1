#include <array>
#include <fstream>
#include <sstream>

#include "experiments/faults/scene_faults.h"
#include "experiments/faults/temporary_file.h"
#include "experiments/study/experiment_file.h"
#include "framework/core/schedule/clock.h"
#include "framework/scene/load.h"

namespace presa::faults {
namespace {

constexpr double kMaxSeconds = 1;  // limit of processor time for reading
constexpr double kTouch = 0.02;    // [s] of touching, for an accepted scene

std::string contentsOf(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::size_t placeIn(const std::string& text, RandomStream& random) {
  return static_cast<std::size_t>(random.below(text.size() + 1));
}

template <std::size_t N>
const char* oneOf(const std::array<const char*, N>& choices, RandomStream& random) {
  return choices[random.below(N)];
}

/// Replaces the value of a random attribute.
void spoilValue(std::string& text, RandomStream& random) {
  static constexpr std::array kValues{"",
                                      "nan",
                                      "-1",
                                      "1e308",
                                      "-1e308",
                                      "inf",
                                      "0",
                                      "1e-300",
                                      "0x10",
                                      "1 2 3 4",
                                      "0,5",
                                      "true",
                                      "…",
                                      "../../../etc/passwd",
                                      "999999999999999999999",
                                      "&lt;",
                                      "cube",
                                      "1000",
                                      "&#0;"};
  const std::size_t open = text.find("=\"", placeIn(text, random));
  if (open == std::string::npos) return;
  const std::size_t close = text.find('"', open + 2);
  if (close == std::string::npos) return;
  text.replace(open + 2, close - open - 2, oneOf(kValues, random));
}

void insertToken(std::string& text, RandomStream& random) {
  static constexpr std::array kTokens{"<",
                                      ">",
                                      "/>",
                                      "\"",
                                      "&",
                                      "<!--",
                                      "-->",
                                      "<![CDATA[",
                                      "]]>",
                                      "<?xml?>",
                                      "<body/>",
                                      "</scene>",
                                      "<body name=\"cube\"/>",
                                      "<mesh file=\"none.obj\"/>",
                                      "\xff\xfe",
                                      "&amp;",
                                      "&x;",
                                      "<!DOCTYPE a>",
                                      "stiffness=\"3\""};
  text.insert(placeIn(text, random), oneOf(kTokens, random));
}

void mutate(std::string& text, RandomStream& random) {
  const std::size_t at = placeIn(text, random), length = 1 + static_cast<std::size_t>(random.below(80));
  switch (random.below(8)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      text.erase(std::min(at, text.size()), length);
      break;
    case 2:
      text.insert(placeIn(text, random), text.substr(at, length));
      break;
    case 3:
      insertToken(text, random);
      break;
    case 4:
      text.resize(at);
      break;
    case 5:
      for (int deep = 0; deep < 2000; ++deep) text.insert(at, "<body>");
      break;
    default:
      spoilValue(text, random);
  }
}

/// Every error must state its place and have a message.
void requirePlaces(const Diagnostics& findings, const std::string& name, Outcome& outcome) {
  for (const Diagnostic& finding : findings.all()) {
    if (finding.severity != Diagnostic::Severity::kError) continue;
    if (finding.where.file != name || finding.where.line < 1)
      outcome.broken.push_back("an error without a place: " + format(finding));
    if (finding.message.empty() || finding.code == 0) outcome.broken.emplace_back("an error without a message");
  }
}

Outcome judge(const std::string& text, const std::string& directory, bool must_refuse) {
  Outcome outcome;
  const std::string name = "mutated.xml";
  Diagnostics findings;
  const std::int64_t begin = threadCpuNs();
  const Scene scene = parseScene(text, name, directory, {}, findings);
  if (static_cast<double>(threadCpuNs() - begin) * 1e-9 > kMaxSeconds) outcome.broken.emplace_back("took too long");
  if (findings.hasErrors() != scene.resolved_xml.empty()) outcome.broken.emplace_back("partly loaded");
  requirePlaces(findings, name, outcome);
  if (must_refuse && !findings.hasErrors()) outcome.broken.emplace_back("accepted");
  if (findings.hasErrors() || !outcome.broken.empty()) return outcome;
  const TemporaryFile accepted(scene.resolved_xml, ".xml");
  try {
    touchBriefly(accepted.path(), kTouch, outcome);
  } catch (const InputError& refused) {  // a missing mesh file, a role without a device
    if (refused.diagnostics().errorCount() == 0) outcome.broken.emplace_back("refused without a message");
  }
  return outcome;
}

}  // namespace

Outcome malformedScene(RandomStream& random) {
  static constexpr std::array kScenes{"../config/scenes/cube.xml", "../config/scenes/pinch_and_lift.xml",
                                      "faults/hold.xml"};
  const std::string file = experimentFile(oneOf(kScenes, random));
  std::string text = contentsOf(file);
  for (std::uint64_t n = 1 + random.below(4); n > 0; --n) mutate(text, random);
  return judge(text, file.substr(0, file.rfind('/')), false);
}

/// Entity bombs: nested entities with ten references each, an entity with a large text, an entity that names a local
/// file.
Outcome entityBomb(RandomStream& random) {
  std::string text = contentsOf(experimentFile("faults/hold.xml"));
  std::string types = "<!DOCTYPE scene [<!ENTITY e0 \"0.1\">";
  const std::uint64_t deep = 3 + random.below(30);
  for (std::uint64_t level = 1; level <= deep; ++level) {
    types += "<!ENTITY e" + std::to_string(level) + " \"";
    for (std::uint64_t n = 2 + random.below(10); n > 0; --n) types += "&e" + std::to_string(level - 1) + ";";
    types += "\">";
  }
  if (random.below(2) == 0) types += "<!ENTITY big \"" + std::string(1 << 20, 'x') + "\">";
  if (random.below(2) == 0) types += "<!ENTITY e99 SYSTEM \"file:///etc/hostname\">";
  if (random.below(2) == 0) types += "<!ENTITY % p SYSTEM \"http://localhost/x.dtd\">%p;";
  types += "]>";
  text.insert(text.find("<scene"), types);
  const std::string used = "&e" + std::to_string(deep) + ";";
  text.insert(text.find("<body"), random.below(2) == 0 ? used : "<!-- " + used + " -->");
  return judge(text, ".", true);
}

}  // namespace presa::faults
