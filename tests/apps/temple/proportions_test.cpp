#include <gtest/gtest.h>

#include <fstream>

#include "apps/temple/building/shipped.h"
#include "framework/scene/xml/xml.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

std::string replaced(std::string text, const std::vector<std::pair<std::string, std::string>>& changes) {
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
  }
  return text;
}

std::string findings(const std::string& text) {
  const std::string file = test::scratch("findings") + "/temple.xml";
  std::ofstream(file) << text;
  Diagnostics diagnostics;
  readProportions(file, diagnostics);
  return diagnostics.text();
}

TEST(Proportions, ShippedOnesAreGood) {
  for (const std::string& name : shippedNames()) {
    Diagnostics diagnostics;
    EXPECT_EQ(shippedProportions(name, diagnostics).name, name);
    EXPECT_EQ(diagnostics.text(), "");
  }
}

// A name of a building says its size and its plan, and goes back to them.
TEST(Proportions, EachPlanHasItsBuildings) {
  for (const std::string& plan : shippedPlans()) {
    for (const char* const size : {"column", "facade"}) {
      const std::string name = buildingName(size, plan);
      EXPECT_EQ(sizeAndPlan(name), std::pair(std::string(size), plan));
      Diagnostics diagnostics;
      EXPECT_EQ(shippedProportions(name, diagnostics).name, name);
      EXPECT_EQ(diagnostics.text(), "");
    }
    EXPECT_EQ(buildingName("first", plan), "first");
  }
}

// Measures of the Parthenon in metres, as books give them, over half of its lower diameter; to half of the last digit of
// the files.
TEST(Proportions, TheParthenonsAreThoseOfBooks) {
  Diagnostics diagnostics;
  const Proportions p = shippedProportions("parthenon_facade", diagnostics);
  ASSERT_EQ(diagnostics.text(), "");
  const double module = 1.905 / 2;
  EXPECT_NEAR(p.full_size, module, 1e-12);
  EXPECT_NEAR(p.column.height, 10.433 / module, 5e-4);
  EXPECT_NEAR(p.column.upper_diameter, 1.481 / module, 5e-4);
  for (const double interval : p.entablature->intervals) EXPECT_NEAR(interval, 4.296 / module, 5e-4);
  EXPECT_NEAR(p.entablature->architrave_height, 1.35 / module, 5e-4);
  EXPECT_NEAR(p.entablature->triglyph_width, 0.845 / module, 5e-4);
  EXPECT_NEAR(p.entablature->frieze_height + p.entablature->band_height, 1.35 / module, 1e-3);  // a sum of two
  EXPECT_NEAR(2 * p.entablature->triglyphSpacing(), 4.296 / module, 5e-4);
}

TEST(Proportions, EveryMeasureNamesItsSource) {
  for (const char* text :
       {shipped::first, shipped::column, shipped::facade, shipped::parthenon_column, shipped::parthenon_facade}) {
    Diagnostics diagnostics;
    const auto document = xml::Document::parse(text, "shipped", diagnostics);
    for (const auto& part : document->root().children()) {
      const auto measures = part.name() == "module" ? std::vector{part} : part.children();
      for (const auto& measure : measures) EXPECT_GT(measure.attribute("source").size(), 8U) << measure.label();
    }
  }
}

TEST(Proportions, EverythingThatAFileGetsWrongIsToldAtOnce) {
  const std::string text = findings(replaced(shipped::facade, {{"<drums value=\"3\"", "<drums value=\"many\""},
                                                               {"<density value=\"2000\" ", "<density value=\"-1\" "},
                                                               {"<joint ", "<joimt "},
                                                               {"source=\"Vitruvius IV.3.5: one module wide\"", ""}}));
  for (const char* expected : {"many", "-1", "did you mean 'joint'", "source"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << " is not in:\n" << text;
  EXPECT_NE(text.find("temple.xml:"), std::string::npos) << text;
}

TEST(Proportions, WhatDoesNotFitIsToldAtOnce) {
  const std::string text =
      findings(replaced(shipped::facade, {{"<lightest value=\"0.05\"", "<lightest value=\"0.5\""},
                                          {"<upper_diameter value=\"1.6667\"", "<upper_diameter value=\"2.1\""},
                                          {"<dowel_width value=\"0.6\"", "<dowel_width value=\"1.5\""},
                                          {"<intervals value=\"5 7.5 5\"", "<intervals value=\"5 7 5\""},
                                          {"<height value=\"0.1111\"", "<height value=\"0.5\""}}));
  for (const char* expected :
       {"error[E975]", "2.1 modules thick", "1.5 modules leaves no rim", "an interval of 7 modules", "error[E973]"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << " is not in:\n" << text;
}

TEST(Proportions, APedimentNeedsACornice) {
  std::string text = shipped::facade;
  const std::size_t from = text.find("  <entablature>"), to = text.find("  <pediment>");
  EXPECT_NE(findings(text.erase(from, to - from)).find("error[E973]"), std::string::npos);
}

TEST(Proportions, NamesThatAreNearlyRight) {
  Diagnostics diagnostics;
  shippedProportions("facde", diagnostics);
  EXPECT_NE(diagnostics.text().find("did you mean 'facade'"), std::string::npos) << diagnostics.text();
}

}  // namespace
}  // namespace presa::temple
