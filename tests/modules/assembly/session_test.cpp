// Whole runs in lockstep: the effect of a scene's <assembly> on real bodies.
#include <gtest/gtest.h>

#include "framework/assembly/assembly_state.h"
#include "framework/core/schedule/executor.h"
#include "framework/session/run.h"

namespace presa {
namespace {

/// Records the states that it receives.
class Probe final : public Module {
 public:
  Probe() : Module("probe", RateGroup::kHaptic), objects_(*this, "object_state"), assembly_(*this, "assembly_state") {}
  void step(const Tick&) noexcept override {
    objects = objects_.value();
    assembly = assembly_.value();
  }
  ObjectState objects;
  AssemblyState assembly;

 private:
  In<ObjectState> objects_;
  In<AssemblyState> assembly_;
};

std::string scene(const std::string& lid_pose, const std::string& box_pose, const std::string& extra = {}) {
  return R"(<scene version="1.0" name="lid"><world gravity="0 0 -9.81"/>
  <materials><material name="wood" stiffness="1000"><friction static="0.5"/></material></materials>
  <body name="table" fixed="true" pos="0 0 -0.05"><physics><box size="2 2 0.1"/></physics></body>
  <body name="box" )" +
         box_pose + R"(><physics mass="0.2"><box size="0.1 0.1 0.06"/></physics></body>
  <body name="lid" )" +
         lid_pose + R"(><physics mass="0.05"><box size="0.1 0.1 0.01"/></physics></body>
  <assembly>)" +
         extra + R"(
    <goal name="bottom" bodies="box" pos="0 0 0.03" fold="4"/>
    <goal name="top" bodies="lid" pos="0 0 0.065" fold="4" after="bottom"/>
  </assembly></scene>)";
}

struct Ended {
  explicit Ended(const std::string& text, double seconds) {
    Diagnostics diagnostics;
    Loaded loaded = loadWorldFromText({text, "lid.xml", ""}, {.duration = seconds}, diagnostics);
    EXPECT_FALSE(diagnostics.hasErrors());
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    RunControl control;
    Session::Options options;
    auto made = std::make_unique<Probe>();
    Probe& probe = *made;
    options.more.push_back(std::move(made));
    Run run(std::move(loaded), control, std::move(options));
    run.execute();
    objects = probe.objects;
    assembly = probe.assembly;
  }
  double error(std::size_t body, const Vec3& p) const { return (objects.bodies[body].X_WB_end.p - p).norm(); }
  ObjectState objects;
  AssemblyState assembly;
};

constexpr const char* kBoxNear = R"(pos="0.004 -0.003 0.0302" euler_deg="0 0 100")";
constexpr const char* kLidNear = R"(pos="-0.008 0.012 0.0662" euler_deg="0 0 -12")";

TEST(AssemblySession, WhatIsLetGoNearItsPlaceFindsIt) {
  const Ended run(scene(kLidNear, kBoxNear), 4);
  EXPECT_EQ(run.assembly.filled, 2);
  EXPECT_LT(run.error(1, {0, 0, 0.03}), 1e-9);
  EXPECT_LT(run.error(2, {0, 0, 0.065}), 1e-9);
  const Quat quarter(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitZ()));
  EXPECT_LT(run.objects.bodies[1].X_WB_end.q.angularDistance(quarter), 1e-6) << "the nearest of four turns";
  EXPECT_EQ(run.objects.faults, 0U);
}

TEST(AssemblySession, TheLidWaitsForItsBox) {
  const Ended run(scene(kLidNear, R"(pos="0.3 0 0.0302")"), 4);
  EXPECT_EQ(run.assembly.filled, 0);
  EXPECT_GT(run.error(1, {0, 0, 0.03}), 0.2) << "too far to be drawn";
}

TEST(AssemblySession, ABodyThatWasThrownOutComesBack) {
  const std::string field = R"(<field size="0.8 0.8 2"/>)";
  const Ended run(scene(R"(pos="0.7 0.6 0.0052")", R"(pos="0.3 0 0.0302")", field), 6);
  const Vec3 lid = run.objects.bodies[2].X_WB_end.p;
  EXPECT_LT(std::max(std::abs(lid.x()), std::abs(lid.y())), 0.4);
  EXPECT_EQ(run.assembly.brought_back, 0);
  EXPECT_LT(run.objects.bodies[2].v_WB.norm(), 1e-3);
}

// The table ends at 1 m and is 0.1 m thick: bodies over its edge, against its side, and under it, without a straight
// way back.
TEST(AssemblySession, WhatIsBelowTheGroundIsBroughtBack) {
  const std::string field = R"(<field pos="0 0 0.5" size="1.9 1.9 1"/>)";
  for (const char* lid : {R"(pos="1.03 0 -0.01" euler_deg="0 70 0")", R"(pos="1.01 0 -0.03" euler_deg="0 90 0")",
                          R"(pos="0.7 0 -0.2")"}) {
    const Ended run(scene(lid, R"(pos="0.3 0 0.0302")", field), 60);
    const Vec3& p = run.objects.bodies[2].X_WB_end.p;
    EXPECT_GT(p.z(), 0) << lid;
    EXPECT_LT(p.head<2>().cwiseAbs().maxCoeff(), 0.95) << lid;
    EXPECT_EQ(run.assembly.brought_back, 0) << lid;
    EXPECT_TRUE(run.objects.bodies[2].asleep) << lid << ": and lies there";
  }
}

TEST(AssemblySession, TheSameRunTwiceIsTheSameToTheBit) {
  const Ended one(scene(kLidNear, kBoxNear), 1), two(scene(kLidNear, kBoxNear), 1);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(one.objects.bodies[i].X_WB_end.p, two.objects.bodies[i].X_WB_end.p);
    EXPECT_EQ(one.objects.bodies[i].X_WB_end.q.coeffs(), two.objects.bodies[i].X_WB_end.q.coeffs());
  }
}

std::string findingsOf(const std::string& assembly) {
  Diagnostics diagnostics;
  std::string text = scene(kLidNear, kBoxNear);
  const auto begin = text.find("<assembly>"), end = text.find("</scene>");
  text.replace(begin, end - begin, assembly);
  loadWorldFromText({text, "lid.xml", ""}, {}, diagnostics);
  std::string codes;
  for (const Diagnostic& finding : diagnostics.all()) codes += std::to_string(finding.code) + " ";
  return codes;
}

TEST(AssemblySession, EverythingWrongIsSaidAtOnce) {
  EXPECT_EQ(findingsOf("<assembly/>"), "113 ");
  EXPECT_EQ(
      findingsOf(R"(<assembly><goal name="a" bodies="boxx table" after="c"/><goal name="a" bodies="lid"/></assembly>)"),
      "214 215 216 203 ");
  EXPECT_EQ(
      findingsOf(
          R"(<assembly><goal name="a" bodies="box" after="b"/><goal name="b" bodies="lid" after="a"/></assembly>)"),
      "217 217 ");
  EXPECT_EQ(findingsOf(R"(<assembly><goal name="a" bodies="box" quat="0 0 0 0"/></assembly>)"), "212 ");
}

}  // namespace
}  // namespace presa
