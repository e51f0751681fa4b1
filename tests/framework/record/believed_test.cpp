// A recording is used only after it was checked: counts, lengths, times, phases, and where its data are stored.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <functional>
#include <limits>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/reader.h"
#include "framework/record/record_plugin/samples.h"
#include "framework/record/record_plugin/seal.h"
#include "tests/framework/record/damage.h"
#include "tests/framework/record/recording_fixture.h"

namespace presa::record {
namespace {

constexpr std::uint64_t kTicks = 2500;  // three blocks

class Believed : public testing::Test {
 protected:
  void SetUp() override {
    RecordedRun run(recordedSetup(file_, false));
    run.step(kTicks);
    run.recorder->finish();
  }
  void damage(const std::function<void(Damage&)>& work) {
    Damage damage(file_);
    work(damage);
  }
  /// The findings of both readers, which must agree; "" when the file is accepted.
  std::string refusal() const {
    const auto said = [](const std::function<void()>& read) -> std::string {
      try {
        read();
      } catch (const InputError& error) {
        return error.diagnostics().text();
      }
      return {};
    };
    const std::string text = said([&] { readRecording(file_); });
    EXPECT_EQ(text, said([&] { readSamples(file_); }));
    return text;
  }
  /// Expects the damaged file to be refused with a message that contains these words and the file name.
  void expectRefused(const std::function<void(Damage&)>& work, const std::vector<std::string>& words) {
    damage(work);
    const std::string text = refusal();
    EXPECT_NE(text.find(file_ + ": error[E"), std::string::npos) << text;
    for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\nin: " << text;
    SetUpAgain();
  }
  void SetUpAgain() {
    std::filesystem::remove(file_);
    SetUp();
  }

  const ScratchFolder folder_;
  const std::string file_ = folder_.file("run.h5");
};

TEST_F(Believed, AWholeRecordingIs) { EXPECT_EQ(refusal(), ""); }

// Former bugs: 7 and 8 wrote past the fingers, 9 and more past the memory, 0 and -1 were "verified" without a finger.
TEST_F(Believed, CountsAreThoseOfTheFingerTables) {
  for (const std::int64_t count : {7, 8, 9, 1'000'000, 2147483647, 1, 0, -1}) {
    for (const char* column : {"device_count", "command_count"}) {
      expectRefused([&](Damage& d) { d.everyCell("haptic/ticks", column, count); },
                    {"E675", "haptic/ticks", column, "found " + std::to_string(count), "2"});
    }
  }
  expectRefused([](Damage& d) { d.cell("haptic/ticks", "device_count", 1700, std::int64_t{3}); }, {"row 1700"});
}

TEST_F(Believed, TablesOfDifferentLengthAreNotCutToThePartTheyShare) {
  for (const char* table : {"haptic/ticks", "haptic/fingers/index", "haptic/bodies/cube", "schedule/haptic"})
    expectRefused([&](Damage& d) { d.rows(table, 1500); }, {"E673", "1500", "2500"});
  expectRefused([](Damage& d) { d.cell("haptic/fingers/thumb", "index", 2000, std::int64_t{2001}); },
                {"E674", "haptic/fingers/thumb", "index", "row 2000"});
}

TEST_F(Believed, TimesAreThoseOfTheTicks) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double time : {nan, infinite, 0.2, 2.0, -1.0}) {
    for (const char* table : {"haptic/ticks", "haptic/fingers/thumb", "haptic/bodies/cube"})
      expectRefused([&](Damage& d) { d.cell(table, "time", 1999, time); }, {"E674", table, "time", "row 1999"});
  }
  for (const char* column : {"device_time", "command_time", "object_time_end"})
    expectRefused([&](Damage& d) { d.cell("haptic/ticks", column, 12, nan); }, {"E675", column, "row 12"});
  expectRefused([](Damage& d) { d.cell("haptic/ticks", "index", 1000, std::int64_t{5}); }, {"E674", "index"});
  expectRefused([](Damage& d) { d.cell("schedule/dynamics", "index", 400, std::int64_t{3}); },
                {"E674", "schedule/dynamics", "row 400"});
  expectRefused([](Damage& d) { d.cell("schedule/dynamics", "index", 499, std::int64_t{1} << 60); },
                {"E674", "schedule/dynamics", "row 499"});
}

TEST_F(Believed, ValuesOfARowAreInTheirRange) {
  const std::string finger = "haptic/fingers/index";
  expectRefused([&](Damage& d) { d.cell(finger, "phase", 9, std::int64_t{2147483647}); },
                {"E675", finger, "phase", "row 9", "2147483647", "-1 to 65535"});
  expectRefused([&](Damage& d) { d.cell(finger, "phase", 9, std::int64_t{-2}); }, {"phase"});
  expectRefused([&](Damage& d) { d.cell(finger, "valid", 9, std::int64_t{-1}); }, {"valid"});
  expectRefused([&](Damage& d) { d.cell(finger, "mode", 9, std::int64_t{3}); }, {"mode"});
  expectRefused([&](Damage& d) { d.cell(finger, "body", 9, std::int64_t{2}); }, {"body", "-1 to 1"});
  expectRefused([](Damage& d) { d.cell("haptic/ticks", "commanded", 9, std::int64_t{97}); }, {"commanded"});
  expectRefused([](Damage& d) { d.cell("haptic/ticks", "stop_requested", 9, std::int64_t{2}); }, {"stop_requested"});
  expectRefused([](Damage& d) { d.cell("schedule/haptic", "made_up", 9, std::int64_t{8}); }, {"made_up"});
}

TEST_F(Believed, AttributesAreInTheirRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double period : {nan, 0.0, -1e-3, 1e300, 1e-9})
    expectRefused([&](Damage& d) { d.attribute("/", "haptic_period_s", period); }, {"E671", "haptic_period_s"});
  for (const double share : {nan, 0.0, 1.5})
    expectRefused([&](Damage& d) { d.attribute("/", "force_share", share); }, {"E671", "force_share"});
  expectRefused([](Damage& d) { d.attribute("/", "complete", std::uint64_t{7}); }, {"E671", "complete", "7"});
  expectRefused([](Damage& d) { d.attribute("/", "seed", std::string("x")); }, {"E671", "seed"});
  expectRefused([](Damage& d) { d.dropAttribute("/", "start_utc"); }, {"E671", "start_utc"});
  expectRefused([](Damage& d) { d.attribute("haptic/fingers/index", "finger", std::uint64_t{1} << 40); },
                {"E671", "haptic/fingers/index", "finger"});
  expectRefused([](Damage& d) { d.attribute("haptic/fingers/index", "finger", std::uint64_t{0}); }, {"finger"});
  expectRefused([](Damage& d) { d.attribute("haptic/bodies/cube", "body", std::uint64_t{9}); }, {"body", "found 9"});
}

// Storage: all data are in the file itself, unfiltered, under one name.
TEST_F(Believed, NothingIsElsewhere) {
  const std::string outside = folder_.file("outside.h5");
  std::filesystem::copy_file(file_, outside);
  const std::string finger = "haptic/fingers/index";
  for (const std::string path : {finger.c_str(), "haptic/fingers", "haptic", "haptic/ticks", "scene_xml", "schedule"}) {
    expectRefused([&](Damage& d) { d.externalLink(path, outside, "/" + path); }, {"E670", path, "external link"});
    expectRefused([&](Damage& d) { d.softLink(path, "/etc"); }, {"E670", path, "soft link"});
  }
  expectRefused([&](Damage& d) { d.hardLink("haptic/fingers/third", finger); }, {"E670", "haptic/fingers/third"});
  expectRefused([&](Damage& d) { d.virtualTable(finger, outside, "/" + finger); }, {"E670", finger, "virtual"});
  expectRefused([&](Damage& d) { d.externallyStored(finger, outside); }, {"E670", finger, "another file"});
  for (const int filter : {1, 2, 3, 32000})
    expectRefused([&](Damage& d) { d.filtered(finger, filter); }, {"E670", finger, "filter " + std::to_string(filter)});
  expectRefused([&](Damage& d) { d.chunked(finger, 1); }, {"E670", finger, "1024"});
}

// Files of a few kilobytes once made the reader allocate gigabytes. Memory must be bounded by the file's size, not by
// the sizes it claims: the test limits the address space accordingly.
TEST_F(Believed, NoMemoryIsTakenForWhatIsNotStored) {
#ifdef PRESA_SANITIZE
  GTEST_SKIP() << "the sanitizers reserve address space of their own";
#endif
  const auto refused = [&](const std::function<void(Damage&)>& work, const std::vector<std::string>& words) {
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
    const rlimit small{rlim_t{1} << 30, before.rlim_max};
    setrlimit(RLIMIT_AS, &small);
    expectRefused(work, words);
    setrlimit(RLIMIT_AS, &before);
  };
  for (const char* path : {"scene_xml", "rig_xml"}) {
    refused([&](Damage& d) { d.hugeText(path, 1'000'000'000'000); }, {"E673", path, "not stored"});
    // this length is stored in 32 bits and becomes 0, by which HDF5 used to divide
    refused([&](Damage& d) { d.hugeText(path, std::uint64_t{1} << 33); }, {"E672", path, "not one text"});
  }
  for (const char* path : {"haptic/ticks", "haptic/fingers/thumb", "haptic/bodies/cube", "schedule/haptic"}) {
    refused([&](Damage& d) { d.unallocated(path, 40'000'000); }, {"E673", path, "40000000 rows"});
    refused([&](Damage& d) { d.unallocated(path, std::uint64_t{1} << 62); }, {"E673", path});
    // also in a killed run, where the newest rows may be missing; here all are (the column reader needs no schedule)
    if (std::string(path) == "schedule/haptic") continue;
    refused([&](Damage& d) { d.attribute("/", "complete", std::uint64_t{0}), d.unallocated(path, 40'000'000); },
            {"E607"});
  }
}

// Any changed bit of the data, where no rule but the checksum can detect it.
TEST_F(Believed, AChecksumTellsDamageFromDifference) {
  EXPECT_TRUE(readRecording(file_).checksum);
  EXPECT_TRUE(readSamples(file_).checksum);
  const std::string rows = "its rows are not what was recorded", words = "attributes and texts";
  for (const auto& [table, column] : {std::pair{"haptic/fingers/index", "f_command_W_y"},
                                      {"haptic/fingers/thumb", "p_WH_x"},
                                      {"haptic/bodies/cube", "q_WB_w"}})
    expectRefused([&, t = table, c = column](Damage& d) { d.cell(t, c, 2499, 1e-300); }, {"E676", table, rows});
  expectRefused([](Damage& d) { d.cell("schedule/dynamics", "version_3", 0, std::int64_t{1}); },
                {"E676", "schedule/dynamics", rows});
  expectRefused([](Damage& d) { d.attribute("/", "seed", std::uint64_t{1}); }, {"E676", words});
  expectRefused([](Damage& d) { d.attribute("/", "start_utc", std::string("2020-01-01T00:00:00Z")); }, {"E676"});
  expectRefused([](Damage& d) { d.attribute("/", "fault_1", std::string("0.1 s: nothing")); }, {"E676"});
  expectRefused([](Damage& d) { d.attribute("haptic/fingers/index", "fingertip_radius_m", 1.0); }, {"E676"});
  expectRefused([](Damage& d) { d.dropAttribute("/", "sha256"); }, {"E676", "'sha256' is missing"});
  expectRefused([](Damage& d) { d.dropAttribute("haptic/ticks", "sha256"); }, {"E676", "haptic/ticks"});
}

// `inputs` holds names of ports: one per version column at most, none twice.
TEST_F(Believed, NamesOfInputsAreNamesOfPorts) {
  const auto named = [](const std::string& names) {
    return [names](Damage& d) { d.attribute("schedule/haptic", "inputs", names); };
  };
  std::string many = "a0";
  for (int i = 1; i <= ScheduleRow::kMaxBridges; ++i) many += " a" + std::to_string(i);
  expectRefused(named(many), {"E671", "schedule/haptic", "'inputs'", "found 13 names", "up to 12"});
  expectRefused(named("object_state contact_patches object_state"), {"E671", "name 3", "'object_state'"});
  expectRefused(named("object_state contact\x1b[31m"), {"E671", "name 2", "letters"});
  expectRefused([](Damage& d) { d.dropAttribute("schedule/dynamics", "inputs"); },
                {"E671", "schedule/dynamics", "'inputs' is missing"});
  expectRefused([](Damage& d) { d.attribute("schedule/view", "inputs", std::uint64_t{3}); },
                {"E671", "schedule/view", "not a text"});
  // valid names in another order are detected by the checksum
  expectRefused(named("object_state contact_patches"), {"E676", "attributes and texts"});
}

// Format 6 has a checksum and no `inputs`.
TEST_F(Believed, FormatSixNamesNoInputs) {
  EXPECT_TRUE(readRecording(file_).inputs.has_value());
  damage([](Damage& d) {
    std::vector<seal::TableSum> sums;
    for (const char* table : {"haptic/ticks", "haptic/fingers/thumb", "haptic/fingers/index", "haptic/bodies/cube",
                              "schedule/haptic", "schedule/collision", "schedule/dynamics", "schedule/view"}) {
      d.dropAttribute(table, "inputs");
      const h5::Handle object(H5Oopen(d.file(), table, H5P_DEFAULT), H5Oclose, table);
      sums.push_back({table, d.rowsOf(table), h5::readStringAttribute(object, seal::kAttribute)});
    }
    d.attribute("/", "format_version", std::uint64_t{6});
    d.attribute("/", seal::kAttribute, seal::sumOf(d.file(), sums));
  });
  EXPECT_EQ(refusal(), "");
  const Recording recording = readRecording(file_);
  EXPECT_TRUE(recording.checksum);
  EXPECT_FALSE(recording.inputs.has_value());
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

// Recordings of an older format and of killed runs have no checksum; they are read and reported as such.
TEST_F(Believed, WithoutAChecksumItIsSaidToHaveNone) {
  damage([](Damage& d) { d.attribute("/", "format_version", std::uint64_t{5}); });
  EXPECT_EQ(refusal(), "");
  EXPECT_FALSE(readRecording(file_).checksum);
  SetUpAgain();
  damage([](Damage& d) { d.attribute("/", "complete", std::uint64_t{0}); });
  EXPECT_EQ(refusal(), "");
  EXPECT_FALSE(readSamples(file_).checksum);
}

// The tables of a killed run may end at different ticks; the number of incomplete ticks is reported.
TEST_F(Believed, WhatAKilledRunLeftOutIsCounted) {
  damage([](Damage& d) {
    d.attribute("/", "complete", std::uint64_t{0});
    d.rows("haptic/fingers/index", 2100);
  });
  const Recording recording = readRecording(file_);
  EXPECT_EQ(recording.time.size(), 2100u);
  EXPECT_EQ(recording.left_out, 400u);
  EXPECT_EQ(recording.schedule[0].size(), 2100u);
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

TEST_F(Believed, EveryViolationIsSaidAtOnce) {
  damage([](Damage& d) {
    d.cell("haptic/fingers/index", "phase", 9, std::int64_t{70000});
    d.cell("haptic/ticks", "device_count", 3, std::int64_t{9});
    d.attribute("/", "realtime", std::uint64_t{2});
    d.cell("haptic/bodies/cube", "time", 5, 7.0);
  });
  const std::string text = refusal();
  for (const char* word : {"phase", "device_count", "realtime", "haptic/bodies/cube"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\nin: " << text;
}

}  // namespace
}  // namespace presa::record
