#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/common/file_text.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using test::presa;
using test::scratch;
using test::shell;
using test::source;

const std::string kCube = source("config/scenes/cube.xml");
const std::string kSmall = "cost " + kCube + " --for 2.5 --knob dynamics_rate=100,200 --knob coupling=soft,explicit ";

nlohmann::json readJson(const std::string& file) { return nlohmann::json::parse(contentsOf(file)); }

// All errors are reported at once, with the nearest valid name, and nothing is run or written.
TEST(Cost, RefusesBadInputBeforeAnyWork) {
  const std::string out = scratch("never");
  const auto outcome = presa("cost " + kCube +
                             " --knob dynamics_rat=100 --knob coupling= --knob body/cub/pos=1 --knob dynamics_rate=300 "
                             "--metric forc_rms --out " +
                             out);
  EXPECT_EQ(outcome.status, 2);
  for (const char* expected : {"did you mean 'dynamics_rate'?", "knob 'coupling' has no values", "did you mean 'cube'?",
                               "must be a whole number", "did you mean 'force_rms'?"})
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << expected << '\n' << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(out + "/cost.json"));
  EXPECT_FALSE(std::filesystem::exists(out + "/runs"));

  EXPECT_EQ(presa("cost " + kCube + " --knob dynamics_rate=200 --out " + out).status, 2);  // no setting but the default
  const auto idle = presa("cost " + test::source("config/scenes/plane.xml") +
                          " --knob dynamics_rate=100,200 --knob haptic_rate=1000,2000 --knob patch_margin=0.001,0.002");
  EXPECT_EQ(idle.status, 2);
  EXPECT_EQ(
      idle.err,
      "--knob dynamics_rate: error[E816]: knob 'dynamics_rate' does nothing in this scene: nothing in it moves\n"
      "  help: knobs that do something: haptic_rate, renderer, fingertip_radius, latency, haptic_jitter\n"
      "--knob patch_margin: error[E816]: knob 'patch_margin' does nothing in this scene: no finger of it touches a "
      "mesh\n"
      "  help: knobs that do something: haptic_rate, renderer, fingertip_radius, latency, haptic_jitter\n");
  const std::string file = scratch("a_file");
  std::ofstream(file) << "x";
  const auto unwritable = presa(kSmall + "--out " + file + "/below");
  EXPECT_EQ(unwritable.status, 2);
  EXPECT_NE(unwritable.err.find("error[E803]"), std::string::npos) << unwritable.err;
}

// Room for all runs is asked for before the first.
TEST(Cost, RefusesAStudyThatTheDiskHasNoRoomFor) {
  const std::string out = scratch("large");
  const auto outcome = presa("cost " + kCube + " --for 1e9 --knob dynamics_rate=100,200 --out " + out);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("error[E803]: cannot write the study into the folder '" + out + "': its runs need about "),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(out + "/runs"));
}

// A file size limit stops writes as a full disk does. A run that was not written is no result of its setting.
TEST(Cost, StopsOnAFullDiskAndGoesOn) {
  const std::string out = scratch("full"),
                    command = std::string(PRESA_BINARY_DIR) + "/bin/presa " + kSmall + "--out " + out;
  const auto stopped = shell("bash -c \"trap '' XFSZ; ulimit -f 1400; exec " + command + "\"");
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  EXPECT_NE(stopped.err.find("File too large; finished runs are kept"), std::string::npos) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(out + "/cost.json"));
  const auto resumed = shell(command + " --resume");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  for (const auto& setting : readJson(out + "/cost.json").at("settings"))
    EXPECT_TRUE(setting.at("failure").is_null()) << setting;
}

// Errors in a study file have line and column, as in a scene.
TEST(Cost, RefusesABadStudyFile) {
  const std::string file = scratch("study.xml");
  std::ofstream(file) << "<accuracy_cost version=\"1.0\" name=\"s\" scene=\"" << kCube
                      << "\">\n<grid><knob name=\"couplin\" values=\"soft\"/></grid>\n"
                      << "<below metric=\"force\"/>\n<reference><level/></reference>\n</accuracy_cost>\n";
  const auto outcome = presa("cost " + file + " --out " + scratch("never"));
  EXPECT_EQ(outcome.status, 2);
  for (const char* expected :
       {":2:", "did you mean 'coupling'?", ":3:", "no metric 'force'", ":4:", "at least two levels"})
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << expected << '\n' << outcome.err;
}

TEST(Cost, WritesWhatItPromises) {
  const std::string out = scratch("small");
  const auto outcome = presa(kSmall + "--out " + out);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto result = readJson(out + "/cost.json");
  ASSERT_EQ(result.at("settings").size(), 4u);
  EXPECT_EQ(result.at("settings")[0].at("name"), "default");
  EXPECT_EQ(result.at("settings")[0].at("knobs").at("dynamics_rate"), "200");
  EXPECT_EQ(result.at("settings")[0].at("knobs").at("coupling"), "soft");
  for (const auto& setting : result.at("settings")) {
    EXPECT_GT(setting.at("cpu_per_simulated_s").at("median").get<double>(), 0);
    EXPECT_GT(setting.at("memory_B").at("median").get<double>(), 0);
    if (setting.at("failure").is_null()) {
      EXPECT_GT(setting.at("error").at("force_rms").get<double>(), 0);
    }
  }
  const std::string csv = contentsOf(out + "/cost.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  const std::string runs = contentsOf(out + "/runs.csv");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 4 * 5);
  EXPECT_EQ(
      runs.substr(0, runs.find('\n')),
      "setting,\"dynamics_rate\",\"coupling\",repeat,cpu_ms_per_s,busiest_tick_of_period,load_ms,memory_MB,hardware");
  EXPECT_NE(contentsOf(out + "/report.html").find("In words"), std::string::npos);
}

// An interrupted and resumed study gives the same errors as an uninterrupted one; finished runs are kept.
TEST(Cost, GoesOnAfterCtrlC) {
  const std::string whole = scratch("whole"), broken = scratch("broken");
  const std::string study = "cost " + kCube + " --for 1.5 --knob dynamics_rate=50,100,200,250,500,1000 --jobs 1";
  // interrupt as soon as two runs are stored, independent of time
  const auto stopped = shell("sh -c '" + std::string(PRESA_BINARY_DIR) + "/bin/presa " + study + " --out " + broken +
                             " & pid=$!; while kill -0 $pid 2>/dev/null && [ $(ls " + broken +
                             "/runs 2>/dev/null | wc -l) -lt 2 ]; do sleep 0.01; done; kill -INT $pid; wait $pid'");
  ASSERT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_NE(stopped.err.find("--resume"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(broken + "/cost.json"));
  std::map<std::string, std::filesystem::file_time_type> kept;
  for (const auto& entry : std::filesystem::directory_iterator(broken + "/runs"))
    kept[entry.path()] = entry.last_write_time();
  EXPECT_FALSE(kept.empty());
  ASSERT_EQ(presa(study + " --resume --out " + broken).status, 0);
  ASSERT_EQ(presa(study + " --out " + whole).status, 0);
  for (const auto& [file, time] : kept) {
    if (std::filesystem::path(file).extension() != ".json") continue;
    EXPECT_EQ(std::filesystem::last_write_time(file), time) << file;
  }
  const auto a = readJson(broken + "/cost.json"), b = readJson(whole + "/cost.json");
  for (std::size_t i = 0; i < b.at("settings").size(); ++i)
    EXPECT_EQ(a.at("settings")[i].at("error"), b.at("settings")[i].at("error"));
}

// In a real browser the page loads nothing, logs no errors, shows its points, and names the setting under the pointer.
TEST(Cost, TheReportWorksInABrowser) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const std::string out = scratch("page");
  ASSERT_EQ(presa(kSmall + "--out " + out).status, 0);
  std::string page = contentsOf(out + "/report.html");
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  page += R"(<script>
    const points = document.querySelectorAll('[data-name]');
    points[0].dispatchEvent(new PointerEvent('pointerenter'));
    const box = points[0].closest('.plot').querySelector('.readout');
    document.body.dataset.probe = [points.length, performance.getEntriesByType('resource').length, !box.hidden,
      box.firstChild && box.firstChild.textContent === points[0].dataset.name.split('\n')[0]].join(' ');</script>)";
  std::ofstream(scratch("probe.html")) << page;
  const auto seen = shell(
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-quic --no-first-run "
      "--disable-background-networking"
      " --disable-component-update --disable-sync --enable-logging=stderr --user-data-dir=" +
      scratch("profile") + " --dump-dom file://" + scratch("probe.html"));
  const std::size_t at = seen.out.find("data-probe=\"");
  ASSERT_NE(at, std::string::npos) << seen.err;
  std::istringstream probe(seen.out.substr(at + 12));
  int points = 0, requests = -1;
  std::string shown, named;
  probe >> points >> requests >> shown >> named;
  EXPECT_GE(points, 16);  // four settings in both plots of several metrics
  EXPECT_EQ(requests, 0);
  EXPECT_EQ(shown, "true");
  EXPECT_EQ(named.substr(0, 4), "true");
  EXPECT_EQ(seen.err.find("CONSOLE"), std::string::npos) << seen.err;
}

}  // namespace
}  // namespace presa
