// From the command line: the shipped scene, and the shipped cube with an image, from XML alone.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "framework/scene/load.h"
#include "tests/modules/texture_image/image_fixture.h"
#include "tests/support/lockstep_run.h"

namespace presa {
namespace {

namespace fs = std::filesystem;
using test::LockstepRun, test::Outcome, test::pngOf;

/// The shipped cube with an image in its rubber, which stands in line 8.
std::string cubeOf(const std::string& file, const std::string& more = R"(width="0.01" amplitude="0.00001")") {
  return test::cubeWith("imaged.xml", [&](std::string& xml) {
    xml.insert(xml.find("<friction "), "<texture_image file=\"" + file + "\" " + more + "/>");
  });
}

double grey(unsigned x, unsigned y) { return 0.1 * ((x + y) % 10); }

TEST(SceneWithImage, LoadsItOnlyWhereAMaterialHasIt) {
  const Outcome plain = test::presa("explain " + test::source("config/scenes/texture_sine.xml"));
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.out.find("presa_texture_image.so"), std::string::npos) << plain.out;
  EXPECT_EQ(plain.out.find("libpng"), std::string::npos) << plain.out;
  const Outcome imaged = test::presa("explain " + test::source("config/scenes/texture_image.xml"));
  EXPECT_EQ(imaged.status, 0) << imaged.err;
  EXPECT_NE(imaged.out.find("presa_texture_image.so"), std::string::npos) << imaged.out;
  EXPECT_NE(imaged.out.find("texture: image weave.png of 0.1 mm, tiles of 6 mm by 6 mm"), std::string::npos)
      << imaged.out;
}

TEST(SceneWithImage, IsStrokedToTheEndOfTheScript) {
  const LockstepRun run(test::source("config/scenes/texture_image.xml"));
  EXPECT_TRUE(run.faults().empty()) << run.faults().front();
  EXPECT_GT(run.maxNormalForce("index"), 1);
}

// The file is relative to the scene, and among those whose checksums a session keeps.
TEST(SceneWithImage, NamesItsFile) {
  const std::string file = pngOf("relative.png", 4, 4, 8, grey);
  Diagnostics diagnostics;
  const Scene scene = loadScene(cubeOf("relative.png"), {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  const std::vector<std::string> files = filesNamedBy(scene);
  EXPECT_EQ(files, std::vector<std::string>{fs::absolute(file).lexically_normal().string()});
  const Outcome run = test::withTestPlugins("run", cubeOf("relative.png"), " --lockstep --for 0.1 --view none");
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(BadImage, IsRefusedWithItsPlaceBeforeAnythingMoves) {
  pngOf("rgb.png", 4, 4, 8, grey, PNG_COLOR_TYPE_RGB);
  pngOf("alpha.png", 4, 4, 8, grey, PNG_COLOR_TYPE_GRAY_ALPHA);
  pngOf("wide.png", 2049, 1, 8, grey);
  pngOf("steep.png", 4, 4, 8, [](unsigned x, unsigned) { return x % 2; });
  const std::string good =
      pngOf("good.png", 64, 64, 8, [](unsigned x, unsigned y) { return (7 * x + y * y) % 11 / 10.0; });
  fs::copy_file(good, test::scratch("short.png"));
  fs::resize_file(test::scratch("short.png"), fs::file_size(good) / 2);
  fs::copy_file(good, test::scratch("huge.png"));
  fs::resize_file(test::scratch("huge.png"), (std::uintmax_t{32} << 20U) + 1);
  std::ofstream(test::scratch("text.png")) << "P5 4 4 255";
  std::ofstream(test::scratch("empty.png")).flush();
  ASSERT_EQ(mkfifo(test::scratch("pipe.png").c_str(), 0600), 0);
  for (const auto& [file, expected] : {std::pair("none.png", "cannot be read: No such file"),
                                       {"rgb.png", "has colours; only grey images are read"},
                                       {"alpha.png", "has transparency; only grey images are read"},
                                       {"wide.png", "has 2049 by 1 pixels, at most 2048 by 2048 are read"},
                                       {"short.png", "is damaged: "},
                                       {"huge.png", "has 33554433 bytes, at most 33554432 are read"},
                                       {"text.png", "is no PNG file"},
                                       {"empty.png", "is no PNG file"},
                                       {"pipe.png", "is a named pipe (FIFO), not a regular file"}}) {
    const Outcome outcome = test::withTestPlugins("run", cubeOf(file), " --lockstep --view none");
    EXPECT_EQ(outcome.status, 2) << file;
    EXPECT_NE(outcome.err.find("imaged.xml:8:80: error[E596]"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
  }
  const Outcome steep =
      test::withTestPlugins("run", cubeOf("steep.png", R"(width="0.001" amplitude="0.0002")"), " --lockstep");
  // 2 from pixel to pixel, 4 pixels a mm: 0.2 mm times 8 / mm
  EXPECT_NE(
      steep.err.find("its slope reaches 1.6, above 1; an amplitude of 0.125 mm would be the largest for this size"),
      std::string::npos)
      << steep.err;
  for (const std::string attributes : {R"(width="0" amplitude="0.0001")", R"(width="0.01" amplitude="0.01")",
                                       R"(amplitude="0.0001")", R"(width="0.01" height="-1" amplitude="0.0001")"}) {
    const Outcome outcome = test::withTestPlugins("check", cubeOf("good.png", attributes));
    EXPECT_EQ(outcome.status, 2) << attributes;
    EXPECT_NE(outcome.err.find("imaged.xml:8:"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(test::withTestPlugins("check", cubeOf("")).status, 2);
}

// A scene may come from anywhere: it names files of its own folder, or of one that the user allows.
TEST(BadImage, OfAnotherFolderIsRefused) {
  const fs::path other = fs::path(test::scratch("other"));
  fs::create_directory(other);
  fs::rename(pngOf("moved.png", 4, 4, 8, grey), other / "moved.png");
  const fs::path below = fs::path(test::scratch("below"));
  fs::create_directory(below);
  fs::rename(cubeOf("../other/moved.png"), below / "imaged.xml");
  for (const std::string verb : {"check", "run"}) {
    const std::string more = verb == "run" ? " --lockstep --for 0.1 --view none" : "";
    const Outcome refused = test::withTestPlugins(verb, (below / "imaged.xml").string(), more);
    EXPECT_EQ(refused.status, 2) << verb;
    EXPECT_NE(refused.err.find("imaged.xml:8:80: error[E692]"), std::string::npos) << refused.err;
    const Outcome allowed =
        test::withTestPlugins(verb, (below / "imaged.xml").string(), more + " --allow-folder " + other.string());
    EXPECT_EQ(allowed.status, 0) << allowed.err;
  }
}

}  // namespace
}  // namespace presa
