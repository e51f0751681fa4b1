#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/export/csv.h"
#include "apps/experiment/export/staging.h"
#include "apps/experiment/operator/operator.h"
#include "apps/experiment/session.h"
#include "experiments/runner/definition/read.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin.h"
#include "tests/apps/experiment/bids_files.h"
#include "tests/apps/experiment/bids_rules.h"
#include "tests/apps/experiment/contents.h"
#include "tests/apps/experiment/refusal.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kSource = PRESA_SOURCE_DIR;
bool goOn(const std::string&) { return true; }

/// Two sessions of scripted fingers, run once for all tests, and their exports.
class ExportTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    for (const char* id : {"S01", "S02"}) runSession(id, data(), true);
    ASSERT_TRUE(exportBids(sourceSessions(data()), bids(), {}, goOn));
    ASSERT_TRUE(exportCsv(sourceSessions(data()), csv(), 100, goOn));
  }
  static void runSession(const std::string& id, const std::string& data, bool recording) {
    Diagnostics diagnostics;
    SessionStart start;
    start.experiment_file = kSource + "/tests/apps/experiment/fixtures/lift.xml";
    const auto experiment = readExperiment(start.experiment_file, "", diagnostics);
    ASSERT_EQ(diagnostics.text(), "");
    start.subject = {id, id.back() - '0'};
    start.model = experiment->model;
    start.seed = experiment->seed;
    start.recording = recording;
    auto session = SubjectSession::begin(*experiment, start, data);
    ASSERT_EQ(session.run(*silentOperator(1), "en"), SubjectSession::End::kComplete);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string data() { return folder_->file("data"); }
  static std::string bids() { return folder_->file("bids"); }
  static std::string csv() { return folder_->file("csv"); }
  static SessionLog logOf(const std::string& id) {
    const SessionFolder folder = folderOf(data(), id, 1);
    return readLog(folder.journal(), Journal::read(folder.journal()).records);
  }
  static std::string copyOf(const std::string& what) {
    const std::string copy = what + "_copy";
    fs::remove_all(copy);
    fs::copy(what, copy, fs::copy_options::recursive);
    return copy;
  }
  static std::unique_ptr<ScratchFolder> folder_;
};
std::unique_ptr<ScratchFolder> ExportTest::folder_;

TEST_F(ExportTest, BidsPassesTheRules) { EXPECT_THAT(bids::violations(bids()), IsEmpty()); }

// Checks any dataset: PRESA_BIDS=folder.
TEST(Bids, ADatasetThatIsNamedPassesTheRules) {
  const char* folder = std::getenv("PRESA_BIDS");
  if (folder == nullptr) GTEST_SKIP() << "PRESA_BIDS names none";
  EXPECT_THAT(bids::violations(folder), IsEmpty());
}

// The rules are effective: each change violates one of them and is found.
TEST_F(ExportTest, TheRulesFindWhatIsBroken) {
  const std::string session = "/sub-S01/ses-1/", stem = "sub-S01_ses-1_task-lift",
                    run = stem + "_tracksys-presa_run-001_";
  const auto replaceIn = [](const std::string& file, const std::string& from, const std::string& to) {
    std::string text = contentsOf(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << file << " has no " << from;
    std::ofstream(file, std::ios::binary) << text.replace(at, from.size(), to);
  };
  struct Break {
    std::string what;
    std::function<void(const std::string&)> act;
  };
  const auto rename = [&](const std::string& from, const std::string& to) {
    return [=](const std::string& root) { fs::rename(root + session + from, root + session + to); };
  };
  const auto edit = [&](const std::string& file, const std::string& from, const std::string& to) {
    return [=](const std::string& root) { replaceIn(root + file, from, to); };
  };
  const std::string motion = session + "motion/" + run, third = session + "motion/" + stem + "_tracksys-presa_run-003_";
  const std::vector<Break> breaks{
      {"out of order", rename("beh/" + stem + "_beh.tsv", "beh/sub-S01_task-lift_ses-1_beh.tsv")},
      {"needs task", rename("beh/" + stem + "_beh.tsv", "beh/sub-S01_ses-1_beh.tsv")},
      {"no file of this suffix", rename("beh/" + stem + "_beh.tsv", "motion/" + stem + "_beh.tsv")},
      {"formats: task", rename("beh/" + stem + "_beh.tsv", "beh/sub-S01_ses-1_task-li+ft_beh.tsv")},
      {"no channels.tsv", [&](const std::string& root) { fs::remove(root + motion + "channels.tsv"); }},
      {"a header row", edit(motion + "motion.tsv", "0.000000", "latency")},
      {"columns are not the rows", edit(motion + "motion.tsv", "0.000000\t", "0.000000\t0\t")},
      {"type pos", edit(motion + "channels.tsv", "POS", "pos")},
      {"POS needs an axis", edit(motion + "channels.tsv", "thumb_pos_x\tx", "thumb_pos_x\tn/a")},
      {"positions in m", edit(motion + "channels.tsv", "POS\tthumb\tm", "POS\tthumb\tmm")},
      {"name is not where", edit(motion + "channels.tsv", "name\tcomponent", "component\tname")},
      {"needs SamplingFrequency", edit(motion + "motion.json", "\"SamplingFrequency\"", "\"Rate\"")},
      {"SamplingFrequencyEffective", edit(motion + "motion.json", "Effective\": ", "Effective\": 1")},
      {"MISCChannelCount", edit(motion + "motion.json", "\"MISCChannelCount\": 1", "\"MISCChannelCount\": 2")},
      {"TRACKSYS_MISMATCH", edit(motion + "motion.json", "\"presa\"", "\"other\"")},
      {"EVENT_ONSET_ORDER", edit(third + "events.tsv", "\n0.000000", "\n9999.000000")},
      {"duration >= 0", edit(motion + "events.tsv", "0.000000\t", "0.000000\t-")},
      {"needs a corresponding data file",
       rename("motion/" + run + "events.tsv", "motion/" + stem + "_tracksys-presa_run-999_events.tsv")},
      {"SCANS_FILENAME_NOT_MATCH", edit(session + "sub-S01_ses-1_scans.tsv", "beh/sub-S01", "beh/sub-S09")},
      {"shifted dates", edit(session + "sub-S01_ses-1_scans.tsv", "1900-", "2026-")},
      {"PARTICIPANT_ID_MISMATCH", edit("/participants.tsv", "sub-S02", "sub-S03")},
      {"is not described", edit(session + "beh/" + stem + "_beh.json", "\"F_grip\"", "\"Grip\"")},
      {"a row has another number", edit(session + "beh/" + stem + "_beh.tsv", "\taborted", "\taborted\taborted")},
      {"missing is n/a", edit(session + "beh/" + stem + "_beh.tsv", "\tn/a", "\t")},
      {"needs a string BIDSVersion", edit("/dataset_description.json", "BIDSVersion", "Version")},
      {"no such file or folder", [](const std::string& root) { std::ofstream(root + "/notes.txt") << "mine"; }},
      {"two dictionaries at one level", [&](const std::string& root) {
         fs::copy_file(root + session + "motion/" + stem + "_tracksys-presa_events.json",
                       root + motion + "events.json");
       }}};
  for (const Break& one : breaks) {
    const std::string copy = copyOf(bids());
    one.act(copy);
    EXPECT_THAT(bids::violations(copy), Contains(HasSubstr(one.what)));
  }
}

// The table of behaviour agrees with the log: same runs, same numbers, units in the dictionary.
TEST_F(ExportTest, BehaviourIsWhatWasLogged) {
  const SessionLog log = logOf("S02");
  const std::string base = bids() + "/sub-S02/ses-1/beh/sub-S02_ses-1_task-lift_beh";
  const bids::Table table = bids::readTsv(base + ".tsv", true);
  ASSERT_EQ(table.rows.size(), log.runs.size());
  const auto cell = [&](std::size_t row, const char* name) {
    return table.rows[row].at(static_cast<std::size_t>(table.column(name)));
  };
  for (std::size_t i = 0; i < log.runs.size(); ++i) {
    const LoggedRun& run = log.runs[i];
    EXPECT_EQ(cell(i, "trial"), std::to_string(run.number));
    EXPECT_EQ(cell(i, "outcome"), toString(run.outcome));
    EXPECT_EQ(cell(i, "motion_run"), std::to_string(i + 1));
    const Json& grip = run.end.at("values").at("F_grip");
    if (grip.is_null())
      EXPECT_EQ(cell(i, "F_grip"), "n/a");
    else
      EXPECT_EQ(std::stod(cell(i, "F_grip")), grip.get<double>());
  }
  EXPECT_EQ(bids::readJson(base + ".json")["F_grip"]["Units"], "N");
  EXPECT_EQ(bids::readJson(base + ".json")["mass"]["Units"], "kg");
}

// Positions [m] and forces [N] equal those of the recording in single precision.
TEST_F(ExportTest, MotionIsWhatWasRecorded) {
  const LoggedRun run = logOf("S01").runs.at(2);
  const RecordedSamples samples = recordPlugin().samples(folderOf(data(), "S01", 1).file(run.files().front()));
  const std::string base = bids() + "/sub-S01/ses-1/motion/sub-S01_ses-1_task-lift_tracksys-presa_run-003_";
  const bids::Table rows = bids::readTsv(base + "motion.tsv", false),
                    names = bids::readTsv(base + "channels.tsv", true);
  ASSERT_EQ(rows.rows.size(), samples.time.size());
  const auto check = [&](const std::string& channel, const std::vector<double>& values) {
    std::size_t c = 0;
    while (names.rows.at(c)[0] != channel) ++c;
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(std::stof(rows.rows[i][c]), static_cast<float>(values[i])) << channel << " " << i;
  };
  check("index_pos_x", samples.fingers.at(1).values("p_WH_x"));
  check("thumb_force_x", samples.fingers.at(0).values("f_command_W_x"));
  check("thumb_fn", samples.fingers.at(0).values("normal_force"));
  check("cube_pos_z", samples.bodies.at(0).values("p_WB_z"));
  check("cube_quat_w", samples.bodies.at(0).values("q_WB_w"));
}

// Every phase that was reached is an event at the time in the log, in the time of the motion file.
TEST_F(ExportTest, EventsAreThePhases) {
  const LoggedRun run = logOf("S01").runs.at(2);
  const bids::Table events =
      bids::readTsv(bids() + "/sub-S01/ses-1/motion/sub-S01_ses-1_task-lift_tracksys-presa_run-003_events.tsv", true);
  std::size_t row = 0;
  for (const auto& [phase, stretch] : run.end.at("phases").at(0).items()) {
    if (stretch.at(0).is_null()) continue;
    EXPECT_EQ(events.rows.at(row)[2], phase);
    EXPECT_NEAR(std::stod(events.rows.at(row)[0]), stretch.at(0).get<double>(), 5e-7);  // six decimals
    ++row;
  }
  EXPECT_EQ(events.rows.size(), row);
}

TEST_F(ExportTest, AModelIsNoPerson) {
  const bids::Table table = bids::readTsv(bids() + "/participants.tsv", true);
  for (const auto& row : table.rows) {
    EXPECT_EQ(row.at(static_cast<std::size_t>(table.column("species"))), "n/a");
    EXPECT_EQ(row.at(static_cast<std::size_t>(table.column("model"))), "scripted fingers: no person");
  }
  EXPECT_THAT(contentsOf(bids() + "/README"), HasSubstr("are models, not people"));
}

// An exported dataset names neither the machine nor the date.
TEST_F(ExportTest, NamesNoMachineAndNoDay) {
  for (const auto& [file, text] : allBytesOf(bids())) {
    EXPECT_EQ(text.find(kSource), std::string::npos) << file;
    EXPECT_EQ(text.find("=\"/"), std::string::npos) << file;
    EXPECT_EQ(text.find(logOf("S01").runs.front().begin.at("utc").get<std::string>().substr(0, 10)), std::string::npos)
        << file;
  }
}

TEST_F(ExportTest, CsvHoldsAllSessionsAndTheRateThatWasAsked) {
  const std::string trials = contentsOf(csv() + "/trials.csv");
  EXPECT_THAT(trials, HasSubstr(",mass [kg],"));
  EXPECT_EQ(std::count(trials.begin(), trials.end(), '\n'),
            static_cast<std::ptrdiff_t>(1 + logOf("S01").runs.size() + logOf("S02").runs.size()));
  const LoggedRun run = logOf("S02").runs.at(3);
  const std::string stem = fs::path(run.files().front()).stem().string();
  EXPECT_THAT(trials, HasSubstr(",timeseries/sub-S02_ses-1_" + stem + ".csv\n"));
  std::istringstream series(contentsOf(csv() + "/timeseries/sub-S02_ses-1_" + stem + ".csv"));
  std::string line;
  std::getline(series, line);
  EXPECT_THAT(line, testing::StartsWith("time [s],thumb_pos_x [m],"));
  int k = 0;
  for (; std::getline(series, line); ++k) ASSERT_EQ(line.substr(0, line.find(',')), std::to_string(0.01 * k));
  const auto ticks = recordPlugin().samples(folderOf(data(), "S02", 1).file(run.files().front())).time.size();
  EXPECT_EQ(k, static_cast<int>((ticks + 9) / 10));
}

TEST_F(ExportTest, ARateThatWasNotRecordedIsRefused) {
  const std::string out = folder_->file("too_fast");
  EXPECT_THAT(refusalOf([&] { exportCsv(sourceSessions(data()), out, 5000, goOn); }), HasSubstr("error[E935]"));
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(ExportTest, NothingAlteredIsExported) {
  const std::string copy = copyOf(data()), out = folder_->file("altered");
  std::fstream file(folderOf(copy, "S02", 1).file(logOf("S02").runs.back().files().front()),
                    std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(100000);
  file.put('x');
  file.close();
  EXPECT_THAT(refusalOf([&] { exportBids(sourceSessions(copy), out, {}, goOn); }), HasSubstr("error[E931]"));
  EXPECT_THAT(refusalOf([&] { exportCsv(sourceSessions(copy), out, 0, goOn); }), HasSubstr("error[E931]"));
  std::ofstream(folderOf(copy, "S01", 1).file("trials.csv"), std::ios::app) << " ";
  EXPECT_THAT(refusalOf([&] { sourceSessions(copy); }), HasSubstr("trials.csv: error[E931]"));
  for (const auto& entry : fs::directory_iterator(folder_->path()))
    EXPECT_THAT(entry.path().filename().string(), testing::Not(HasSubstr("altered")));
}

// Ctrl-C between two recordings leaves no partial export.
TEST_F(ExportTest, HalfAnExportIsNotLeftBehind) {
  const std::string out = folder_->file("half");
  int recordings = 0;
  const Continue stop = [&](const std::string&) { return ++recordings < 3; };
  EXPECT_FALSE(exportBids(sourceSessions(data()), out, {}, stop));
  EXPECT_EQ(recordings, 3);
  for (const auto& entry : fs::directory_iterator(folder_->path()))
    EXPECT_THAT(entry.path().filename().string(), testing::Not(HasSubstr("half")));
}

// A session without recordings is exported as behaviour only.
TEST_F(ExportTest, ASessionWithoutRecordings) {
  const std::string bare = folder_->file("bare"), out = folder_->file("bare_bids");
  runSession("S03", bare, false);
  ASSERT_TRUE(exportBids(sourceSessions(bare), out, {}, goOn));
  EXPECT_THAT(bids::violations(out), IsEmpty());
  EXPECT_TRUE(fs::exists(out + "/sub-S03/ses-1/beh"));
  EXPECT_FALSE(fs::exists(out + "/sub-S03/ses-1/motion"));
  EXPECT_TRUE(exportCsv(sourceSessions(bare), folder_->file("bare_csv"), 0, goOn));
}

TEST_F(ExportTest, NothingIsOverwritten) {
  const auto before = allBytesOf(csv());
  EXPECT_THAT(refusalOf([&] { exportBids(sourceSessions(data()), csv(), {}, goOn); }), HasSubstr("error[E933]"));
  EXPECT_EQ(allBytesOf(csv()), before);
}

TEST_F(ExportTest, OneNameIsNotGivenTwice) {
  const std::string copy = copyOf(data());
  fs::create_directories(copy + "/again");
  fs::copy(copy + "/sub-S01", copy + "/again/sub-S01", fs::copy_options::recursive);
  EXPECT_THAT(refusalOf([&] { sourceSessions(copy); }), HasSubstr("error[E932]"));
}

// Runs the Python lines of the manual literally.
TEST_F(ExportTest, ThePythonOfTheManualReadsIt) {
  if (std::system("python3 -c 'import csv' 2>/dev/null") != 0) GTEST_SKIP() << "python3 is not installed";
  const std::string manual = contentsOf(kSource + "/experiments/README.md"), fence = "```python\n";
  const std::size_t begin = manual.find(fence) + fence.size();
  std::ofstream(folder_->file("read.py")) << manual.substr(begin, manual.find("```", begin) - begin);
  fs::create_directory_symlink(csv(), folder_->file("data_csv"));
  const std::string command = "cd " + folder_->path().string() + " && python3 read.py > printed 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << contentsOf(folder_->file("printed"));
  // expected output, computed from the logs
  std::map<std::string, std::vector<double>> grips;
  for (const char* id : {"S01", "S02"}) {
    for (const LoggedRun& run : logOf(id).runs) {
      if (run.outcome == Outcome::kDone && !run.practice && run.end.value("excluded", "").empty())
        grips[run.begin["condition"]["mass"]].push_back(run.end["values"]["F_grip"]);
    }
  }
  std::string expected;
  for (const auto& [mass, all] : grips) {
    double sum = 0;
    for (const double grip : all) sum += grip;
    std::array<char, 64> line{};
    std::snprintf(line.data(), line.size(), "%s kg: %.3f N, n = %zu\n", mass.c_str(),
                  sum / static_cast<double>(all.size()), all.size());
    expected += line.data();
  }
  EXPECT_EQ(contentsOf(folder_->file("printed")), expected);
}

TEST(StagedFolder, RemovesWhatAKilledProcessLeft) {
  ScratchFolder scratch;
  fs::create_directories(scratch.file(".presa-export-out.abcdef/sub-S01"));
  fs::create_directories(scratch.file(".presa-export-other.abcdef"));
  const StagedFolder at_work(scratch.file("out"));
  at_work.write("a/b.txt", "b");
  EXPECT_FALSE(fs::exists(scratch.file(".presa-export-out.abcdef")));
  EXPECT_TRUE(fs::exists(scratch.file(".presa-export-other.abcdef")));
  {
    StagedFolder second(scratch.file("out"));  // must not remove the folder of the first, which is in use
    second.write("c.txt", "c");
    second.publish();
  }
  EXPECT_EQ(contentsOf(scratch.file("out/c.txt")), "c");
  EXPECT_FALSE(fs::exists(scratch.file("out/a")));
}

}  // namespace
}  // namespace presa::experiment
