#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <vector>

#include "apps/common/report/base64.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/status_line.h"
#include "apps/common/terminal/text.h"

namespace presa {
namespace {

// RFC 4648, section 10.
TEST(Base64, MatchesTheRfc) {
  const std::vector<std::pair<std::string, std::string>> vectors{{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

// Thinning must not lose a single spike among ten thousand samples.
TEST(Plot, DecimationKeepsEveryExtremeAndMovesNoPoint) {
  std::vector<svg::Point> line;
  for (int i = 0; i < 10'000; ++i) line.push_back({i * 1e-3, std::sin(i * 0.01)});
  line[4321].y = 9;
  line[7007].y = -9;
  const auto kept = svg::decimate(line, 0, 10, 100);
  EXPECT_LE(kept.size(), 4 * 101u);
  const auto has = [&](const svg::Point& p) {
    return std::any_of(kept.begin(), kept.end(), [&](const svg::Point& k) { return k.x == p.x && k.y == p.y; });
  };
  EXPECT_TRUE(has(line[4321]));
  EXPECT_TRUE(has(line[7007]));
  EXPECT_TRUE(has(line.front()) && has(line.back()));
  for (const svg::Point& k : kept) EXPECT_EQ(k.y, line[static_cast<std::size_t>(std::lround(k.x * 1000))].y);
}

// Ticks are round numbers inside the axis, printed with the fewest decimals.
TEST(Plot, TicksAreRoundAndInside) {
  const auto ticks = svg::niceTicks(0.031, 0.148, 6);
  ASSERT_EQ(ticks.size(), 6u);
  EXPECT_EQ(svg::tickText(ticks.front(), 0.02), "0.04");
  EXPECT_EQ(svg::tickText(ticks.back(), 0.02), "0.14");
  EXPECT_EQ(svg::tickText(-1e-18, 0.5), "0.0");
  // beside an axis is room for nine characters
  EXPECT_EQ(svg::tickText(5.8e-6, 2e-7), "5.8e-06");
  EXPECT_EQ(svg::tickText(-6e-6, 2e-7), "-6.0e-06");
  EXPECT_EQ(svg::tickText(0, 2e-7), "0");
  EXPECT_EQ(svg::niceTicks(2, 2, 5), std::vector<double>{2});
}

// The line is redrawn in place: if it were wider than the terminal, every refresh would leave a line behind.
TEST(StatusText, FitsTheTerminalAndUsesColourOnlyWhenAsked) {
  LiveStatus status;
  status.time = 2.5;
  status.duration = 10;
  status.phase = "squeeze";
  status.fingers = {{"thumb", ContactMode::kStick, 3.2}, {"index", ContactMode::kSlip, 3.1}};
  for (std::size_t columns = 20; columns < 140; ++columns)
    EXPECT_LE(statusText(status, 12, columns, false).size(), columns);
  const std::string wide = statusText(status, 5, 200, false);
  EXPECT_NE(wide.find("2.5/10.0 s"), std::string::npos);
  EXPECT_NE(wide.find("thumb  3.20 N stick"), std::string::npos);
  EXPECT_NE(wide.find("2 s left"), std::string::npos) << "7.5 s left at five times real time";
  EXPECT_EQ(wide.find('\033'), std::string::npos);
  EXPECT_NE(statusText(status, 5, 200, true).find('\033'), std::string::npos);
}

// At 80 columns the bar makes room for the second finger.
TEST(StatusText, ShowsBothFingersAt80Columns) {
  LiveStatus status;
  status.time = 2.5;
  status.duration = 10;
  status.phase = "squeeze";
  status.fingers = {{"thumb", ContactMode::kStick, 3.2}, {"index", ContactMode::kSlip, 13.1}};
  const std::string line = statusText(status, 12, 79, false);
  EXPECT_NE(line.find("index 13.10 N slip"), std::string::npos) << line;
  EXPECT_NE(line.find("[##"), std::string::npos) << line;
}

TEST(Wrapped, BreaksBetweenWordsAndKeepsEveryOne) {
  const std::string text = "  The grip of 6 N is µₛ-safe: it holds\n  in any direction, at twice the weight.";
  const std::string lines = terminal::wrapped(text, 24, 4);
  std::istringstream read(lines);
  std::size_t count = 0;
  for (std::string line; std::getline(read, line); ++count) EXPECT_LE(terminal::widthOf(line), 24U) << line;
  EXPECT_GE(count, 4U);
  const auto words = [](const std::string& from) {
    std::istringstream stream(from);
    return std::vector<std::string>{std::istream_iterator<std::string>(stream), {}};
  };
  EXPECT_EQ(words(lines), words(text));
  EXPECT_EQ(terminal::wrapped(text, 0, 4), text) << "no terminal";
  EXPECT_EQ(terminal::wrapped("incomprehensibilities", 8, 2), "incomprehensibilities") << "no word is broken";
}

}  // namespace
}  // namespace presa
