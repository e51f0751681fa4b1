#include <gtest/gtest.h>

#include "tests/apps/support/support.h"
#include "tests/support/rendered_body.h"

// From the command line: the shipped cube with another renderer, from XML alone.
namespace presa {
namespace {

using test::Outcome, test::RenderedBody, test::withTestPlugins;

std::string cubeWith(const std::string& haptics, const std::string& name) {
  return test::cubeWith(name, [&](std::string& xml) { xml.insert(xml.find("<materials>"), haptics); });
}

Outcome run(const std::string& haptics, const std::string& name) {
  return withTestPlugins("run", cubeWith(haptics, name), " --lockstep --for 3");
}

TEST(SceneWithPenalty, LoadsItAndNotTheGodObject) {
  const Outcome explained = withTestPlugins("explain", cubeWith("<haptics renderer=\"penalty\"/>", "penalty.xml"));
  EXPECT_EQ(explained.status, 0) << explained.err;
  for (const char* text : {"push towards the nearest surface (penalty, no memory)", "presa_penalty.so",
                           "the renderer 'penalty' has no proxy that friction holds"}) {
    EXPECT_NE(explained.out.find(text), std::string::npos) << text << '\n' << explained.out;
  }
  for (const char* library : {"presa_god_object.so", "presa_friction_cone.so"})
    EXPECT_EQ(explained.out.find(library), std::string::npos) << library;
  const Outcome usual = test::presa("explain " + test::source("config/scenes/cube.xml"));
  EXPECT_NE(usual.out.find("presa_god_object.so"), std::string::npos) << usual.out;
  EXPECT_EQ(usual.out.find("presa_penalty.so"), std::string::npos) << usual.out;
}

TEST(SceneWithRenderer, ErrorsAreLikeThoseOfAnyAttribute) {
  const Outcome unknown = run("<haptics renderer=\"penalti\"/>", "unknown.xml");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("did you mean 'penalty'"), std::string::npos) << unknown.err;
  const Outcome other = run("<haptics><faulty_renderer/></haptics>", "other.xml");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("error[E225]: <faulty_renderer> has settings of another renderer than 'god_object'"),
            std::string::npos)
      << other.err;
}

TEST(BrokenRenderer, TakesTheForceToZeroAndIsNamed) {
  for (const std::string fault : {"nan", "no_body"}) {
    const Outcome outcome =
        run("<haptics renderer=\"faulty_renderer\"><faulty_renderer fault=\"" + fault + "\"/></haptics>",
            fault + "_renderer.xml");
    EXPECT_NE(outcome.status, 0) << fault;
    EXPECT_NE((outcome.out + outcome.err).find("renderer 'faulty_renderer'"), std::string::npos)
        << outcome.out << outcome.err;
  }
}

TEST(BrokenRenderer, ThatCannotBeMadeIsRefusedBeforeAnythingMoves) {
  for (const auto& [fault, text] : {std::pair("throws", "no such method"), std::pair("no_mover", "has no mover")}) {
    const Outcome outcome =
        run(std::string("<haptics renderer=\"faulty_renderer\"><faulty_renderer fault=\"") + fault + "\"/></haptics>",
            std::string(fault) + "_renderer.xml");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("error[E596]"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
  }
}

// Oracle: stiffness * depth below the nearer face of a plate of 2 mm.
TEST(Penalty, PushesTowardsTheNearerFace) {
  RenderedBody plate("<haptics renderer=\"penalty\"/>", "<box size=\"0.1 0.1 0.002\"/>");
  EXPECT_EQ(plate.force({0, 0, 0.02}), Vec3::Zero());
  EXPECT_NEAR((plate.force({0, 0, 0.0005}) - Vec3(0, 0, 1000 * (0.009 - 0.0005))).norm(), 0, 1e-9);
  EXPECT_NEAR((plate.force({0, 0, -0.0005}) + Vec3(0, 0, 1000 * (0.009 - 0.0005))).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace presa
