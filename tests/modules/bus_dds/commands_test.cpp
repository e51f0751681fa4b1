// Commands from one process to a run in another, over loopback.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/bus/parameter_server.h"
#include "framework/bus/publisher.h"
#include "framework/core/schedule/clock.h"
#include "framework/record/checksum/checksum.h"
#include "framework/record/record_plugin.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::bus {
namespace {

const std::string kWait = "30";

Said set(const BusSettings& bus, const std::string& what) { return say(bus, {"bus", "set", what, "--wait", kWait}); }

template <class Done>
bool within(const Done& done) {
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
  while (!done()) {
    if (monotonicNs() > end) return false;
    sleepUntilNs(monotonicNs() + 5'000'000);
  }
  return true;
}

// Every field arrives unchanged, numbers to the bit, NaN included.
TEST(BusCommands, ArriveToTheBit) {
  const BusSettings bus = ownDomain();
  const auto post = openPost(bus);
  post->show({9, "material/rubber/stiffness", 500.5, 1, 1000, 3});
  const auto commander = openCommander(bus);  // joins late, and still receives the parameters
  std::vector<OpenParameter> parameters;
  ASSERT_TRUE(within([&] {
    for (auto& parameter : commander->take().parameters) parameters.push_back(parameter);
    return !parameters.empty();
  }));
  EXPECT_EQ(parameters[0].run, 9u);
  EXPECT_EQ(parameters[0].name, "material/rubber/stiffness");
  EXPECT_EQ(parameters[0].value, 500.5);
  EXPECT_EQ(parameters[0].min, 1);
  EXPECT_EQ(parameters[0].max, 1000);
  EXPECT_EQ(parameters[0].of, 3);
  const std::string longest(kLongestParameter, 'x');
  std::vector<Command> commands;
  ASSERT_TRUE(within([&] {
    commander->send({0xfedcba9876543210, 5, 6, longest, std::nan("")});
    for (auto& command : post->take()) commands.push_back(command);
    return !commands.empty();
  }));
  EXPECT_EQ(commands[0].run, 0xfedcba9876543210);
  EXPECT_EQ(commands[0].sender, 5u);
  EXPECT_EQ(commands[0].number, 6u);
  EXPECT_EQ(commands[0].parameter, longest);
  EXPECT_TRUE(std::isnan(commands[0].value));
  const double odd = std::nextafter(0.1, 1.0);
  std::vector<Answer> answers;
  ASSERT_TRUE(within([&] {
    post->answer({9, 5, 6, Answer::Verdict::kOutOfRange, odd, -0.0, 1e300});
    for (auto& answer : commander->take().answers) answers.push_back(answer);
    return !answers.empty();
  }));
  EXPECT_EQ(answers[0].sender, 5u);
  EXPECT_EQ(answers[0].number, 6u);
  EXPECT_EQ(answers[0].verdict, Answer::Verdict::kOutOfRange);
  EXPECT_EQ(answers[0].value, odd);
  EXPECT_TRUE(std::signbit(answers[0].min));
  EXPECT_EQ(answers[0].max, 1e300);
}

// A later run does not obey commands sent before it started.
TEST(BusCommands, AreNotKeptForWhoComesLater) {
  const BusSettings bus = ownDomain();
  const auto commander = openCommander(bus);
  for (int i = 0; i < 20; ++i) commander->send({9, 5, 1, "early", 1});
  const auto post = openPost(bus);
  std::vector<Command> commands;
  ASSERT_TRUE(within([&] {
    commander->send({9, 5, 2, "late", 2});
    for (auto& command : post->take()) commands.push_back(command);
    return !commands.empty();
  }));
  for (const Command& command : commands) EXPECT_EQ(command.parameter, "late");
}

// A paced lockstep run is held and its material softened from another process; replaying its recording gives the same
// run to the bit.
TEST(BusCommands, ChangeARunInAnotherProcess) {
  const BusSettings bus = ownDomain();
  const std::string file = testing::TempDir() + "/bus_commanded.h5",
                    summary = testing::TempDir() + "/bus_commanded.json";
  ViewerProcess run({"run", kCube, "--lockstep", "--speed", "0.01", "--for", "4", "--overwrite", "--record", file,
                     "--summary", summary, "--bus-commands"},
                    bus);
  // held, so that the run still exists for the following commands even on a slow machine
  const Said held = set(bus, "time/held=1");
  ASSERT_EQ(held.status, 0) << held.text;
  const Said softer = set(bus, "material/rubber/stiffness=700");
  EXPECT_EQ(softer.status, 0) << softer.text;
  EXPECT_NE(softer.text.find("material/rubber/stiffness = 700 (1 to 1000)"), std::string::npos) << softer.text;
  const Said stiffer = set(bus, "material/rubber/stiffness=1500");
  EXPECT_EQ(stiffer.status, 1) << stiffer.text;
  EXPECT_NE(stiffer.text.find("error[E727]"), std::string::npos) << stiffer.text;
  EXPECT_NE(stiffer.text.find("1 to 1000; it stays 700"), std::string::npos) << stiffer.text;
  EXPECT_NE(set(bus, "material/rubber/stiffness=nan").text.find("error[E728]"), std::string::npos);
  const Said unknown = set(bus, "material/rubber/stifness=500");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.text.find("error[E726]"), std::string::npos) << unknown.text;
  EXPECT_NE(unknown.text.find("did you mean 'material/rubber/stiffness'"), std::string::npos) << unknown.text;
  EXPECT_EQ(set(bus, "material/rubber/stiffness").status, 2);
  const Said list = say(bus, {"bus", "list", "--json", "--wait", kWait});
  const auto runs = nlohmann::json::parse(list.text, nullptr, false);
  ASSERT_TRUE(runs.is_array()) << list.text;
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].at("scene"), "cube");
  double stiffness = 0;
  for (const auto& parameter : runs[0].at("parameters"))
    if (parameter.at("name") == "material/rubber/stiffness") stiffness = parameter.at("value");
  EXPECT_EQ(stiffness, 700);
  EXPECT_EQ(say(bus, {"bus", "set", "time/held=0", "--run", "1", "--wait", "0.5"}).status, 3);  // unknown run
  const Said on = say(bus, {"bus", "set", "time/speed=64", "time/held=0", "--run", runs[0].at("run"), "--wait", kWait});
  EXPECT_EQ(on.status, 0) << on.text;
  const std::string said = run.rest();
  EXPECT_EQ(run.end(), 0) << said;

  std::ifstream in(summary);
  const std::string told{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(told.find("a command set material/rubber/stiffness to 700"), std::string::npos) << told;
  const RecordedSamples samples = recordPlugin().samples(file);
  EXPECT_EQ(recordPlugin().read(file).commands.size(), 1u);
  // final spring that held the cube: normal force over depth; damping vanishes while it is held
  const auto& force = samples.fingers.at(0).values("normal_force");
  const auto& depth = samples.fingers.at(0).values("depth");
  ASSERT_GT(depth.back(), 1e-4);
  EXPECT_NEAR(force.back() / depth.back(), 700, 5);
  EXPECT_EQ(std::system((std::string(PRESA_BINARY_DIR) + "/bin/presa replay " + file + " --verify").c_str()), 0);
}

/// Simulated time of the run on the bus.
struct Clock final : Listener {
  void onRun(const RunInfo& info, std::int64_t) override { run = info; }
  void onObject(const ObjectSample&, std::int64_t) override {}
  void onFinger(const FingerSample&, std::int64_t) override {}
  void onHeartbeat(const Heartbeat& heartbeat, std::int64_t) override { time = heartbeat.stamp.time; }
  void onEvent(const Event&, std::int64_t) override {}
  RunInfo run;
  double time = 0;
};

// A box near its goal is pulled there; an undo from another process releases it once, however often the command is
// repeated.
TEST(BusCommands, UndoAnAssembly) {
  const BusSettings bus = ownDomain();
  const std::string scene = testing::TempDir() + "/bus_box.xml", summary = testing::TempDir() + "/bus_box.json";
  std::ofstream(scene) << R"(<scene version="1.0" name="box"><world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="1000"><friction static="0.5"/></material></materials>
    <body name="table" fixed="true" pos="0 0 -0.05"><physics><box size="2 2 0.1"/></physics></body>
    <body name="box" pos="0.004 -0.003 0.0302"><physics mass="0.2"><box size="0.1 0.1 0.06"/></physics></body>
    <assembly><goal name="bottom" bodies="box" pos="0 0 0.03" fold="4"/></assembly></scene>)";
  ViewerProcess run(
      {"run", scene, "--lockstep", "--speed", "4", "--for", "100000", "--summary", summary, "--bus-commands"}, bus);
  const auto reader = openReader(bus);
  Clock clock;
  const auto reaches = [&](double time) {
    return within([&] {
      reader->take(clock);
      return clock.time > time;
    });
  };
  ASSERT_TRUE(reaches(4));
  const Said undone = set(bus, "assembly/undone=1");
  EXPECT_EQ(undone.status, 0) << undone.text;
  EXPECT_EQ(set(bus, "assembly/undone=1").status, 0);
  EXPECT_EQ(set(bus, "assembly/undone=3").status, 1);
  EXPECT_EQ(set(bus, "material/wood/stiffness=500").status, 1);  // not touchable
  ASSERT_TRUE(reaches(clock.time + 1));
  run.signal(SIGINT);
  EXPECT_EQ(run.end(), 130) << run.rest();
  std::ifstream in(summary);
  const auto told = nlohmann::json::parse(in, nullptr, false);
  ASSERT_FALSE(told.is_discarded());
  EXPECT_EQ(told.at("assembly").at("filled"), 0);
  EXPECT_NE(told.dump().find("a command set assembly/undone to 1"), std::string::npos);
}

// A run without commands enabled announces this on the bus and has no topics for them.
TEST(BusCommands, AreRefusedByARunThatTakesNone) {
  const BusSettings bus = ownDomain();
  ViewerProcess run({"run", kCube, "--lockstep", "--speed", "0.001", "--for", "4", "--quiet"}, bus);
  const Said refused = set(bus, "material/rubber/stiffness=700");
  EXPECT_EQ(refused.status, 3) << refused.text;
  EXPECT_NE(refused.text.find("error[E723]"), std::string::npos) << refused.text;
  // a command sent without asking first is not received either
  const auto commander = openCommander(bus);
  const auto reader = openReader(bus);
  Clock runs;
  ASSERT_TRUE(within([&] {
    reader->take(runs);
    return runs.run.run != 0;
  }));
  EXPECT_FALSE(runs.run.commands);
  for (int i = 0; i < 20; ++i) {
    commander->send({runs.run.run, 5, 1, "material/rubber/stiffness", 700});
    sleepUntilNs(monotonicNs() + 10'000'000);
  }
  const Commander::Replies heard = commander->take();
  EXPECT_TRUE(heard.answers.empty());
  EXPECT_TRUE(heard.parameters.empty());
  run.signal(SIGINT);
  EXPECT_EQ(run.end(), 130);
}

// Runs announced by the test, for behaviour that no real run shows.
struct Announced {
  Announced(const BusSettings& bus, std::uint64_t run) : writer(openWriter(bus)), post(openPost(bus)) {
    RunInfo info;
    info.run = run;
    info.scene_name = "made_up";
    info.commands = true;
    writer->announce(info);
    post->show({run, "material/rubber/stiffness", 1000, 1, 1000, 1});
  }
  std::unique_ptr<Writer> writer;
  std::unique_ptr<CommandPost> post;
};

// A run that does not answer gives its own message, two runs a question which is meant; Ctrl-C ends the wait for an
// answer.
TEST(BusCommands, NeedOneRunThatAnswers) {
  const BusSettings bus = ownDomain();
  const Announced first(bus, 0xabc);
  const Said silent = say(bus, {"bus", "set", "material/rubber/stiffness=700", "--wait", "4"});
  EXPECT_EQ(silent.status, 3);
  EXPECT_NE(silent.text.find("error[E725]"), std::string::npos) << silent.text;
  EXPECT_NE(silent.text.find("0000000000000abc"), std::string::npos) << silent.text;

  const Announced second(bus, 0xdef);
  const Said which = set(bus, "material/rubber/stiffness=700");
  EXPECT_EQ(which.status, 2);
  EXPECT_NE(which.text.find("error[E724]"), std::string::npos) << which.text;
  EXPECT_NE(which.text.find("0000000000000abc, 0000000000000def"), std::string::npos) << which.text;

  first.post->take();
  ViewerProcess waits({"bus", "set", "material/rubber/stiffness=700", "--run", "abc", "--wait", "600"}, bus);
  std::vector<Command> commands;
  ASSERT_TRUE(within([&] {
    commands = first.post->take();
    return !commands.empty();
  }));
  EXPECT_EQ(commands[0].run, 0xabcu);
  waits.signal(SIGINT);
  EXPECT_EQ(waits.end(), 130) << waits.rest();
}

// A run's announcement contains untrusted bytes: no command prints them to the terminal unescaped.
TEST(BusCommands, ShowNamesThatATerminalWouldObey) {
  const BusSettings bus = ownDomain();
  const auto writer = openWriter(bus);
  const auto post = openPost(bus);
  RunInfo info;
  info.run = 0xabc;
  info.scene_name =
      "a\x1b]0;x\x07\x1b[2J\r\xC2\x9B"
      "31m\xFF";
  info.scene_xml = "<scene version=\"1.0\" name=\"\xC2\x9Bm\"><body/></scene>";
  info.commands = true;
  writer->announce(info);
  post->show({0xabc, "material/\x1b[31m/stiffness", 1000, 1, 1000, 1});
  for (const std::vector<std::string>& words : {std::vector<std::string>{"bus", "list", "--wait", kWait},
                                                {"bus", "list", "--json", "--wait", kWait},
                                                {"bus", "set", "nothing=1", "--wait", "2"},
                                                {"bus", "listen", "--wait", kWait, "--for", "1"},
                                                {"view", "--join", "--view", "none", "--wait", kWait}}) {
    const Said said = say(bus, words);
    EXPECT_FALSE(said.text.empty()) << words[1];
    EXPECT_EQ(said.text.find_first_of("\x1b\x07\r\xff"), std::string::npos) << words[1] << '\n' << said.text;
    EXPECT_EQ(said.text.find("\xC2\x9B"), std::string::npos) << words[1] << '\n' << said.text;
  }
  EXPECT_NE(say(bus, {"bus", "list", "--wait", kWait}).text.find("a\\x1B]0;x\\x07"), std::string::npos);
}

// A run names a mesh file that exists on this machine: it is not opened by that name, and the viewer reports what it
// looked for.
TEST(BusCommands, OpenNoPathThatTheBusNames) {
  const BusSettings bus = ownDomain();
  const auto writer = openWriter(bus);
  const std::string folder = testing::TempDir() + "/bus_meshes";
  std::filesystem::create_directories(folder);
  const std::string cup = std::string(PRESA_SOURCE_DIR) + "/config/meshes/amphora.obj",
                    copy = folder + "/other_name.obj";
  RunInfo info;
  info.run = 0xabc;
  info.scene_name = "forged";
  info.scene_xml = R"(<scene version="1.0" name="forged"><world gravity="0 0 0"/>
    <materials><material name="clay" stiffness="1000"/></materials>
    <body name="cup" fixed="true"><visual><mesh file="/dev/stdin"/></visual></body></scene>)";
  info.mesh_sums = std::string(64, 'a');
  writer->announce(info);
  const Said refused = say(bus, {"bus", "listen", "--wait", kWait, "--for", "1"});
  EXPECT_EQ(refused.status, 2) << refused.text;
  EXPECT_NE(refused.text.find("error[E755]"), std::string::npos) << refused.text;
  // with the checksum of a shipped mesh that mesh is used, whatever the path says
  info.mesh_sums = sha256OfFile(cup);
  writer->announce(info);
  const Said shipped = say(bus, {"bus", "listen", "--wait", kWait, "--for", "1", "--json"});
  EXPECT_NE(shipped.text.find("\"joined\": true"), std::string::npos) << shipped.text;
  // as is one in a folder named by the user
  std::ofstream(copy) << std::ifstream(cup).rdbuf() << "# another\n";
  info.mesh_sums = sha256OfFile(copy);
  writer->announce(info);
  EXPECT_EQ(say(bus, {"bus", "listen", "--wait", kWait, "--for", "1"}).status, 2);
  const Said named = say(bus, {"bus", "listen", "--wait", kWait, "--for", "1", "--json", "--meshes", folder});
  EXPECT_NE(named.text.find("\"joined\": true"), std::string::npos) << named.text;
}

TEST(BusCommands, NeedABusAndARun) {
  const Said nobody = say(ownDomain(), {"bus", "set", "material/rubber/stiffness=700", "--wait", "0.2"});
  EXPECT_EQ(nobody.status, 3);
  EXPECT_NE(nobody.text.find("error[E722]"), std::string::npos) << nobody.text;
  const Said busless = say({.network = "none"}, {"run", kCube, "--lockstep", "--for", "0.1", "--bus-commands"});
  EXPECT_EQ(busless.status, 2);
  EXPECT_NE(busless.text.find("error[E122]"), std::string::npos) << busless.text;
}

// Without a request there is no port and no stage; a rig may request commands.
TEST(BusCommands, ArePartOfTheGraphOnlyWhereTheRunTakesThem) {
  const auto explained = [&](const std::string& commands) {
    const std::string rig = testing::TempDir() + "/commands_rig.xml",
                      out = testing::TempDir() + "/commands_explain.json";
    std::string motion = std::string(PRESA_SOURCE_DIR) + "/config/motions/pinch_cube.xml", devices;
    for (const char* role : {"thumb", "index"})
      devices += std::string("<device role=\"") + role + R"(" driver="scripted"><set key="motion" value=")" + motion +
                 "\"/></device>";
    std::ofstream(rig) << R"(<rig version="1.0" name="desk"><bus network="loopback" )" << commands << "/>" << devices
                       << "</rig>";
    EXPECT_EQ(std::system((std::string(PRESA_BINARY_DIR) + "/bin/presa explain " + kCube + " --format json --rig " +
                           rig + " > " + out)
                              .c_str()),
              0);
    std::ifstream in(out);
    return nlohmann::json::parse(in);
  };
  const auto closed = explained(""), open = explained(R"(commands="true")");
  EXPECT_EQ(closed.at("connections").dump().find("surface_settings"), std::string::npos);
  EXPECT_EQ(closed.at("stages").dump().find("commands"), std::string::npos);
  EXPECT_NE(closed.at("left_out").dump().find("commanded surfaces"), std::string::npos);
  EXPECT_NE(open.at("connections").dump().find("surface_settings"), std::string::npos);
  EXPECT_NE(open.at("stages").dump().find("commands"), std::string::npos);
}

}  // namespace
}  // namespace presa::bus
