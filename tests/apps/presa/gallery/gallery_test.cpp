// presa gallery: the shipped scenes, their list and page, and each of them in the hands of mouse and keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "apps/common/file_text.h"
#include "apps/common/report/base64.h"
#include "apps/presa/gallery/entries.h"
#include "apps/presa/gallery/groups.h"
#include "apps/presa/gallery/listing.h"
#include "apps/presa/gallery/page.h"
#include "tests/apps/presa/support.h"

namespace presa {
namespace {

using gallery::Entry;

std::vector<Entry> shipped() {
  Diagnostics diagnostics;
  std::vector<Entry> all = gallery::entries(diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return all;
}

std::size_t linesOf(const std::string& file) {
  const std::string text = contentsOf(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST(Gallery, HasAtLeastFortyShortScenesEachWithAGroupASentenceAndAPicture) {
  const std::vector<Entry> all = shipped();
  EXPECT_GE(all.size(), 40U);
  std::set<std::string> used, sentences;
  for (const Entry& entry : all) {
    SCOPED_TRACE(entry.name);
    EXPECT_NE(std::ranges::find(gallery::groups(), entry.group, &gallery::Group::name), gallery::groups().end())
        << "group '" << entry.group << "' is not listed in apps/presa/gallery/groups.cpp";
    EXPECT_LE(linesOf(entry.file), 60U);
    EXPECT_GT(entry.sentence.size(), 20U);
    EXPECT_LE(entry.sentence.size(), 120U);
    EXPECT_NE(entry.sentence.back(), '.') << "like a caption";
    EXPECT_NE(entry.picture, "") << "./dev pictures scenes/" << entry.name;
    EXPECT_TRUE(sentences.insert(entry.sentence).second) << "two scenes say the same";
    used.insert(entry.group);
  }
  EXPECT_EQ(used.size(), gallery::groups().size()) << "a group without a scene";
}

TEST(Gallery, IsListedByGroupWithinTheColumnsOfTheTerminal) {
  const std::vector<Entry> all = shipped();
  const std::string text = gallery::listing(all, 80, false);
  std::size_t at = 0;
  for (const Entry& entry : all) {
    at = text.find("\n  " + entry.name + " ", at);
    ASSERT_NE(at, std::string::npos) << entry.name << " is missing, or out of its order";
  }
  for (const gallery::Group& group : gallery::groups()) EXPECT_NE(text.find(group.title + "\n"), std::string::npos);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    EXPECT_LE(end - from, 80U) << text.substr(from, end - from);
    from = end + 1;
  }
}

TEST(Gallery, PageHoldsEachPictureSentenceAndCommandAndNoAddress) {
  const std::vector<Entry> all = shipped();
  const std::string page = gallery::page(all);
  for (const Entry& entry : all) {
    EXPECT_NE(page.find("<code>presa gallery " + entry.name + "</code>"), std::string::npos) << entry.name;
    EXPECT_NE(page.find(base64(contentsOf(entry.picture))), std::string::npos) << entry.name;
  }
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("href=\"http"), std::string::npos);
}

TEST(Gallery, NamesTheNearestSceneForAMisspeltOne) {
  const auto run = test::presa("gallery tripot");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(
      run.err.find("presa gallery: error[E140]: there is no scene 'tripot' in the gallery, did you mean 'tripod'?"),
      std::string::npos)
      << run.err;
}

TEST(Gallery, RefusesWhatDoesNotGoTogether) {
  const auto no_name = test::presa("gallery --mouse");
  EXPECT_EQ(no_name.status, 2);
  EXPECT_NE(no_name.err.find("error[E123]"), std::string::npos) << no_name.err;
  const std::string file = test::scratch("both.html");
  const auto both = test::presa("gallery cube --page " + file);
  EXPECT_EQ(both.status, 2);
  EXPECT_NE(both.err.find("error[E123]"), std::string::npos) << both.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

class GalleryScene : public testing::TestWithParam<Entry> {};

/// The first two fingers, or the stylus, hang on mouse and keys; nobody moves them, and nothing may go wrong.
TEST_P(GalleryScene, RunsWithMouseAndKeys) {
  const std::string summary = test::scratch(GetParam().name + ".json");
  const auto run = test::presa("gallery " + GetParam().name +
                               " --mouse --lockstep --for 2 --view none --quiet --summary " + summary);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(contentsOf(summary).find("\"faults\": []"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Shipped, GalleryScene, testing::ValuesIn(shipped()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace presa
