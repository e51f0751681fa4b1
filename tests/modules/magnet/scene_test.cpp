#include <gtest/gtest.h>

#include <filesystem>

#include "tests/apps/support/support.h"

// From the command line: the shipped cube with force effects, from XML alone.
namespace presa {
namespace {

using test::Outcome;

using test::withTestPlugins;

/// The shipped scene with `text` inserted after the start tag of its cube or of the scene.
std::string cubeWith(const std::string& text, bool in_body, const std::string& name) {
  return test::cubeWith(name, [&](std::string& xml) {
    xml.insert(xml.find('>', xml.find(in_body ? "<body name=\"cube\"" : "<scene")) + 1, text);
  });
}

Outcome run(const std::string& scene) { return withTestPlugins("run", scene, " --lockstep --for 2"); }

TEST(SceneWithMagnet, LoadsItsPlugInAndShowsIt) {
  const std::string scene = cubeWith("<magnet max_force=\"1.5\" range=\"0.06\"/>", true, "magnet.xml");
  const Outcome explained = withTestPlugins("explain", scene);
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("force effect <magnet> of body 'cube'"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("presa_magnet.so"), std::string::npos);
  EXPECT_EQ(run(scene).status, 0);
}

TEST(SceneWithoutMagnet, LoadsNoneOfIt) {
  const Outcome explained = test::presa("explain " + test::source("config/scenes/cube.xml"));
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_EQ(explained.out.find("presa_magnet.so"), std::string::npos) << explained.out;
  EXPECT_EQ(explained.out.find("force effect"), std::string::npos) << explained.out;
  // what it could call for
  EXPECT_NE(explained.out.find("the scene has no <magnet>: attracts fingertips"), std::string::npos) << explained.out;
  EXPECT_EQ(explained.out.find("effect_reactions"), std::string::npos);
}

TEST(Plugins, AreListedWithWhatTheyBringAndNotLoaded) {
  const Outcome listed =
      test::shell("PRESA_PLUGIN_PATH=" PRESA_BINARY_DIR "/tests/plugins " PRESA_BINARY_DIR "/bin/presa plugins");
  EXPECT_EQ(listed.status, 0) << listed.err;
  EXPECT_NE(listed.out.find("magnet " PRESA_VERSION " (force effect), " PRESA_BINARY_DIR "/lib/presa\n"),
            std::string::npos)
      << listed.out;
  EXPECT_NE(listed.out.find("    <magnet> in <body>\n      max_force    number [N] in (0, 20], required: "),
            std::string::npos);
  EXPECT_NE(listed.out.find("faulty " PRESA_VERSION " (force effect), " PRESA_BINARY_DIR "/tests/plugins\n"),
            std::string::npos);
}

TEST(Plugins, SayWhichCopyTheFirstOneHides) {
  namespace fs = std::filesystem;
  const fs::path own = PRESA_BINARY_DIR "/lib/presa", first = test::scratch("first");
  fs::create_directories(first);
  for (const char* file : {"presa_magnet.so", "presa_magnet.xml"})
    fs::copy_file(own / file, first / file, fs::copy_options::overwrite_existing);
  const Outcome listed =
      test::shell("PRESA_PLUGIN_PATH=" + first.string() + " " PRESA_BINARY_DIR "/bin/presa plugins | grep hides");
  EXPECT_EQ(listed.out, "  hides " + (own / "presa_magnet.xml").string() + "\n");
}

TEST(SceneWithMagnet, ErrorsAreLikeThoseOfAnyElement) {
  const Outcome missing = run(cubeWith("<magnet/>", true, "missing.xml"));
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("error[E115]: <magnet> in body 'cube' has no 'max_force'"), std::string::npos)
      << missing.err;
  const Outcome misspelt = run(cubeWith("<magnet max_force=\"1\" rage=\"0.1\"/>", true, "misspelt.xml"));
  EXPECT_NE(misspelt.err.find("did you mean 'range'?"), std::string::npos) << misspelt.err;
  const Outcome large = run(cubeWith("<magnet max_force=\"21\"/>", true, "large.xml"));
  EXPECT_NE(large.err.find("must be a number in (0, 20], found '21'"), std::string::npos) << large.err;
}

// Both are found in the first tick in which they happen; the force goes to zero and the report names the element.
TEST(BrokenEffect, TakesTheForceToZeroAndIsNamed) {
  for (const std::string fault : {"nan", "too_much"}) {
    const std::string scene =
        cubeWith("<faulty max_force=\"1\" after=\"0.5\" fault=\"" + fault + "\"/>", false, fault + ".xml");
    const Outcome outcome = run(scene);
    EXPECT_NE(outcome.status, 0) << fault;
    EXPECT_NE((outcome.out + outcome.err).find("force effect <faulty>"), std::string::npos)
        << outcome.out << outcome.err;
  }
}

TEST(BrokenEffect, ThatCannotBeMadeIsRefusedBeforeAnythingMoves) {
  const Outcome throws = run(cubeWith("<faulty max_force=\"1\" fault=\"throws\"/>", false, "throws.xml"));
  EXPECT_EQ(throws.status, 2);
  EXPECT_NE(throws.err.find("error[E596]"), std::string::npos) << throws.err;
  EXPECT_NE(throws.err.find("no such field"), std::string::npos) << throws.err;
  const Outcome differs = run(cubeWith("<faulty max_force=\"1\" fault=\"unknown_attribute\"/>", false, "differs.xml"));
  EXPECT_NE(differs.err.find("gives <faulty> no attribute 'strength'"), std::string::npos) << differs.err;
}

}  // namespace
}  // namespace presa
