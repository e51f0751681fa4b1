// The report of each scene of config/scenes: its sections, plots and tables are there, and hold something.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>

#include "apps/common/file_text.h"
#include "framework/session/load_world.h"
#include "tests/apps/support/support.h"
#include "tests/pictures/scenes.h"

namespace presa {
namespace {

using test::scratch;
using test::source;

/// Text between `begin` and `end`, again and again, from each hit on.
std::vector<std::string> between(const std::string& text, const std::string& begin, const std::string& end) {
  std::vector<std::string> parts;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    parts.push_back(text.substr(at, text.find(end, at) - at));
  }
  return parts;
}

/// Takes out every part from `begin` to `end`.
void cut(std::string& text, const std::string& begin, const std::string& end) {
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    const std::size_t last = text.find(end, at + begin.size());
    ASSERT_NE(last, std::string::npos) << begin << " does not end";
    text.erase(at, last + end.size() - at);
  }
}

/// What a reader sees of the report of a run: without styles, scripts and files to save.
std::string reportOf(const std::string& scene) {
  const std::string file = scratch(scene + ".html");
  const auto run = test::presa("run " + source("config/scenes/" + scene + ".xml") +
                               " --lockstep --quiet --view none --report " + file);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  std::string text = contentsOf(file);
  cut(text, "<style", "</style>");
  cut(text, "<script", "</script>");
  cut(text, "href=\"data:", "\"");
  return text;
}

/// Whether an HTML fragment shows more than headings and captions.
bool holdsSomething(std::string section) {
  cut(section, "<h3>", "</h3>");
  cut(section, "<p class=\"", "</p>");
  cut(section, "<thead>", "</thead>");
  return std::ranges::any_of(std::array{"<td", "<li>", "<p>", "<svg", "<img"},
                             [&](const char* part) { return section.find(part) != std::string::npos; });
}

/// The words of a text that are no number where one should be.
std::set<std::string> noNumbers(const std::string& text) {
  static const std::set<std::string> kNone{"nan", "inf", "NaN", "Infinity", "undefined", "null"};
  std::set<std::string> found;
  std::string word;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      word += c;
      continue;
    }
    if (kNone.contains(word)) found.insert(word);
    word.clear();
  }
  return found;
}

/// Effects push the finger, which touches nothing.
bool touchesNothing(const Scene& scene) {
  static const std::set<std::string> kInTheAir{"guide_path", "guide_wall", "honey", "wind"};
  return kInTheAir.contains(scene.name);
}

/// The titles of the sections that a scene's report has: no finger, no plot of fingers; no contact, none of friction; no
/// free body, no table of them; no joint, no plot of joints.
std::vector<std::string> expectedSections(const Scene& scene) {
  const std::size_t fingers = scene.devices.size();
  const bool free = std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.fixed; });
  const bool apart = scene.name == "pliers";  // each finger presses a handle of its own: no body is held by two
  std::vector<std::string> all;
  if (fingers >= 2 && free && !apart) all.push_back("Grasp");
  if (fingers > 0) all.push_back("Position, grip force and contact state");
  if (fingers > 0 && !touchesNothing(scene)) all.push_back("Friction");
  if (fingers > 0) all.push_back("Contact points");
  if (scene.hasTools()) all.push_back("Tools");
  if (free) all.push_back("Objects");
  if (!scene.joints.empty()) all.push_back("Joints");
  if (std::filesystem::exists(source("config/scenes/printed/" + scene.name + ".xml")))
    all.push_back("Printed and measured");
  all.insert(all.end(), {"Rates", "Faults and notes", "Provenance"});
  return all;
}

/// One plot of joints for each unit of their positions.
std::size_t jointPlots(const Scene& scene) {
  std::set<bool> turning;
  for (const Joint& joint : scene.joints) {
    if (joint.type == JointType::kBall) turning.insert(true);
    for (const JointAxis& axis : joint.axes) turning.insert(axis.turns);
  }
  return turning.size();
}

class ScenePage : public testing::TestWithParam<std::string> {};

TEST_P(ScenePage, HasSectionsAndPlotsThatHoldSomething) {
  Diagnostics diagnostics;
  const Loaded loaded = loadWorld({source("config/scenes/" + GetParam() + ".xml"), "", {}}, {}, diagnostics);
  const Scene& scene = loaded.world->scene;
  const std::size_t fingers = scene.devices.size();
  const std::string page = reportOf(GetParam());

  EXPECT_EQ(between(page, "<h2>", "</h2>"), expectedSections(scene));
  for (const std::string& section : between(page, "<h2>", "<h2>"))
    EXPECT_TRUE(holdsSomething(section.substr(section.find("</h2>")))) << section.substr(0, section.find("</h2>"));
  EXPECT_EQ(between(page, "<h1>", "</h1>"), std::vector<std::string>{scene.name});
  EXPECT_EQ(noNumbers(page), std::set<std::string>{});

  const std::vector<std::string> plots = between(page, "<svg", "</svg>");
  const std::size_t expected = (touchesNothing(scene) ? 1 : 2) * fingers + jointPlots(scene);
  EXPECT_EQ(plots.size(), expected) << "over time, of friction, and of joints";
  EXPECT_EQ(between(page, "download=\"", "\"").size(), 2 * expected) << "SVG and CSV of each";
  for (const std::string& plot : plots) {
    const std::vector<std::string> curves = between(plot, "<path class=\"", ">");
    EXPECT_FALSE(curves.empty()) << plot.substr(0, 300);
    for (const std::string& path : between(plot, " d=\"", "\"")) EXPECT_NE(path, "");
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, ScenePage, testing::ValuesIn(test::shippedScenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace presa
