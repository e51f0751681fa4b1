// The temple with its guide in a viewer: two processes over DDS, beside one with its own guide.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/temple/kept_session.h"
#include "tests/apps/temple/support.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::temple {
namespace {

using nlohmann::json;

struct LoggedEvent {
  std::string what;  // "placed base drum_1"
  double time;       // [s]
};

/// Events of the guide in the log of a visit; `start`: its first line.
std::vector<LoggedEvent> eventsOf(const std::string& folder, json& start) {
  std::ifstream in(logFile(folder));
  std::vector<LoggedEvent> events;
  for (std::string line; std::getline(in, line);) {
    const json event = json::parse(line);
    const std::string kind = event.at("event");
    if (kind == "start") start = event;
    if (kind == "taken" || kind == "placed" || kind == "finished" || kind == "dropped")
      events.push_back({kind + ' ' + event.value("goal", "-") + ' ' + event.value("body", "-"), event.at("time_s")});
  }
  return events;
}

json summaryOf(const std::string& file) {
  std::ifstream in(file);
  return json::parse(in, nullptr, false);
}

// The simulated hands rebuild the first task: all three blocks are placed, with the same events in the same order as
// with the guide beside the dynamics, and as exactly.
TEST(GuideInViewer, RebuildsTheFirstTaskAsTheRunsOwnGuide) {
  const std::string folder = test::scratch("guide_in_viewer");
  const std::vector<std::string> visit{"temple", "--auto", "--lockstep", "--size", "first", "--language", "en"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), visit.begin(), visit.end());
    return more;
  };
  const BusSettings nowhere{.network = ""}, bus = ownDomain();
  const Said written = say(nowhere, {"temple", "--size", "first", "--write", folder + "/scene"});
  ASSERT_EQ(written.status, 0) << written.text;
  const Said own = say(nowhere, with({"--session", folder + "/own", "--summary", folder + "/own.json"}));
  ASSERT_EQ(own.status, 0) << own.text;

  ViewerProcess run(with({"--session", folder + "/viewer", "--summary", folder + "/viewer.json", "--bus-commands",
                          "--guide", "viewer"}),
                    bus);
  ViewerProcess viewer(
      {"view", "--join", "--guide", "--meshes", folder + "/scene/meshes", "--view", "none", "--wait", "30"}, bus);
  const std::string run_said = run.rest(), viewer_said = viewer.rest();
  EXPECT_EQ(run.end(), 0) << run_said;
  EXPECT_EQ(viewer.end(), 0) << viewer_said;

  json own_start, viewer_start;
  const std::vector<LoggedEvent> beside = eventsOf(folder + "/own", own_start),
                                 remote = eventsOf(folder + "/viewer", viewer_start);
  EXPECT_EQ(own_start.at("guide"), "beside");
  EXPECT_EQ(viewer_start.at("guide"), "viewer");
  ASSERT_EQ(remote.size(), beside.size()) << run_said << viewer_said;
  // the guide looks at 60 Hz beside the dynamics, at each publication (5 ms) in the viewer; a decision waits for the
  // next
  // collision tick (10 ms), the pull rests for one (10 ms), and the hands go on from each block placed
  constexpr double kEach = 1.0 / 60 + 0.005 + 0.01 + 0.01;
  int placed = 0;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    placed += beside[i].what.starts_with("placed") ? 1 : 0;
    EXPECT_EQ(remote[i].what, beside[i].what) << i;
    EXPECT_NEAR(remote[i].time, beside[i].time, kEach * (1 + placed)) << beside[i].what;
  }
  const json here = summaryOf(folder + "/own.json"), there = summaryOf(folder + "/viewer.json");
  EXPECT_EQ(there.at("placed"), 3);
  EXPECT_EQ(there.at("placed"), here.at("placed"));
  // a placed block is fixed at its goal, wherever the choice was made
  EXPECT_LT(there.at("worst_position_error_m").get<double>(), 1e-6);
  EXPECT_LT(here.at("worst_position_error_m").get<double>(), 1e-6);
}

}  // namespace
}  // namespace presa::temple
