#include "framework/core/diagnostics/diagnostics.h"

#include <gtest/gtest.h>

#include "framework/core/diagnostics/printable.h"
#include "framework/core/math/random.h"

namespace presa {
namespace {

// Editors and CI systems parse this form. A code has three digits and the letter E or W.
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

// Findings are sorted by place in the file, because the order of detection is an accident of the program.
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

// Thousands of findings usually have one cause. Warnings that came first must not crowd out errors.
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

// One typing error of each kind: missing, extra, wrong, swapped letter, wrong case.
TEST(NearestName, FindsOneSlip) {
  const std::vector<std::string> names{"stiffness", "damping", "color", "mass", "name"};
  EXPECT_EQ(nearestName("stifness", names), "stiffness");
  EXPECT_EQ(nearestName("masss", names), "mass");
  EXPECT_EQ(nearestName("colar", names), "color");
  EXPECT_EQ(nearestName("dampign", names), "damping");
  EXPECT_EQ(nearestName("MASS", names), "mass");
}

// A distant guess is more misleading than none.
TEST(NearestName, StaysSilentWhenNothingIsNear) {
  const std::vector<std::string> names{"mass", "pos", "x"};
  EXPECT_EQ(nearestName("gravity", names), "");
  EXPECT_EQ(nearestName("y", names), "");
  EXPECT_EQ(nearestName("", names), "");
  EXPECT_EQ(nearestName(std::string(1U << 20U, 'm'), names), "");
  EXPECT_EQ(didYouMean("gravity", names), "");
  EXPECT_EQ(didYouMean("mas", names), " (did you mean 'mass'?)");
}

// Text from a file is printed on a terminal: without control characters, and shortened.
TEST(Quote, ShortensAndDisarms) {
  EXPECT_EQ(quote("a\x1b[2Jb"), "'a?[2Jb'");
  EXPECT_EQ(quote(std::string(100, 'a')), "'" + std::string(60, 'a') + "...'");
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "ü";
  EXPECT_EQ(quote(umlauts), "'" + umlauts + "'");
}

// Control sequences for terminals are shown as escapes; readable text stays unchanged.
TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("cube_2 – würfel 立方体 ὕδωρ 🏺"), "cube_2 – würfel 立方体 ὕδωρ 🏺");
  EXPECT_EQ(printable("a\x1b[2Jb\r\n\t\x07\x7f"), "a\\x1B[2Jb\\x0D\\x0A\\x09\\x07\\x7F");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u{9B}31m");                                                                    // CSI in one character
  EXPECT_EQ(printable("a\u202Etxt.exe\u2066\u200B"), "a\\u{202E}txt.exe\\u{2066}\\u{200B}");  // turned round, no width
  EXPECT_EQ(printable(std::string_view("\0x", 2)), "\\x00x");
  for (const char* bad : {"\x9B", "\xFF", "\xC0\x9B", "\xE0\x82\x9B", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82"})
    EXPECT_EQ(printable(bad).find_first_not_of("\\x0123456789ABCDEF"), std::string::npos) << printable(bad);
  EXPECT_EQ(printable("äöüabc", 3), "äöü...");
  EXPECT_EQ(printable("abc", 3), "abc");
}

// For any bytes, the result is UTF-8 without control characters.
TEST(Printable, LetsNoByteThrough) {
  RandomStream random(1, "bytes");
  for (int i = 0; i < 20000; ++i) {
    std::string bytes(random.below(12), ' ');
    for (char& byte : bytes)
      byte = static_cast<char>(random.below(3) == 0 ? 0x80 + random.below(128) : random.below(256));
    const std::string shown = printable(bytes);
    for (const char c : shown) ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    ASSERT_EQ(printable(shown), shown);  // idempotent: all remaining non-ASCII characters are harmless UTF-8
  }
}

TEST(Diagnostics, AreShownWithoutWhatATerminalWouldObey) {
  Diagnostics diagnostics;
  diagnostics.error(201, {"a\x1b]0;x\x07.xml", 3, 4}, "found \x1b[31m and \xC2\x9B", "two\nlines\x1b");
  EXPECT_EQ(diagnostics.text(),
            "a\\x1B]0;x\\x07.xml:3:4: error[E201]: found \\x1B[31m and \\u{9B}\n  help: two\nlines\\x1B\n");
}

}  // namespace
}  // namespace presa
