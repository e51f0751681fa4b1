#include "framework/diagnostics/diagnostics.h"

#include <gtest/gtest.h>

namespace presa {
namespace {

// Editors and CI systems parse this form; a code has three digits and tells warnings from errors.
TEST(Diagnostics, TextIsFileLineColumnCodeMessageHelp) {
  Diagnostics diagnostics;
  diagnostics.error(203, {"a.xml", 7, 3}, "wrong", "do this");
  diagnostics.warning(220, {"a.xml", 9, 0}, "odd");
  diagnostics.error(101, {"--set a/b=1", 0, 0}, "bad");
  EXPECT_EQ(diagnostics.text(),
            "--set a/b=1: error[E101]: bad\n"
            "a.xml:7:3: error[E203]: wrong\n  help: do this\n"
            "a.xml:9: warning[W220]: odd\n");
}

// A reader works through a file from top to bottom; what is found first is an accident of the program.
TEST(Diagnostics, AreSortedByPlaceAndKeepTheirOrderAtOnePlace) {
  Diagnostics diagnostics;
  diagnostics.error(203, {"b.xml", 1, 1}, "e");
  diagnostics.error(203, {"a.xml", 10, 1}, "d");
  diagnostics.error(203, {"a.xml", 2, 9}, "b");
  diagnostics.error(203, {"a.xml", 2, 9}, "c");
  diagnostics.error(203, {"a.xml", 2, 1}, "a");
  std::string order;
  std::string text = diagnostics.text();
  for (auto at = text.find("]: "); at != std::string::npos; at = text.find("]: ", at + 1)) order += text[at + 3];
  EXPECT_EQ(order, "abcde");
}

// Thousands of findings have one cause. Errors must not be crowded out by warnings that came first.
TEST(Diagnostics, KeepsFiftyErrorsBeforeWarningsAndCountsTheRest) {
  Diagnostics diagnostics;
  for (int i = 0; i < 50; ++i) diagnostics.warning(220, {"a.xml", i + 1, 1}, "odd");
  for (int i = 0; i < 60; ++i) diagnostics.error(203, {"a.xml", i + 1, 1}, "wrong");
  EXPECT_EQ(diagnostics.all().size(), Diagnostics::kLimit);
  EXPECT_EQ(diagnostics.errorCount(), 60U);
  for (const Diagnostic& diagnostic : diagnostics.all()) EXPECT_EQ(diagnostic.severity, Diagnostic::Severity::kError);
  EXPECT_NE(diagnostics.text().find("... and 60 more\n"), std::string::npos);
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics diagnostics;
  diagnostics.warning(220, {}, "odd");
  EXPECT_FALSE(diagnostics.hasErrors());
}

TEST(Diagnostics, InputErrorSaysAllThatWasFound) {
  Diagnostics diagnostics;
  diagnostics.error(203, {"a.xml", 7, 3}, "wrong");
  const InputError error(diagnostics);
  EXPECT_STREQ(error.what(), diagnostics.text().c_str());
}

// One slip of each kind: missing, extra, wrong, swapped letter, wrong case.
TEST(NearestName, FindsOneSlip) {
  const std::vector<std::string> names{"stiffness", "damping", "color", "mass", "name"};
  EXPECT_EQ(nearestName("stifness", names), "stiffness");
  EXPECT_EQ(nearestName("masss", names), "mass");
  EXPECT_EQ(nearestName("colar", names), "color");
  EXPECT_EQ(nearestName("dampign", names), "damping");
  EXPECT_EQ(nearestName("MASS", names), "mass");
}

// A guess far from the word misleads more than none.
TEST(NearestName, StaysSilentWhenNothingIsNear) {
  const std::vector<std::string> names{"mass", "pos", "x"};
  EXPECT_EQ(nearestName("gravity", names), "");
  EXPECT_EQ(nearestName("y", names), "");
  EXPECT_EQ(nearestName("", names), "");
  EXPECT_EQ(nearestName(std::string(1U << 20U, 'm'), names), "");
  EXPECT_EQ(didYouMean("gravity", names), "");
  EXPECT_EQ(didYouMean("mas", names), " (did you mean 'mass'?)");
}

// What a file holds goes to a terminal: never its control characters, never a whole megabyte.
TEST(Quote, ShortensAndDisarms) {
  EXPECT_EQ(quote("a\x1b[2Jb"), "'a?[2Jb'");
  EXPECT_EQ(quote(std::string(100, 'a')), "'" + std::string(60, 'a') + "...'");
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "ü";
  EXPECT_EQ(quote(umlauts), "'" + umlauts + "'");
}

}  // namespace
}  // namespace presa
