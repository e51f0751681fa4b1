#include <gtest/gtest.h>

#include "apps/common/file_text.h"
#include "framework/scene/load.h"
#include "framework/scene/xml/source_scan.h"
#include "tests/apps/presa/files/program.h"

// Small files that demand much: refused by their counts, before anything is built from them.
namespace presa {
namespace {

using test::Bench;
using test::Outcome;

/// The experiment of the fixtures with `factors` before its design, and the design's attributes replaced.
void writeExperiment(const Bench& bench, const std::string& factors, const std::string& design = "repeats=\"2\"") {
  std::string text = contentsOf(test::kSource + "/tests/apps/experiment/fixtures/lift.xml");
  const std::string old_scene = "../../../../experiments/grip_slip/scene.xml",
                    old_design = "<design repeats=\"2\" practice=\"1\"/>";
  text.replace(text.find(old_scene), old_scene.size(), test::kSource + "/experiments/grip_slip/scene.xml");
  text.replace(text.find(old_design), old_design.size(), factors + "<design " + design + "/>");
  bench.write("experiment.xml", text);
}

std::string factor(const std::string& name, int levels) {
  std::string text = "<factor name=\"" + name + "\"><column name=\"" + name + "_value\"/>";
  for (int level = 0; level < levels; ++level) text += "<level values=\"" + std::to_string(level) + "\"/>";
  return text + "</factor>";
}

void expectRefused(const Outcome& outcome, const std::string& words) {
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("error[E694]"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
}

TEST(PlanSize, ManyFactorsAreCountedNotBuilt) {
  const Bench bench;
  std::string factors;
  for (const std::string name : {"a", "b", "c", "d", "e", "f"}) factors += factor(name, 60);
  writeExperiment(bench, factors);
  const std::string words =
      "make 186624000000 conditions (2 x 2 x 60 x 60 x 60 x 60 x 60 x 60), at most 1000 are possible";
  expectRefused(bench.presa("experiment dry-run experiment.xml"), words);
  expectRefused(bench.presa("experiment run experiment.xml --subject S01 --lockstep --data data"), words);
}

TEST(PlanSize, ManyLevelsAreCountedNotBuilt) {
  const Bench bench;
  writeExperiment(bench, factor("a", 5000), "order=\"balanced_latin_square\"");
  expectRefused(bench.presa("experiment dry-run experiment.xml"), "make 20000 conditions (2 x 2 x 5000), at most 1000");
}

TEST(PlanSize, ManyRepeatsAreCountedNotBuilt) {
  const Bench bench;
  writeExperiment(bench, factor("a", 10), "repeats=\"999\" no_immediate_repeat=\"true\"");
  expectRefused(bench.presa("experiment dry-run experiment.xml"), "would have 39960 trials, at most 10000");
}

// Plans within the limits are accepted.
TEST(PlanSize, WhatIsAllowedIsPlanned) {
  const Bench bench;
  writeExperiment(bench, factor("a", 20), "repeats=\"10\"");
  const Outcome outcome = bench.presa("experiment dry-run experiment.xml --format csv");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1 + 2 * 2 * 20 * 10);
}

std::string sceneWith(std::size_t attributes) {
  std::string text = "<scene version=\"1.0\" name=\"x\"";
  for (std::size_t i = 2; i < attributes; ++i) text += " a" + std::to_string(i) + "=\"1\"";
  return text + "/>";
}

bool crowded(const std::string& xml) {
  Diagnostics findings;
  parseScene(xml, "scene.xml", "/lab", {}, findings);
  return findings.text().find("E695") != std::string::npos;
}

// libxml2 compares every attribute of an element with every other: 40 000 took 33 s.
TEST(CrowdedXml, AttributesOfAnElementAreBounded) {
  EXPECT_FALSE(crowded(sceneWith(xml::kMaxAttributes)));
  EXPECT_TRUE(crowded(sceneWith(xml::kMaxAttributes + 1)));
  const Bench bench;
  bench.write("scene.xml", sceneWith(40'000));
  const Outcome outcome = bench.presa("check scene.xml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.text.find("scene.xml:1:2211: error[E695]: this element has more than 256 attributes: 'a256'"),
            std::string::npos)
      << outcome.text;
}

// Five bytes of file need 300 bytes of memory.
TEST(CrowdedXml, ElementsOfAFileAreBounded) {
  std::string text = "<scene>";
  for (std::size_t i = 0; i < xml::kMaxElements; ++i) text += "<a/>";
  EXPECT_TRUE(crowded(text + "</scene>"));
}

}  // namespace
}  // namespace presa
