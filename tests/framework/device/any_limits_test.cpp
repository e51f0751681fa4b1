#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "framework/core/graph/graph_builder.h"
#include "framework/core/math/random.h"
#include "framework/device/device_modules.h"
#include "framework/device/device_plugin.h"
#include "framework/device/supervision/command_keeper.h"
#include "framework/scene/load.h"
#include "framework/session/session.h"
#include "tests/framework/device/stand_ins.h"
#include "tests/support/effort.h"

// Ten thousand random scenes and rigs pass through the file readers, the limits, the output stage and the supervisor's
// keeper. For all of them, no force, no torque and no change of them beyond the driver's rating reaches the transport,
// and after a failure both are zero within 20 ms. Every number in the files is random, the rendering commands any force, and
// then one of seven failures occurs.
namespace presa {
namespace {

using test::Commands;
using test::Neighbourhoods;
using test::Objects;

constexpr double kGone = 0.020;  // [s]
constexpr double kTouched = 1e-9;

/// Failures that may end a run.
enum class End { kStop, kLost, kSilent, kNotANumber, kStall, kKilled, kOld };
constexpr int kEnds = 7;

struct Reached {
  long forces = 0, steps = 0, torques = 0, turns = 0, slow_decays = 0, watchdogs = 0;  // within 1 % of what is allowed
  long lowered = 0, refused = 0, runs = 0;
  std::array<long, kEnds> ends{};
  double longest_decay = 0;
};

class RandomFinger final : public Device {
 public:
  FingerInput read(const Tick&) noexcept override { return {.valid = !silent, .lost = lost}; }
  void write(const Wrench& F_H_W, const Tick&) noexcept override { sent = F_H_W; }
  bool silent = false, lost = false;
  Wrench sent;
};

/// One finger from the rendering to the transport: the program's stage, and a supervisor's keeper that runs four times
/// a tick.
class Chain {
 public:
  Chain(const FingerSafety& safety, const DeviceRating& rating, const Rates& rates)
      : rating_(rating), table_(rates), keeper_(rating) {
    devices_.push_back(std::make_unique<RandomFinger>());
    finger = static_cast<RandomFinger*>(devices_[0].get());
    GraphBuilder builder;
    builder.add(std::make_unique<DeviceInput>(devices_, control));
    commands = &builder.add(std::make_unique<Commands>());
    builder.add(std::make_unique<Objects>());
    builder.add(std::make_unique<Neighbourhoods>());
    builder.add(std::make_unique<DeviceOutput>(devices_, std::vector<FingerSafety>{safety}, rates, false));
    builder.connectByName();
    graph_ = builder.build();
  }
  double period() const { return table_.period(RateGroup::kHaptic); }
  /// Whether anything is sent.
  bool acts() const { return sent_.f.norm() > 1e-12 || sent_.t.norm() > 1e-13; }
  double force() const { return sent_.f.norm(); }

  /// One haptic tick; checks that the forces after the stage and after the keeper are within the rating.
  void tick(Reached& reached) {
    if (!stalled) {
      stepIfDue(RateGroup::kDynamics);
      stepIfDue(RateGroup::kCollision);
    }
    if (!killed) graph_.step(RateGroup::kHaptic, table_.tick(RateGroup::kHaptic, index_));
    ++index_;
    if (!killed) judge(finger->sent, commanded_, period(), reached);
    commanded_ = finger->sent;
    constexpr int kCycles = 4;
    for (int i = 0; i < kCycles; ++i) {
      const Wrench before = sent_;
      sent_ = keeper_.step({.fresh = i == 0 && !killed, .command = commanded_}, period() / kCycles);
      judge(sent_, before, period() / kCycles, reached);
    }
  }

  RunControl control;
  RandomFinger* finger = nullptr;
  Commands* commands = nullptr;
  bool stalled = false, killed = false;

 private:
  void stepIfDue(RateGroup group) {
    const auto divisor = static_cast<std::uint64_t>(table_.divisor(group));
    if (index_ % divisor == 0) graph_.step(group, table_.tick(group, index_ / divisor));
  }
  void judge(const Wrench& wrench, const Wrench& before, double elapsed, Reached& reached) {
    judge(wrench.f, before.f, rating_.force, rating_.force_rate * elapsed, reached.forces, reached.steps);
    judge(wrench.t, before.t, rating_.torque, rating_.torque_rate * elapsed, reached.torques, reached.turns);
  }
  static void judge(const Vec3& force, const Vec3& before, double max, double max_step, long& at_max, long& at_step) {
    ASSERT_TRUE(force.allFinite());
    const double size = force.norm(), step = (force - before).norm();
    ASSERT_LE(size, max * (1 + kTouched));
    ASSERT_LE(step, max_step * (1 + kTouched));
    at_max += max > 0 && size > 0.99 * max ? 1 : 0;
    at_step += max > 0 && step > 0.99 * max_step ? 1 : 0;
  }

  DeviceRating rating_;
  DeviceList devices_;
  RateTable table_;
  CommandKeeper keeper_;
  Graph graph_;
  std::uint64_t index_ = 0;
  Wrench commanded_, sent_;
};

class AnyFiles {
 public:
  explicit AnyFiles(std::uint64_t run) : random_(19, "any limits", run) {}

  void run(Reached& reached) {
    static constexpr std::array<const char*, 4> kDrivers{"novint_falcon", "percro_arm", "admittance", "scripted"};
    const std::string driver = kDrivers[random_.below(kDrivers.size())];
    Rates rates;
    const std::optional<FingerSafety> safety = read(driver, rates, reached);
    if (!safety) return;
    const DeviceRating& rating = devicePlugin(driver).rating;
    Chain chain(*safety, rating, rates);
    ++reached.runs;
    press(chain, reached);
    fail(chain, *safety, rating, rates, reached);
  }

 private:
  Vec3 direction() { return Vec3(random_.normal(), random_.normal(), random_.normal()).normalized(); }
  bool chance(double share) { return random_.uniform(0, 1) < share; }
  /// Any size, and often none.
  std::string attribute(const char* name, double min = 1e-9, double max = 1e9) {
    if (chance(0.3)) return {};
    std::array<char, 64> text;
    const double value = std::exp(random_.uniform(std::log(min), std::log(max)));
    std::snprintf(text.data(), text.size(), " %s=\"%.17g\"", name, value);
    return text.data();
  }

  /// None if the readers refuse the file.
  std::optional<FingerSafety> read(const std::string& driver, Rates& rates, Reached& reached) {
    static constexpr std::array<int, 4> kHaptic{100, 500, 1000, 2000};
    const int haptic = kHaptic[random_.below(kHaptic.size())];
    const int slow = haptic / (haptic == 100 ? 1 << random_.below(3) : 5 << random_.below(2));
    const std::string scene =
        R"(<scene version="1.0" name="any"><world gravity="0 0 0"/><rates haptic=")" + std::to_string(haptic) +
        "\" collision=\"" + std::to_string(slow) + "\" dynamics=\"" + std::to_string(slow) +
        R"("/><materials><material name="m" stiffness="1000"><friction static="1" dynamic="1"/></material></materials>
<body name="b" fixed="true"><haptic><sphere radius="1"/></haptic></body><devices><device role="finger"><limits)" +
        attribute("force") + attribute("force_rate") + attribute("torque") + attribute("torque_rate") +
        attribute("watchdog_ms", 20) + "/></device></devices></scene>";
    const std::string rig = "<rig version=\"1.0\" name=\"any\"><device role=\"finger\" driver=\"" + driver +
                            "\"><limits" + attribute("force") + attribute("force_rate") +
                            (chance(0.8) ? "" : attribute("soft_start", 0.5, 60)) + attribute("continuous") +
                            attribute("speed") + attribute("torque") + attribute("torque_rate") +
                            attribute("continuous_torque") + attribute("angular_speed") +
                            (chance(0.5) ? R"( past_continuous="record")" : "") +
                            (chance(0.2) ? R"( passivity="true")" : "") + "/></device></rig>";
    Diagnostics findings;
    World world;
    world.scene = parseScene(scene, "any.xml", ".", {}, findings);
    world.rig = parseRig(rig, "any_rig.xml", ".", findings);
    reached.refused += findings.hasErrors() ? 1 : 0;
    if (findings.hasErrors()) return {};
    std::vector<std::string> notes;
    const FingerSafety safety = safetyOf(world, {}, notes, findings).at(0);
    reached.lowered += findings.all().empty() ? 0 : 1;
    rates = world.scene.rates;
    return safety;
  }

  /// From zero through the soft start under a force that jumps about.
  void press(Chain& chain, Reached& reached) {
    for (int i = 0; i < 5; ++i) chain.tick(reached);  // a keeper opens at zero
    for (double time = 0; time < 0.6 && !testing::Test::HasFatalFailure(); time += chain.period()) {
      if (chance(0.1))
        chain.commands->wanted = {std::pow(10., random_.uniform(-3, 12)) * direction(),
                                  std::pow(10., random_.uniform(-5, 12)) * direction()};
      chain.tick(reached);
    }
    const Vec3 up(0, 0, chance(0.5) ? 1e6 : -1e6);
    chain.commands->wanted = {up, up};
    for (int i = 0; i < 20; ++i) chain.tick(reached);
  }

  void fail(Chain& chain, const FingerSafety& safety, const DeviceRating& rating, const Rates& rates,
            Reached& reached) {
    const auto end = static_cast<End>(random_.below(kEnds));
    ++reached.ends[static_cast<std::size_t>(end)];
    double before = 0;  // time until the failure can be detected [s]
    switch (end) {
      case End::kStop:
        chain.control.stop_requested = true;
        break;
      case End::kLost:
        chain.finger->lost = true;
        break;
      case End::kSilent:
        chain.finger->silent = true;
        before = SampleCheck::kHold;
        break;
      case End::kNotANumber:
        (chance(0.5) ? chain.commands->wanted.f : chain.commands->wanted.t).x() =
            std::numeric_limits<double>::quiet_NaN();
        break;
      case End::kKilled:
        chain.killed = true;
        before = CommandKeeper::kHold;
        break;
      case End::kStall:
      case End::kOld:
        if (rating.watchdog > 1) return;  // a simulated finger may take longer
        chain.stalled = true;
        // the dynamics' watchdog, or the collision's: two periods or 20 ms; the rating bounds the one, the schema's 10
        // Hz the other
        before = std::min(safety.watchdog, ages::neighbourhoods(rates)) + 1 / rates.dynamics;
        ASSERT_LE(safety.watchdog, rating.watchdog);
        reached.watchdogs += safety.watchdog == rating.watchdog ? 1 : 0;
        break;
    }
    const double from = chain.force();
    double took = 0;
    for (; chain.acts() && took < 1; took += chain.period()) {
      chain.tick(reached);
      if (testing::Test::HasFatalFailure()) return;
    }
    // the force leaves at the end of a tick, and a quarter of one later at the keeper
    const double decay = took - before - 2 * chain.period();
    ASSERT_LE(decay, kGone + 1e-9) << "end " << static_cast<int>(end) << " from " << from << " N at "
                                   << safety.limits.force_rate << " N/s";
    if (from < 1e-6) return;
    reached.longest_decay = std::max(reached.longest_decay, decay);
    reached.slow_decays += took - before > 0.9 * DeviceRating::kSlowestDecay ? 1 : 0;
  }

  RandomStream random_;
};

TEST(AnyLimits, NoFileWidensTheRatingOrSlowsTheWayToZero) {
  constexpr int kRuns = unlessSanitized(10'000, 500);
  Reached reached;
  for (int run = 0; run < kRuns; ++run) {
    AnyFiles(static_cast<std::uint64_t>(run)).run(reached);
    ASSERT_FALSE(HasFatalFailure()) << "run " << run;
  }
  std::printf(
      "%ld runs (%ld refused, %ld lowered with a word): forces at the rating %ld, steps at it %ld, torques %ld and "
      "%ld, watchdogs at it "
      "%ld, decays of more than 10.8 ms %ld, the longest %.1f ms\n",
      reached.runs, reached.refused, reached.lowered, reached.forces, reached.steps, reached.torques, reached.turns,
      reached.watchdogs, reached.slow_decays, 1e3 * reached.longest_decay);
  // or nothing was tried
  EXPECT_GT(reached.runs, kRuns / 2);
  EXPECT_GT(reached.lowered, reached.runs / 2);
  EXPECT_GT(reached.forces, kRuns);
  EXPECT_GT(reached.steps, 10 * kRuns);
  EXPECT_GT(reached.torques, kRuns / 10);
  EXPECT_GT(reached.turns, kRuns / 2);
  EXPECT_GT(reached.watchdogs, kRuns / 50);
  EXPECT_GT(reached.slow_decays, kRuns / 20);
  for (const long runs : reached.ends) EXPECT_GT(runs, kRuns / 20);
}

// The drivers that ship: each has a rating that a hand can meet.
TEST(AnyLimits, EveryDriverHasASoundRating) {
  for (const char* driver : {"novint_falcon", "percro_arm", "admittance", "scripted"}) {
    const DevicePlugin& plugin = devicePlugin(driver);
    EXPECT_TRUE(isSound(plugin.rating)) << driver;
    EXPECT_EQ(plugin.hardware, plugin.rating.behind == DeviceRating::Behind::kMotors) << driver;
  }
}

}  // namespace
}  // namespace presa
