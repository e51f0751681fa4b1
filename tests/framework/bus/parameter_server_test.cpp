// Commands to a run over a bus within this process, in virtual time.
#include "framework/bus/parameter_server.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "framework/bus/local_bus.h"
#include "framework/bus/publisher.h"
#include "framework/core/schedule/executor.h"
#include "framework/core/schedule/rates.h"
#include "framework/session/run.h"
#include "tests/framework/bus/troubled_post.h"

namespace presa::bus {
namespace {

using Verdict = Answer::Verdict;
const std::string kCube = std::string(PRESA_SOURCE_DIR) + "/config/scenes/cube.xml";
const std::string kStiffness = "material/rubber/stiffness", kStatic = "material/rubber/friction/static",
                  kDynamic = "material/rubber/friction/dynamic";
constexpr std::uint64_t kRun = 42;

Scene cubeScene() {
  Diagnostics diagnostics;
  return loadWorld({kCube, {}, {}}, {}, diagnostics).world->scene;
}

/// A parameter server and a commander, connected directly.
struct Server {
  Server() {
    server.start(kRun);
    commander->take();
  }
  Answer say(const Command& command) {
    commander->send(command);
    server.serve(0);
    const auto answers = commander->take().answers;
    EXPECT_EQ(answers.size(), 1u);
    return answers.empty() ? Answer{} : answers.front();
  }
  LocalBus bus;
  std::unique_ptr<Commander> commander = bus.commander();
  ParameterServer server{cubeScene(), [this] { return bus.post(); }};
};

TEST(ParameterServer, AcceptsWhatIsInRangeAndSaysWhatIsInForce) {
  Server d;
  const Answer answer = d.say({kRun, 7, 1, kStiffness, 500});
  EXPECT_EQ(answer.verdict, Verdict::kAccepted);
  EXPECT_EQ(answer.run, kRun);
  EXPECT_EQ(answer.sender, 7u);
  EXPECT_EQ(answer.number, 1u);
  EXPECT_EQ(answer.value, 500);
  EXPECT_EQ(answer.min, 1);
  EXPECT_EQ(answer.max, 1000);
  EXPECT_EQ(d.server.surfaces().newest, 1u);
}

TEST(ParameterServer, RefusesWithTheReasonAndChangesNothing) {
  Server d;
  std::uint64_t number = 0;
  const auto refused = [&](const std::string& parameter, double value) {
    const Answer answer = d.say({kRun, 7, ++number, parameter, value});
    EXPECT_EQ(d.server.surfaces().newest, 0u) << parameter << ' ' << value;
    return answer;
  };
  for (const double value : {1000.001, 0.999, -1.0}) {
    const Answer answer = refused(kStiffness, value);
    EXPECT_EQ(answer.verdict, Verdict::kOutOfRange) << value;
    EXPECT_EQ(answer.min, 1);
    EXPECT_EQ(answer.max, 1000);
    EXPECT_EQ(answer.value, 1000);
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double value : {std::nan(""), kInfinity, -kInfinity})
    EXPECT_EQ(refused(kStiffness, value).verdict, Verdict::kNotANumber) << value;
  for (const char* name :
       {"material/rubber/damping", "device/thumb/limits/force", "rearm", "material/steel/stiffness", ""})
    EXPECT_EQ(refused(name, 1).verdict, Verdict::kUnknown) << name;
  // static friction is never below dynamic friction
  EXPECT_EQ(refused(kStatic, 0.5).verdict, Verdict::kOutOfRange);
  EXPECT_EQ(refused(kDynamic, 0.9).verdict, Verdict::kOutOfRange);
}

TEST(ParameterServer, KeepsStaticFrictionAboveDynamic) {
  Server d;
  EXPECT_EQ(d.say({kRun, 7, 1, kDynamic, 0.3}).verdict, Verdict::kAccepted);
  const Answer lower = d.say({kRun, 7, 2, kStatic, 0.4});
  EXPECT_EQ(lower.verdict, Verdict::kAccepted);
  EXPECT_EQ(lower.min, 0.3);
  EXPECT_EQ(lower.max, 1.6);
  EXPECT_EQ(d.say({kRun, 7, 3, kDynamic, 0.5}).max, 0.4);
}

// A repeated command is answered again and acts once; of two reordered commands for one parameter the later one wins.
TEST(ParameterServer, ActsOnce) {
  Server d;
  d.say({kRun, 7, 2, kStiffness, 500});
  d.say({kRun, 8, 1, kStiffness, 600});  // another sender, in between
  const Answer again = d.say({kRun, 7, 2, kStiffness, 500});
  EXPECT_EQ(again.verdict, Verdict::kAccepted);
  EXPECT_EQ(d.server.surfaces().newest, 2u);
  EXPECT_EQ(d.say({kRun, 7, 1, kStiffness, 900}).verdict, Verdict::kOvertaken);
  EXPECT_EQ(d.server.surfaces().newest, 2u);
  EXPECT_EQ(d.say({kRun, 7, 1, kStatic, 1.0}).verdict, Verdict::kAccepted);  // another parameter is independent
}

// Forged commands with extreme numbers in another sender's name are refused, and the genuine sender continues.
TEST(ParameterServer, OneForgedNumberLocksNoParameter) {
  for (const bool before : {true, false}) {  // the true sender's first command comes before the forged one, or after
    Server d;
    if (before) {
      EXPECT_EQ(d.say({kRun, 7, 1, kStiffness, 500}).verdict, Verdict::kAccepted);
    }
    for (const std::uint64_t forged : {~std::uint64_t{0}, std::uint64_t{1} << 62U, std::uint64_t{5000}})
      EXPECT_EQ(d.say({kRun, 7, forged, kStiffness, 1}).verdict, Verdict::kOutOfOrder) << forged;
    EXPECT_EQ(d.say({kRun, 7, 2, kStiffness, 600}).verdict, Verdict::kAccepted);
    EXPECT_EQ(d.server.surfaces().newest, before ? 2u : 1u);
  }
}

// Numbers run over all parameters: after ten thousand commands for one parameter a sender may still set another.
TEST(ParameterServer, NumbersFollowOverAllParameters) {
  Server d;
  for (std::uint64_t number = 1; number <= 10'000; number += 1000)
    EXPECT_EQ(d.say({kRun, 7, number, kStiffness, 500}).verdict, Verdict::kAccepted) << number;
  EXPECT_EQ(d.say({kRun, 7, 10'000, kStatic, 1.0}).verdict, Verdict::kAccepted);
}

TEST(ParameterServer, DoesNotListenToWhatIsForAnotherRun) {
  Server d;
  d.commander->send({kRun + 1, 7, 1, kStiffness, 500});
  d.server.serve(0);
  EXPECT_TRUE(d.commander->take().answers.empty());
  EXPECT_EQ(d.server.surfaces().newest, 0u);
}

// Late commanders receive all open parameters, and everyone receives changes of value or range.
TEST(ParameterServer, ShowsWhatMayBeSet) {
  Server d;
  const auto late = d.bus.commander();
  std::map<std::string, OpenParameter> shown;
  for (const OpenParameter& parameter : late->take().parameters) shown[parameter.name] = parameter;
  ASSERT_TRUE(shown.contains(kStiffness));
  EXPECT_EQ(shown[kStiffness].value, 1000);
  EXPECT_EQ(static_cast<std::size_t>(shown[kStiffness].of), shown.size());
  d.say({kRun, 7, 1, kDynamic, 0.2});
  for (const OpenParameter& parameter : late->take().parameters) shown[parameter.name] = parameter;
  EXPECT_EQ(shown[kDynamic].value, 0.2);
  EXPECT_EQ(shown[kStatic].min, 0.2);
}

// A parameter offered by the program: a counter that increases by one, as undo does.
TEST(ParameterServer, SetsWhatTheProgramOffers) {
  Server d;
  ParameterServer server(cubeScene(), [&] { return d.bus.post(); });
  double undone = 0;
  server.offer({"assembly/undone", [&] { return undone; }, [&] { return undone; }, [&] { return undone + 1; },
                [&](double value) { undone = value; }});
  server.start(kRun + 1);
  const auto say = [&](std::uint64_t number, double value) {
    d.commander->send({kRun + 1, 7, number, "assembly/undone", value});
    server.serve(0);
    return d.commander->take().answers.at(0).verdict;
  };
  EXPECT_EQ(say(1, 1), Verdict::kAccepted);
  EXPECT_EQ(say(1, 1), Verdict::kAccepted);
  EXPECT_EQ(undone, 1);
  EXPECT_EQ(say(2, 3), Verdict::kOutOfRange);
  EXPECT_EQ(undone, 1);
}

// Two commanders set three parameters over a network that loses, duplicates and reorders a fifth of everything. Each
// repeats a command until it is answered. Every command acts once, and the last value sent is in force at the end.
TEST(ParameterServer, EveryCommandActsOnceOverABadNetwork) {
  LocalBus bus;
  TroubledPost::Counts counts;
  ParameterServer server(cubeScene(), [&] { return std::make_unique<TroubledPost>(bus.post(), 0.2, 11, counts); });
  std::map<std::string, std::vector<double>> acted;
  for (const char* name : {"a", "b"})
    server.offer({name, [&acted, name] { return acted[name].empty() ? 0.0 : acted[name].back(); }, [] { return 0.0; },
                  [] { return 1e6; }, [&acted, name](double value) { acted[name].push_back(value); }});
  server.start(kRun);
  struct Sender {
    std::unique_ptr<Commander> commander;
    const char* parameter;
    Command command;
  };
  std::vector<Sender> senders;
  for (const char* name : {"a", "b"})
    senders.push_back({bus.commander(), name, {kRun, senders.size() + 1, 0, name, 0}});
  constexpr std::uint64_t kEach = 200;
  for (int tick = 0; tick < 20000; ++tick) {
    for (Sender& s : senders) {
      bool answered = s.command.number == 0;
      for (const Answer& answer : s.commander->take().answers)
        answered = answered || (answer.sender == s.command.sender && answer.number == s.command.number);
      if (answered && s.command.number < kEach)
        ++s.command.number, s.command.value = 1000.0 + static_cast<double>(s.command.number);
      if (!answered || tick % 5 == 0) s.commander->send(s.command);
    }
    server.serve(tick * 0.005);
  }
  EXPECT_GT(counts.lost, 500);
  EXPECT_GT(counts.doubled, 500);
  EXPECT_GT(counts.held_back, 500);
  EXPECT_GT(counts.answers_lost, 500);
  for (const char* name : {"a", "b"}) {
    std::vector<double> expected;
    for (std::uint64_t n = 1; n <= kEach; ++n) expected.push_back(1000.0 + static_cast<double>(n));
    EXPECT_EQ(acted[name], expected) << name;
  }
}

// ---- a whole run in lockstep ---------------------------------------------------------------------------------------

/// Samples the forces and the cube in every haptic tick.
struct Watch final : Module {
  explicit Watch(std::function<void(std::uint64_t)> at) : Module("watch", RateGroup::kHaptic), at_tick(std::move(at)) {}
  void step(const Tick& tick) noexcept override {
    at_tick(tick.index);
    forces.push_back(command->f_H_W[0]);
    stiffness = contact->fingers[0].stiffness;
  }
  std::function<void(std::uint64_t)> at_tick;
  In<ForceCommand> command{*this, "force_command"};
  In<ContactExchange> contact{*this, "contact_exchange"};
  std::vector<Vec3> forces;
  double stiffness = 0;
};

struct Ran {
  std::vector<Vec3> forces;
  std::uint64_t hash = 0;
  double stiffness = 0;
  bool has_port = false;
};

Ran runCube(bool commands, LocalBus& bus, std::function<void(std::uint64_t)> at_tick) {
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 4;
  options.bus = BusSettings{.network = "none"};
  options.bus_commands = commands;
  Loaded loaded = loadWorld({kCube, {}, {}}, options, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  RunControl control;
  Session::Options session_options;
  session_options.more.push_back(std::make_unique<Publisher>(
      loaded.world, loaded.options, [&] { return bus.writer(); }, [&] { return bus.post(); }));
  auto watch = std::make_unique<Watch>(std::move(at_tick));
  Watch& seen = *watch;
  session_options.more.push_back(std::move(watch));
  Run run(std::move(loaded), control, std::move(session_options));
  run.execute();
  Ran ran{seen.forces, run.monitor().hash(), seen.stiffness};
  for (const Connection& connection : run.session().graph().connections())
    ran.has_port = ran.has_port || connection.to->name() == "surface_settings";
  return ran;
}

double largestStep(const std::vector<Vec3>& forces, std::size_t from) {
  double largest = 0;
  for (std::size_t i = from + 1; i < forces.size(); ++i)
    largest = std::max(largest, (forces[i] - forces[i - 1]).norm());
  return largest;
}

// A run that is open to commands but receives none equals, to the bit, a run without a command port. When a command
// softens the rubber while two fingers hold the cube, no force changes by more than F period / tau per tick beyond the
// usual change.
TEST(CommandedRun, FeelsNoStepAndIsTheSameWithoutACommand) {
  LocalBus bus;
  const auto commander = bus.commander();
  const auto nothing = [](std::uint64_t) {};
  const Ran closed = runCube(false, bus, nothing), open = runCube(true, bus, nothing);
  EXPECT_FALSE(closed.has_port);
  EXPECT_TRUE(open.has_port);
  EXPECT_EQ(closed.hash, open.hash);
  EXPECT_EQ(closed.forces, open.forces);

  constexpr std::size_t kHeld = 3200;  // the cube hangs between the fingers
  std::uint64_t run = 0;
  for (const OpenParameter& parameter : commander->take().parameters) run = parameter.run;  // of the previous run
  std::vector<Answer> answers;
  const Ran commanded = runCube(true, bus, [&](std::uint64_t tick) {
    if (tick != kHeld) return;
    const Commander::Replies heard = commander->take();
    for (const OpenParameter& parameter : heard.parameters) run = parameter.run;
    commander->send({run, 7, 1, kStiffness, 700});
  });
  answers = commander->take().answers;
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].verdict, Verdict::kAccepted);
  EXPECT_NEAR(commanded.stiffness, 700 + 300 * std::exp(-0.8 / 0.15), 1);
  for (std::size_t i = 0; i < kHeld; ++i) ASSERT_EQ(commanded.forces[i], open.forces[i]) << i;
  double felt = 0;  // until the hand, which controls its force, has pressed deeper
  for (std::size_t i = kHeld; i < open.forces.size(); ++i)
    felt = std::max(felt, (commanded.forces[i] - open.forces[i]).norm());
  EXPECT_GT(felt, 0.1);
  const double force = open.forces[kHeld].norm();
  EXPECT_GT(force, 1);
  EXPECT_LE(largestStep(commanded.forces, kHeld), largestStep(open.forces, kHeld) + force * 1e-3 / 0.15);
  EXPECT_LE(largestStep(commanded.forces, kHeld), 0.1);  // the slew limit is 1 N per tick
}

}  // namespace
}  // namespace presa::bus
