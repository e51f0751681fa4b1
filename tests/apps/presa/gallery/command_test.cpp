// `presa gallery` on the command line: the list, the page, and a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/common/file_text.h"
#include "apps/presa/gallery/entries.h"
#include "apps/presa/gallery/listing.h"
#include "apps/presa/gallery/mouse_rig.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using testing::HasSubstr;
using testing::Not;

// Where the output is no terminal, the list has 80 columns: all names, all sentences.
TEST(GalleryCommand, ListsEverySceneInEightyColumns) {
  const auto outcome = test::presa("gallery");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  Diagnostics diagnostics;
  for (const auto& entry : gallery::entries(diagnostics)) EXPECT_THAT(outcome.out, HasSubstr("  " + entry.name + " "));
}

// A group that is not in the list of titles stands last, under its own name.
TEST(GalleryCommand, ListsUnknownGroupsUnderTheirNames) {
  const std::string text = gallery::listing({{"a", "grasp", "One", "", ""}, {"bb", "mine", "Two", "", ""}}, 80, false);
  EXPECT_THAT(text, HasSubstr("Grasp\n  a   One\n\nMine\n  bb  Two\n"));
}

TEST(GalleryCommand, NamesTheNearestSceneAndTheMissingOne) {
  const auto wrong = test::presa("gallery tirpod");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("error[E140]: there is no scene 'tirpod' in the gallery (did you mean 'tripod'?)"));
  const auto nameless = test::presa("gallery --lockstep");
  EXPECT_EQ(nameless.status, 2);
  EXPECT_THAT(nameless.err, HasSubstr("--lockstep: error[E123]"));
  EXPECT_EQ(test::presa("gallery cube --page " + test::scratch("x.html")).status, 2);
  EXPECT_FALSE(std::filesystem::exists(test::scratch("x.html")));
}

// One file for a browser without a network: every scene with its picture, nothing loaded from elsewhere.
TEST(GalleryCommand, PageHoldsEveryPicture) {
  const std::string file = test::scratch("gallery.html");
  const auto outcome = test::presa("gallery --page " + file);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = contentsOf(file);
  Diagnostics diagnostics;
  for (const auto& entry : gallery::entries(diagnostics)) {
    EXPECT_THAT(page, HasSubstr("<figure id=\"" + entry.name + "\"><img"));
    EXPECT_THAT(page, HasSubstr("<code>presa gallery " + entry.name + "</code>"));
  }
  EXPECT_THAT(page, Not(HasSubstr("://")));
}

// Without a window a scene runs once, as `presa run` runs it: the same bits.
TEST(GalleryCommand, RunsASceneAsPresaRunDoes) {
  const std::string here = test::scratch("gallery.json"), there = test::scratch("run.json");
  EXPECT_EQ(test::presa("gallery plane --lockstep --quiet --for 1 --view none --summary " + here).status, 0);
  EXPECT_EQ(test::presa("run " + test::source("config/scenes/plane.xml") +
                        " --lockstep --quiet --for 1 --view none --summary " + there)
                .status,
            0);
  const auto hash = [](const std::string& file) { return nlohmann::json::parse(contentsOf(file)).at("state_hash"); };
  EXPECT_EQ(hash(here), hash(there));
}

// The first hand is the mouse's; another one keeps its devices and their settings.
TEST(GalleryCommand, TheMouseTakesTheFirstHand) {
  Scene scene;
  for (const char* role : {"left_thumb", "left_index", "right_thumb"}) scene.devices.emplace_back().role = role;
  Rig own;
  own.devices.resize(2);
  own.devices[0].role = "left_thumb", own.devices[1].role = "right_thumb";
  own.devices[1].driver = "scripted", own.devices[1].settings["motion"] = {"a&b.xml", {}};
  EXPECT_EQ(gallery::mouseRig(scene, own),
            "<rig version=\"1.0\" name=\"mouse\">\n"
            "  <device role=\"left_thumb\" driver=\"pointer\"><set key=\"side\" value=\"-1\"/></device>\n"
            "  <device role=\"left_index\" driver=\"pointer\"><set key=\"side\" value=\"1\"/></device>\n"
            "  <device role=\"right_thumb\" driver=\"scripted\"><set key=\"motion\" value=\"a&amp;b.xml\"/></device>\n"
            "</rig>\n");
}

}  // namespace
}  // namespace presa
