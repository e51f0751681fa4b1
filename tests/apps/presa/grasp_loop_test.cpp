// A body in a grasp as a mass on the fingers' springs: natural frequency, and the mass that explicit coupling needs.
#include "apps/common/grasp_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

#include "apps/common/grasp_figures.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using test::source;

nlohmann::json explained(const std::string& arguments) {
  const auto outcome = test::presa("explain --format json " + arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

// PERCRO 3.2 over its 0.1 to 0.5 kg and 500 to 2000 N/m: 7.1 to 31.8 Hz, where 5 to 45 is printed.
TEST(GraspLoop, HasTheFrequencyOfAMassOnSprings) {
  EXPECT_NEAR((GraspLoop{0, 2, 0.5, 500}.naturalFrequency()), 7.1, 0.05);
  EXPECT_NEAR((GraspLoop{0, 2, 0.1, 2000}.naturalFrequency()), 31.8, 0.05);
}

// Symplectic Euler, x'' = -(n K / M) x: the last stable mass has h^2 n K / M = 4.
TEST(GraspLoop, NeedsTheMassOfSymplecticEuler) {
  const double h = 0.005, stiffness = 2000;
  const double bound = GraspLoop{0, 2, 1, stiffness}.explicitMinMass(h);
  EXPECT_NEAR(bound, 0.025, 1e-15);
  for (const double share : {0.99, 1.01}) {
    double x = 1e-3, v = 0, largest = 0;
    for (int i = 0; i < 2000; ++i) {
      v -= h * 2 * stiffness / (share * bound) * x;
      x += h * v;
      largest = std::max(largest, std::abs(x));
    }
    EXPECT_EQ(largest<1, share> 1) << share;
  }
}

TEST(GraspLoop, IsExplainedForEveryFreeBodyThatFingersCanGrasp) {
  const nlohmann::json cube = explained(source("config/scenes/cube.xml"));
  ASSERT_EQ(cube.at("grasps").size(), 1u);
  EXPECT_EQ(cube["grasps"][0]["body"], "cube");
  EXPECT_NEAR(cube["grasps"][0]["natural_frequency_hz"].get<double>(),
              std::sqrt(2 * 1000 / 0.2) / (2 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(cube["grasps"][0]["explicit_min_mass_kg"].get<double>(), 0.0125, 1e-12);
  for (const char* scene : {"door", "friction_cone"})  // held by a joint; one finger
    EXPECT_FALSE(explained(source(std::string("config/scenes/") + scene + ".xml")).contains("grasps")) << scene;
}

TEST(GraspLoop, WarnsOfALightBodyUnderExplicitCouplingOnly) {
  const std::string light = source("config/scenes/cube.xml") + " --set body/cube/physics/mass=0.03";
  for (const char* command : {"explain ", "check "}) {
    EXPECT_EQ(test::presa(command + light).err.find("W245"), std::string::npos) << command;
    const auto warned = test::presa(command + light + " --set dynamics/coupling=explicit");
    EXPECT_EQ(warned.status, 0) << command;
    // 3 x 12.5 g; 200 Hz sqrt(37.5 / 30) = 224 Hz, and 250 divides 1000
    EXPECT_NE(warned.err.find("warning[W245]: 2 fingers of 1000 N/m on 'cube' of 0.03 kg"), std::string::npos)
        << warned.err;
    EXPECT_NE(warned.err.find("needs 0.0375 kg"), std::string::npos) << warned.err;
    EXPECT_NE(warned.err.find("<rates dynamics=\"250\">"), std::string::npos) << warned.err;
  }
}

struct ExplicitGrasp {
  const char *rig, *pose;
  double stiffness;
};
std::ostream& operator<<(std::ostream& out, const ExplicitGrasp& grasp) {
  return out << grasp.rig << ", " << grasp.pose << ", " << grasp.stiffness << " N/m";
}
class ExplicitMargin : public testing::TestWithParam<ExplicitGrasp> {
 protected:
  /// Whether the cube of the PERCRO system is held to the end of the hold, this many times the bound heavy.
  static bool held(const ExplicitGrasp& grasp, double share) {
    const double mass = share * GraspLoop{0, 2, 1, grasp.stiffness}.explicitMinMass(0.005);
    Diagnostics diagnostics;
    RunOptions options;
    options.duration = 7;
    Loaded loaded =
        loadWorld({source("config/scenes/percro_2006.xml"),
                   source(grasp.rig),
                   {"body/cube/physics/mass=" + std::to_string(mass), std::string("haptics/pose=") + grasp.pose,
                    "material/study/stiffness=" + std::to_string(grasp.stiffness)}},
                  options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    TerminalRun run(std::move(loaded), {.trace_rate = 1000, .quiet = true, .command = ""});
    run.execute();
    const auto figures = graspFigures(run.result());
    return figures && figures->held_in_stick > 3.99 && figures->fingers[0].grip_ripple.value_or(1) < 0.01;
  }
};

// No warning, no loss: with the margin each of these grasps holds; without it, at the bound itself, none does.
TEST_P(ExplicitMargin, CoversFingersAndArmsAndIsNeeded) {
  EXPECT_TRUE(held(GetParam(), kExplicitMargin));
  EXPECT_FALSE(held(GetParam(), 1));
}
INSTANTIATE_TEST_SUITE_P(OfGrasps, ExplicitMargin,
                         testing::Values(ExplicitGrasp{"config/rigs/pinch_cube.xml", "hold", 500},
                                         ExplicitGrasp{"config/rigs/pinch_cube.xml", "interpolate", 2000},
                                         ExplicitGrasp{"config/rigs/pinch_cube_percro.xml", "hold", 500},
                                         ExplicitGrasp{"config/rigs/pinch_cube_percro.xml", "hold", 2000},
                                         ExplicitGrasp{"config/rigs/pinch_cube_percro.xml", "interpolate", 500},
                                         ExplicitGrasp{"config/rigs/pinch_cube_percro.xml", "interpolate", 2000}),
                         [](const auto& grasp) {
                           const bool arms = std::string(grasp.param.rig).find("percro") != std::string::npos;
                           return std::string(arms ? "Arms_" : "Script_") + grasp.param.pose + "_" +
                                  std::to_string(static_cast<int>(grasp.param.stiffness)) + "N_m";
                         });

}  // namespace
}  // namespace presa
