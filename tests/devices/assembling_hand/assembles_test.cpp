// The whole pipeline in lockstep: two fingers assemble bodies by friction only.
#include <gtest/gtest.h>

#include "framework/assembly/assembly_state.h"
#include "framework/core/schedule/executor.h"
#include "framework/session/run.h"

namespace presa {
namespace {

class Probe final : public Module {
 public:
  Probe() : Module("probe", RateGroup::kHaptic), objects_(*this, "object_state"), assembly_(*this, "assembly_state") {}
  void step(const Tick& tick) noexcept override {
    objects = objects_.value();
    if (assembly_->filled > filled) last_filled_at = tick.time;
    filled = assembly_->filled;
  }
  ObjectState objects;
  std::int32_t filled = 0;
  double last_filled_at = 0;

 private:
  In<ObjectState> objects_;
  In<AssemblyState> assembly_;
};

constexpr const char* kRig =
    R"(<rig version="1.0" name="pair"><device role="thumb" driver="assembling_hand"/><device role="index" driver="assembling_hand"/></rig>)";

/// Blocks of 40 x 40 x 60 mm and 0.1 kg on a table.
std::string scene(const std::vector<std::string>& poses, const std::string& goals) {
  std::string text = R"(<scene version="1.0" name="blocks"><world gravity="0 0 -9.81"/>
  <materials><material name="stone" stiffness="1000" damping="1"><friction static="0.8" dynamic="0.7" torsion="0.004"/></material></materials>
  <body name="table" fixed="true" pos="0 0 -0.05"><haptic><box size="2 2 0.1"/></haptic><physics><box size="2 2 0.1"/></physics></body>)";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    text +=
        "<body name=\"b" + std::to_string(i) + "\" " + poses[i] +
        R"(><haptic><box size="0.04 0.04 0.06"/></haptic><physics mass="0.1"><box size="0.04 0.04 0.06"/></physics></body>)";
  }
  return text + "<devices><device role=\"thumb\"/><device role=\"index\"/></devices><assembly>" + goals +
         "</assembly></scene>";
}

struct Ended {
  Ended(const std::string& text, double seconds) {
    Diagnostics diagnostics;
    Loaded loaded = loadWorldFromText({text, "blocks.xml", kRig}, {.duration = seconds}, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    RunControl control;
    Session::Options options;
    auto made = std::make_unique<Probe>();
    Probe& probe = *made;
    options.more.push_back(std::move(made));
    Run run(std::move(loaded), control, std::move(options));
    run.execute();
    objects = probe.objects;
    filled = probe.filled;
    at = probe.last_filled_at;
  }
  ObjectState objects;
  std::int32_t filled = 0;
  double at = 0;
};

constexpr const char* kTower =
    R"(<goal name="low" bodies="b0 b1 b2" pos="0 0 0.03" fold="4"/><goal name="middle" bodies="b0 b1 b2" pos="0 0 0.09" fold="4" after="low"/>
       <goal name="high" bodies="b0 b1 b2" pos="0 0 0.15" fold="4" after="middle"/>)";

TEST(AssemblingHand, BuildsATowerOfBlocksThatStand) {
  const Ended run(scene({R"(pos="0.2 0.05 0.03")", R"(pos="-0.15 0.1 0.03" euler_deg="0 0 30")",
                         R"(pos="0.05 -0.2 0.03" euler_deg="0 0 -20")"},
                        kTower),
                  60);
  EXPECT_EQ(run.filled, 3) << "the last at " << run.at << " s";
  EXPECT_EQ(run.objects.faults, 0U);
}

TEST(AssemblingHand, TurnsABlockThatLiesAndOneOnItsHead) {
  const std::string upright =
      R"(<goal name="lies" bodies="b0" pos="0 0 0.03" fold="4"/><goal name="head" bodies="b1" pos="0 0 0.09" fold="4" after="lies"/>)";
  const Ended run(
      scene({R"(pos="0.2 0.05 0.02" euler_deg="90 0 0")", R"(pos="-0.15 0.1 0.03" euler_deg="180 0 20")"}, upright),
      60);
  EXPECT_EQ(run.filled, 2) << "the last at " << run.at << " s";
  for (const std::size_t body : {1U, 2U}) EXPECT_GT((run.objects.bodies[body].X_WB_end.q * Vec3::UnitZ()).z(), 0.9999);
}

TEST(AssemblingHand, TheSameRunTwiceIsTheSameToTheBit) {
  const std::string text =
      scene({R"(pos="0.2 0.05 0.03")"}, R"(<goal name="low" bodies="b0" pos="0 0 0.03" fold="4"/>)");
  const Ended one(text, 18), two(text, 18);
  EXPECT_EQ(one.filled, 1);
  EXPECT_EQ(one.objects.bodies[1].X_WB_end.p, two.objects.bodies[1].X_WB_end.p);
}

TEST(AssemblingHand, NeedsAnAssembly) {
  std::string text = scene({R"(pos="0.2 0.05 0.03")"}, "");
  text.replace(text.find("<assembly>"), std::string("<assembly></assembly>").size(), "");
  EXPECT_THROW(
      {
        try {
          Ended run(text, 1);
        } catch (const InputError& error) {
          EXPECT_EQ(error.diagnostics().all().front().code, 448);
          throw;
        }
      },
      InputError);
}

}  // namespace
}  // namespace presa
