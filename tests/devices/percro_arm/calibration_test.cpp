#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/presa/device/samples_file.h"
#include "devices/percro_arm/encoders.h"
#include "devices/percro_arm/linked_arms.h"
#include "devices/percro_arm/steps.h"
#include "framework/scene/load.h"
#include "tests/apps/support/support.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

constexpr double kLink = 0.03;

/// A pose facing the first arm from 1.5 m away, displaced by up to 10 cm per axis and 0.2 rad.
Pose placement(RandomStream& stream) {
  const double x = stream.normal(), y = stream.normal();
  const Vec3 axis = Vec3(x, y, stream.normal()).normalized();
  const double dx = stream.uniform(-0.1, 0.1), dy = stream.uniform(-0.1, 0.1);
  return {{1.5 + dx, dy, stream.uniform(-0.1, 0.1)},
          Quat(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()) * Eigen::AngleAxisd(stream.uniform(0, 0.2), axis))};
}

double millimetres(const LinkedBases& fit, const Pose& truth) { return (fit.X_AB.p - truth.p).norm() * 1e3; }
double degrees(const LinkedBases& fit, const Pose& truth) {
  return 2 * (fit.X_AB.q.conjugate() * truth.q).vec().norm() * 180 / std::numbers::pi;
}

/// Samples by the encoders alone: no friction, no compliance.
std::vector<LinkedSample> counted(const Pose& X_AB, const LinkPath& path) {
  std::vector<LinkedSample> samples;
  Encoders a(kArm), b(kArm);
  const auto report = [](Encoders& encoders, const Vec3& p_DC) {
    encoders.sample(jointsAt(kArm.geometry, tipOf(p_DC, kLink)));
    return linkCentre(tipPosition(kArm.geometry, encoders.joints()), kLink);
  };
  for (const double t : steps(0, path.duration, 1000))
    samples.push_back({report(a, path.at(t)), report(b, X_AB.inverseTimes(path.at(t)))});
  return samples;
}

// Random poses and trajectories, encoder steps of 54 to 132 um: errors below 0.1 mm and 0.05 degrees at the second
// base.
TEST(PercroCalibration, FindsTheSecondArmThroughItsEncoders) {
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream stream(seed, "encoders");
    const Pose truth = placement(stream);
    const LinkPath path = randomPath(stream, stream.uniform(0.05, 0.1));
    const LinkedBases fit = fitBases(counted(truth, path));
    refused += fit.refusal.empty() ? 0 : 1;
    if (!fit.refusal.empty()) continue;
    ASSERT_LT(millimetres(fit, truth), 0.1) << seed;
    ASSERT_LT(degrees(fit, truth), 0.05) << seed;
  }
  EXPECT_LT(refused, 15);  // short paths of two slow sines
}

// With the full mechanics: friction, weight, compliance, rates of the controller. The same bounds.
TEST(PercroCalibration, FindsTheSecondArmThroughItsMechanics) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomStream stream(seed, "mechanics");
    const Pose truth = placement(stream);
    const LinkPath path = randomPath(stream, 0.08);
    const LinkedBases fit = fitBases(moveLinked(kArm, kGravity, truth, path, kLink));
    ASSERT_EQ(fit.refusal, "") << seed;
    EXPECT_LT(millimetres(fit, truth), 0.1) << seed;
    EXPECT_LT(degrees(fit, truth), 0.05) << seed;
    EXPECT_LT(fit.residual, 0.1e-3);  // an encoder step of either arm
  }
}

TEST(PercroCalibration, APoorTrajectoryIsRefused) {
  RandomStream stream(3, "poor");
  const Pose truth = placement(stream);
  LinkPath path = randomPath(stream, 0.08);
  path.amplitude = {0.1, 2e-3, 2e-3};
  EXPECT_NE(fitBases(counted(truth, path)).refusal.find("too poor"), std::string::npos);
  path.amplitude = {5e-3, 5e-3, 5e-3};
  EXPECT_NE(fitBases(counted(truth, path)).refusal.find("too poor"), std::string::npos);
}

TEST(PercroCalibration, TheLinksCentreAndTheTipGoTogether) {
  const Vec3 p(0.7, 0.1, -0.2);
  EXPECT_LT((linkCentre(tipOf(p, kLink), kLink) - p).norm(), 1e-15);
  EXPECT_NEAR((linkCentre(p, kLink) - p).norm(), kLink, 1e-15);
}

const std::string kRig = test::source("config/rigs/pinch_cube_percro.xml");

void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

// From samples to a rig with which the cube is lifted.
TEST(CalibrateCommand, WritesARigThatRuns) {
  RandomStream stream(4, "command");
  const double half = std::sqrt(0.5);
  const Pose X_WA{{-0.75, 0, 0.1}, Quat(half, half, 0, 0)},
      X_WB{{0.76, 0.02, 0.11}, Quat(0.01, 0, half, half).normalized()};
  auto samples = counted(X_WA.inverse() * X_WB, randomPath(stream, 0.08));
  for (LinkedSample& s : samples) s = {tipOf(s.p_A, kLink), tipOf(s.p_B, kLink)};
  const std::string csv = test::scratch("link.csv"), rig = test::scratch("found.xml");
  write(csv, device::samplesText(samples));
  const test::Outcome found = test::presa("device calibrate " + kRig + " --samples " + csv + " --out " + rig);
  ASSERT_EQ(found.status, 0) << found.err;
  Diagnostics diagnostics;
  const Rig read = loadRig(rig, diagnostics);
  ASSERT_EQ(diagnostics.errorCount(), 0u) << diagnostics.text();
  std::istringstream place(read.devices.at(1).settings.at("pos").value);
  Vec3 p;
  place >> p.x() >> p.y() >> p.z();
  EXPECT_LT((p - X_WB.p).norm(), 0.1e-3);
  const test::Outcome run = test::presa("run " + test::source("config/scenes/cube.xml") + " --lockstep --rig " + rig);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("held in stick for 4.00 of 4.00 s"), std::string::npos) << run.out;
}

TEST(CalibrateCommand, RehearsesAndRefuses) {
  const test::Outcome rehearsal = test::presa("device calibrate " + kRig + " --rehearse 5");
  EXPECT_EQ(rehearsal.status, 0) << rehearsal.err;
  EXPECT_NE(rehearsal.out.find("missed where it really stands by 0.0"), std::string::npos) << rehearsal.out;

  const std::string csv = test::scratch("line.csv"), rig = test::scratch("none.xml");
  std::vector<LinkedSample> line(100);
  for (int i = 0; i < 100; ++i) line[static_cast<std::size_t>(i)] = {{0.6 + i * 1e-3, 0, 0}, {0.8 - i * 1e-3, 0, 0}};
  write(csv, device::samplesText(line));
  const test::Outcome poor = test::presa("device calibrate " + kRig + " --samples " + csv + " --out " + rig);
  EXPECT_EQ(poor.status, 1);
  EXPECT_NE(poor.err.find("too poor"), std::string::npos) << poor.err;
  EXPECT_FALSE(std::filesystem::exists(rig));

  write(csv, "a_x_m,a_y_m,a_z_m,b_x_m,b_y_m,b_z\n1,2,3,4,5,6\n");
  const test::Outcome column = test::presa("device calibrate " + kRig + " --samples " + csv);
  EXPECT_EQ(column.status, 2);
  EXPECT_NE(column.err.find("E474"), std::string::npos) << column.err;
  write(csv, "a_x_m,a_y_m,a_z_m,b_x_m,b_y_m,b_z_m\n1,2,x,4,5,6\n1,2,3,4,5\n");
  const test::Outcome cell = test::presa("device calibrate " + kRig + " --samples " + csv);
  EXPECT_EQ(cell.status, 2);
  EXPECT_NE(cell.err.find(":2:3: error[E475]"), std::string::npos) << cell.err;
  EXPECT_NE(cell.err.find(":3:6: error[E475]"), std::string::npos) << cell.err;
  const test::Outcome scripted = test::presa("device calibrate " + test::source("config/rigs/pinch_cube.xml"));
  EXPECT_EQ(scripted.status, 2);
  EXPECT_NE(scripted.err.find("E473"), std::string::npos) << scripted.err;
}

}  // namespace
}  // namespace presa::percro
