// Whole runs in lockstep whose guide is at the other end of a bus: as with the guide beside the dynamics.
#include <gtest/gtest.h>

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "framework/assembly/assembly_state.h"
#include "framework/bus/local_bus.h"
#include "framework/bus/publisher.h"
#include "framework/bus/remote_guide.h"
#include "framework/record/record_plugin.h"
#include "framework/session/replay.h"
#include "framework/session/run.h"

namespace presa {
namespace {

using Where = RunOptions::Guide;

// three boxes on a table, near their goals; the third has to wait for the second, the second for the first
const std::string kStack = R"(<scene version="1.0" name="stack"><world gravity="0 0 -9.81"/>
  <materials><material name="wood" stiffness="1000"><friction static="0.5"/></material></materials>
  <body name="table" fixed="true" pos="0 0 -0.05"><physics><box size="2 2 0.1"/></physics></body>
  <body name="low" pos="0.004 -0.003 0.0302" euler_deg="0 0 100"><physics mass="0.2"><box size="0.1 0.1 0.06"/></physics></body>
  <body name="beside" pos="0.212 0.009 0.0302"><physics mass="0.2"><box size="0.1 0.1 0.06"/></physics></body>
  <body name="high" pos="-0.008 0.012 0.0662" euler_deg="0 0 -12"><physics mass="0.05"><box size="0.1 0.1 0.01"/></physics></body>
  <assembly>
    <goal name="low" bodies="low" pos="0 0 0.03" fold="4"/>
    <goal name="beside" bodies="beside" pos="0.2 0 0.03" fold="4" after="low"/>
    <goal name="high" bodies="high" pos="0 0 0.065" fold="4" after="low beside"/>
  </assembly></scene>)";

/// Times at which goals were filled, in order, and the final states.
class FillProbe final : public Module {
 public:
  FillProbe() : Module("fill_probe", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override {
    for (std::size_t g = 0; g < assembly_->goals.size(); ++g)
      if (assembly_->goals[g].status == GoalState::Status::kFilled && !filled.contains(g)) {
        filled[g] = tick.time;
        order.push_back(g);
      }
    objects = objects_.value();
  }
  std::map<std::size_t, double> filled;
  std::vector<std::size_t> order;
  ObjectState objects;

 private:
  In<ObjectState> objects_{*this, "object_state"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
};

/// A guide on a thread of its own, as in a viewer.
class Guiding {
 public:
  Guiding(const std::shared_ptr<const World>& world, bus::LocalBus& bus)
      : guide(world, bus.reader(), bus.orderSender()), thread_([this] {
          while (!stop_) guide.step(0.01);
        }) {}
  ~Guiding() { end(); }
  void end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  bus::RemoteGuide guide;

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

struct GuidedRun {
  explicit GuidedRun(Where where, double seconds = 6, const std::string& record = {}) {
    Diagnostics diagnostics;
    RunOptions options;
    options.duration = seconds;
    options.guide = where;
    options.record = record;
    options.overwrite = true;
    Loaded loaded = loadWorldFromText({kStack, "stack.xml", ""}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    world = loaded.world;
    Session::Options session;
    auto made = std::make_unique<FillProbe>();
    probe = made.get();
    session.more.push_back(std::move(made));
    if (where == Where::kViewer) {
      auto publisher = std::make_unique<bus::Publisher>(
          world, options, [this] { return bus.writer(); }, bus::ParameterServer::Open{},
          [this] { return bus.orderPost(); });
      desk = publisher->guideDesk();
      desk->awaitGuide([] { return true; });
      session.more.push_back(std::move(publisher));
    }
    run = std::make_unique<Run>(std::move(loaded), control, std::move(session));
  }
  bus::LocalBus bus;
  std::shared_ptr<const World> world;
  RunControl control;
  FillProbe* probe = nullptr;
  bus::GuideDesk* desk = nullptr;
  std::unique_ptr<Run> run;
};

// The same goals in the same order, each later by no more than what the bus and the soft begin take; the bodies stand
// at
// the same poses.
TEST(GuidedSession, GivesWhatTheRunsOwnGuideGives) {
  GuidedRun own(Where::kBeside), remote(Where::kViewer);
  own.run->execute();
  const Guiding guiding(remote.world, remote.bus);
  remote.run->execute();
  ASSERT_EQ(own.probe->order, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(remote.probe->order, own.probe->order);
  // a decision is made on the states of a publication (5 ms), acts at the next tick of the collision group (10 ms), and
  // the pull rests for one (10 ms); the third goal waits for the second, that for the first
  for (const std::size_t g : {0UL, 1UL, 2UL}) {
    const double later = remote.probe->filled[g] - own.probe->filled[g];
    EXPECT_GE(later, 0) << g;
    EXPECT_LE(later, 0.03 * static_cast<double>(g + 1)) << g;
  }
  for (const std::size_t body : {1UL, 2UL, 3UL}) {
    const Pose &here = remote.probe->objects.bodies[body].X_WB_end, &there = own.probe->objects.bodies[body].X_WB_end;
    EXPECT_LT((here.p - there.p).norm(), 1e-9) << body;  // fixed at the same goal
    EXPECT_LT(here.q.angularDistance(there.q), 1e-6) << body;
  }
}

TEST(GuidedSession, TwiceTheSameToTheBit) {
  GuidedRun one(Where::kViewer, 2), two(Where::kViewer, 2);
  for (GuidedRun* each : {&one, &two}) {
    const Guiding guiding(each->world, each->bus);
    each->run->execute();
  }
  EXPECT_EQ(one.run->session().monitor().hash(), two.run->session().monitor().hash());
}

// A recording holds the orders, and a replay repeats them without a bus.
TEST(GuidedSession, AReplayGivesTheSameStates) {
  const std::string file = testing::TempDir() + "/guided_" + std::to_string(getpid()) + ".h5";
  GuidedRun guided(Where::kViewer, 4, file);
  {
    const Guiding guiding(guided.world, guided.bus);
    guided.run->execute();
  }
  ASSERT_EQ(guided.probe->order.size(), 3u);
  const Recording recording = recordPlugin().read(file);
  EXPECT_TRUE(recording.guided);
  EXPECT_GE(recording.orders.size(), 3u);
  Diagnostics diagnostics;
  RecordedRun replay(recording, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_EQ(replay.run().problem, "");
  EXPECT_EQ(replay.stateHash(), guided.run->monitor().hash());
  std::filesystem::remove(file);

  GuidedRun own(Where::kBeside, 1, file);
  own.run->execute();
  EXPECT_FALSE(recordPlugin().read(file).guided);
  std::filesystem::remove(file);
}

// The viewer dies after the first goal and another one joins: it takes over with what stands, and the rest is done.
TEST(GuidedSession, ALaterGuideTakesOver) {
  GuidedRun guided(Where::kViewer, 20);
  auto first = std::make_unique<Guiding>(guided.world, guided.bus);
  std::unique_ptr<Guiding> second;
  guided.run->onPoll([&] {
    if (first && guided.probe->filled.contains(0)) first.reset();
    if (!first && !second && guided.control.time > 2) second = std::make_unique<Guiding>(guided.world, guided.bus);
  });
  guided.run->execute();
  EXPECT_EQ(guided.probe->order, (std::vector<std::size_t>{0, 1, 2}));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->guide.now().standing, bus::RemoteGuide::Standing::kLeads);
  EXPECT_EQ(second->guide.now().guidance.placed, 3);
}

TEST(GuidedSession, ASecondGuideIsToldThatItIsOne) {
  GuidedRun guided(Where::kViewer, 2);
  const Guiding first(guided.world, guided.bus);
  std::unique_ptr<Guiding> second;
  guided.run->onPoll([&] {
    if (!second && guided.control.time > 0.5) second = std::make_unique<Guiding>(guided.world, guided.bus);
  });
  guided.run->execute();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->guide.now().standing, bus::RemoteGuide::Standing::kOtherLeads);
}

// An undo at the viewer releases the body placed last; it is not pulled back while it lies there.
TEST(GuidedSession, UndoesWhatWasPlacedLast) {
  GuidedRun guided(Where::kViewer, 6);
  Guiding guiding(guided.world, guided.bus);
  bool undone = false;
  guided.run->onPoll([&] {
    if (!undone && guided.probe->order.size() == 3) {
      guiding.guide.undo();
      undone = true;
    }
  });
  guided.run->execute();
  ASSERT_TRUE(undone);
  EXPECT_EQ(guiding.guide.now().guidance.placed, 2);
}

// Only what the scene calls for: without the option nothing of a guide in a viewer is in the graph.
TEST(GuidedSession, IsInTheGraphOnlyWhereItIsAskedFor) {
  GuidedRun own(Where::kBeside, 1), remote(Where::kViewer, 1);
  const auto has = [](Session& session, const std::string& port) {
    for (const Connection& connection : session.graph().connections())
      if (connection.from->name() == port) return true;
    return false;
  };
  EXPECT_FALSE(has(own.run->session(), kGuideOrdersPort));
  EXPECT_TRUE(has(remote.run->session(), kGuideOrdersPort));
  EXPECT_EQ(remote.run->session().graph().find("assembly_guide"), nullptr);
}

}  // namespace
}  // namespace presa
