// Two scenes in real time: the reported figures follow from the listed runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "framework/session/realtime_rights.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

const std::string kCube = test::source("config/scenes/cube.xml"), kHold = test::source("experiments/faults/hold.xml");

double medianOfThree(std::array<double, 3> values) {
  std::ranges::sort(values);
  return values[1];
}

TEST(Periods, AreComparedInTurn) {
  if (const std::string refused = realtimeRights().fifo; !refused.empty()) {
    const test::Outcome outcome = test::presa("device periods " + kCube + " " + kHold);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("error[E469]"), std::string::npos) << outcome.err;
    return;
  }
  const std::string folder = test::scratch("periods");
  const test::Outcome outcome =
      test::presa("device periods " + kCube + " " + kHold + " --runs 3 --for 0.1 --out " + folder);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto told = nlohmann::json::parse(contentsOf(folder + "/periods.json"));
  ASSERT_EQ(told["runs"].size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(told["runs"][i]["scene"], i % 2 == 0 ? kCube : kHold);
  for (std::size_t p = 0; p < 3; ++p) {
    std::array<double, 2> medians{};
    for (std::size_t s = 0; s < 2; ++s) {
      std::array<double, 3> values{};
      for (std::size_t k = 0; k < 3; ++k) values[k] = told["runs"][2 * k + s]["period_us"][p];
      medians[s] = medianOfThree(values);
    }
    const auto& row = told["all"][p];
    EXPECT_DOUBLE_EQ(row["ratio"], medians[1] / medians[0]);
    EXPECT_LE(row["interval"][0], row["ratio"]);
    EXPECT_GE(row["interval"][1], row["ratio"]);
  }
  std::filesystem::remove_all(folder);
}

TEST(Periods, ABadSceneIsRefusedBeforeAnyRun) {
  const std::string bad = test::scratch("bad.xml");
  std::ofstream(bad) << "<scene/>";
  EXPECT_EQ(test::presa("device periods " + kCube + " " + bad).status, 2);
}

}  // namespace
}  // namespace presa
