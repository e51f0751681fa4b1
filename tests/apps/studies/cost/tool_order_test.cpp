// presa cost finds the orders of the pointshell by itself, on smooth contacts: a ball over a ball, and over a plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/plan.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/input/folders.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

void writeScratch(const std::string& name, const std::string& text) { std::ofstream(test::scratch(name)) << text; }

/// A ball in the hand is pressed 1 to 3 mm into a body of that shape, 60 mm high, and moves 20 mm along it while it turns
/// by a right angle.
std::string rolling(const std::string& settings, const std::string& shape) {
  const TriMesh mesh = makeSphere(0.03, 5);  // edges of 1 mm
  std::ofstream out(test::scratch("ball.obj"));
  out.precision(9);
  for (const Vec3& v : mesh.vertices) out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const TriMesh::Triangle& t : mesh.triangles)
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  writeScratch("roll.csv", R"(time_s,role,x_m,y_m,z_m,qw,qx,qy,qz,phase
0,ball,-0.01,0.002,0.053,1,0,0,0,reach
0.1,ball,-0.01,0.002,0.0475,1,0,0,0,reach
0.3,ball,0,0.003,0.049,0.92388,0,0.38268,0,roll
0.5,ball,0.01,0.004,0.0474,0.70711,0,0.70711,0,roll
)");
  writeScratch("roll_rig.xml", R"(<rig version="1.0" name="roll"><device role="ball" driver="scripted">
    <set key="motion" value="roll.csv"/></device></rig>)");
  writeScratch("roll.xml", R"(<scene version="1.1" name="roll" rig="roll_rig.xml"><world gravity="0 0 0"/>
    <haptics tools="pointshell"><pointshell )" +
                               settings +
                               R"(/></haptics><materials><material name="smooth" stiffness="1000"/></materials>
    <body name="other" fixed="true" material="smooth"><haptic>)" +
                               shape + R"(</haptic></body>
    <devices><device role="ball"><tool stiffness="1000" turn_stiffness="2"><sphere radius="0.02"/></tool></device></devices>
    </scene>)");
  return test::scratch("roll.xml");
}

Study planned(const std::string& scene, const std::string& knob, const std::string& out) {
  input::allowFolder(test::scratch(""));
  Diagnostics diagnostics;
  Study study = planStudy(
      {.input = scene, .factors = {knob}, .metrics = {"force_rms", "proxy"}, .out = test::scratch(out), .quick = true},
      diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  study.repeats = 0;  // no costs
  checkFolder(study, diagnostics);
  return study;
}

double orderOf(const Result& result, const std::string& metric) {
  for (const presa::cost::Order& each : result.orders)
    if (each.metric == metric) return each.order;
  return 0;
}

// Trilinear interpolation of a smooth field is wrong by h^2 / 8 times its curvature, its slope by h times that: the force
// is of second order in size and of first order in direction. The reference is refined as far as the memory goes.
TEST(ToolOrder, InTheVoxelSizeIsAtLeastOne) {
  const std::string scene = rolling(R"(voxel="0.002" memory="6")", R"(<mesh file="ball.obj"/>)");
  const Result result = runStudy(planned(scene, "voxel=0.004,0.003,0.002,0.0005", "voxels"), {.workers = 2});
  EXPECT_GE(orderOf(result, "force_rms"), 1);
  EXPECT_EQ(result.reference.kept, std::vector<std::string>{"haptics/pointshell/voxel=5e-04"});
  const std::vector<std::string> texts = sentences(result);
  EXPECT_TRUE(std::ranges::any_of(
      texts, [](const std::string& text) { return text.starts_with("The order of convergence along voxel is "); }));
}

// A ball between its points is flatter by spacing^2 / (8 r): of second order in the distance of its points.
TEST(ToolOrder, InTheSpacingOfPointsIsTwo) {
  const std::string scene = rolling(R"(stiffness="10000000")", R"(<box size="0.1 0.1 0.06"/>)");
  Study study = planned(scene, "spacing=0.008,0.004,0.002,0.001", "spacings");
  study.finer.clear();  // the order needs no fine reference
  study.reference = {{"rates/haptic=2000"}, {"rates/haptic=4000"}};
  EXPECT_NEAR(orderOf(runStudy(study, {.workers = 2}), "force_rms"), 2, 0.2);
}

}  // namespace
}  // namespace presa::cost
