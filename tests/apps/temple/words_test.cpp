// Texts for visitors: every kind of block in every language, and unchanged after a round trip through a scene.
#include "apps/temple/building/words.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "apps/common/file_text.h"
#include "apps/temple/building/assembly_text.h"
#include "framework/scene/load.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

/// Error codes of a words file with `from` replaced by `to`.
std::vector<int> codesOf(const std::string& from, const std::string& to) {
  std::string text = contentsOf(PRESA_SOURCE_DIR "/config/temple/words_en.xml");
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string file = test::scratch("words") + "/words.xml";
  std::ofstream(file) << text;
  Diagnostics diagnostics;
  readWordsFile(file, diagnostics);
  std::vector<int> codes;
  for (const Diagnostic& finding : diagnostics.all()) codes.push_back(finding.code);
  return codes;
}

class Words : public testing::TestWithParam<std::string> {};

TEST_P(Words, SpeakOfEveryBlockOfTheFacade) {
  Diagnostics diagnostics;
  const AssemblyWords words = shippedWords(GetParam(), diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_EQ(words.language, GetParam());
  EXPECT_EQ(words.elements.size(), 9U);
  for (const AssemblyWords::Action& action : words.actions) {
    EXPECT_LT(action.does.size(), 36U) << action.name << ": one line of the panel that shows it";
    EXPECT_LT(action.keys.size(), 52U) << action.name << ": likewise";
  }
  for (const AssemblyWords::Element& element : words.elements) {
    EXPECT_FALSE(element.called.empty()) << element.name;
    EXPECT_LT(element.says.size(), 108U) << element.name << ": one line of the panel";
    EXPECT_LT(element.waits.size(), 80U) << element.name << ": one line of the picture";
    EXPECT_GE(element.stories.size(), 2U) << element.name;
    for (const AssemblyWords::Element::Story& story : element.stories) {
      EXPECT_LT(story.says.size(), 108U) << story.says << ": one line of the panel";
      EXPECT_FALSE(story.source.empty()) << story.says;
    }
  }
}

// When a task stands, a visitor reads what it was and what comes next, in one line of the screen: 880 pixels, some 90
// letters. The texts differ from task to task and from language to language.
TEST_P(Words, TellWhatStandsAndOfferEachTask) {
  std::set<std::string> all;
  for (const std::string& task : shippedNames()) {
    const TaskWords words = taskWords(GetParam(), task);
    for (const std::string& text : {words.stands, words.offers}) {
      EXPECT_GT(text.size(), 20U) << task;
      EXPECT_LE(text.size(), 92U) << text;
      all.insert(text);
    }
    EXPECT_EQ(placesIn(words.offers), std::vector<std::string>{"time"}) << words.offers;
    EXPECT_TRUE(placesIn(words.stands).empty()) << words.stands;
    for (const std::string& other : shippedLanguages()) {
      if (other == GetParam()) continue;
      EXPECT_NE(taskWords(other, task).stands, words.stands);
    }
  }
  EXPECT_EQ(all.size(), 2 * shippedNames().size());
  EXPECT_EQ(taskWords(GetParam(), "elsewhere").stands, "");
}

TEST_P(Words, ComeThroughASceneUnchanged) {
  Diagnostics diagnostics;
  const Building building = test::shippedBuilding("facade");
  const AssemblyWords words = shippedWords(GetParam(), diagnostics);
  SceneSpec spec = assembled(building);
  spec.physics_only = true;
  spec.to_be_built = true;
  spec.words = words;
  spec.elapsed = 12.5;
  const std::string folder = test::scratch("scene_words");
  for (const SceneFile& file : meshFiles(building, true)) {
    std::filesystem::create_directories(std::filesystem::path(folder + "/" + file.path).parent_path());
    std::ofstream(folder + "/" + file.path) << file.text;
  }
  const Scene scene = parseScene(sceneText(building, spec), "scene.xml", folder, {}, diagnostics);
  ASSERT_EQ(diagnostics.text(), "");
  const Assembly& assembly = *scene.assembly;
  EXPECT_EQ(assembly.elapsed, 12.5);
  for (const AssemblyPhrase& phrase : assemblyPhrases())
    EXPECT_EQ(assembly.words.*phrase.text, words.*phrase.text) << phrase.attribute;
  ASSERT_EQ(assembly.words.elements.size(), words.elements.size());
  ASSERT_EQ(assembly.words.actions.size(), words.actions.size());
  for (std::size_t i = 0; i < words.actions.size(); ++i) {
    EXPECT_EQ(assembly.words.actions[i].name, words.actions[i].name);
    EXPECT_EQ(assembly.words.actions[i].keys, words.actions[i].keys);
    EXPECT_EQ(assembly.words.actions[i].does, words.actions[i].does);
  }
  for (std::size_t g = 0; g < assembly.goals.size(); ++g) {
    ASSERT_NE(assembly.goals[g].element, kNoElement) << assembly.goals[g].name;
    const AssemblyWords::Element& element = assembly.words.elements[assembly.goals[g].element];
    EXPECT_EQ(element.name, elementName(building.blocks[g].kind));
    const auto same = std::ranges::find(words.elements, element.name, &AssemblyWords::Element::name);
    EXPECT_EQ(element.says, same->says);
    EXPECT_EQ(element.waits, same->waits);
    ASSERT_EQ(element.stories.size(), same->stories.size());
    for (std::size_t i = 0; i < element.stories.size(); ++i) {
      EXPECT_EQ(element.stories[i].says, same->stories[i].says);
      EXPECT_EQ(element.stories[i].source, same->stories[i].source);
    }
  }
}

// Every language tells the same stories.
TEST_P(Words, HaveTheSameSourcesInEachLanguage) {
  Diagnostics diagnostics;
  const AssemblyWords english = shippedWords("en", diagnostics), words = shippedWords(GetParam(), diagnostics);
  for (std::size_t i = 0; i < english.elements.size(); ++i) {
    ASSERT_EQ(words.elements[i].stories.size(), english.elements[i].stories.size()) << english.elements[i].name;
    for (std::size_t k = 0; k < english.elements[i].stories.size(); ++k)
      EXPECT_EQ(words.elements[i].stories[k].source, english.elements[i].stories[k].source);
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, Words, testing::ValuesIn(shippedLanguages()));

TEST(WordsFile, IsChecked) {
  EXPECT_EQ(codesOf("<task name=\"facade\"", "<task name=\"palace\""), std::vector<int>{968});
  EXPECT_EQ(codesOf("{count} of {all}", "{count} of {every}"), std::vector{219});
  EXPECT_EQ(codesOf("finished=\"It stands again.\"", "finished=\"{count} stand.\""), std::vector{219});
  EXPECT_EQ(codesOf("name=\"metope\"", "name=\"metopa\""), std::vector{968});
  EXPECT_EQ(codesOf("name=\"metope\"", "name=\"triglyph\""), (std::vector{203, 968}));
  EXPECT_EQ(codesOf("name=\"lift\"", "name=\"lfit\""), std::vector{968});
  EXPECT_EQ(codesOf("name=\"lift\"", "name=\"turn\""), (std::vector{203, 968}));
  EXPECT_EQ(codesOf("version=\"1.0\" language", "version=\"2.0\" language"), std::vector{966});
  EXPECT_FALSE(codesOf("says=\"The beam", "sagt=\"The beam").empty());
}

TEST(WordsFile, ALanguageThatThereIsNot) {
  Diagnostics diagnostics;
  shippedWords("la", diagnostics);
  ASSERT_EQ(diagnostics.errorCount(), 1U);
  EXPECT_EQ(diagnostics.all().front().code, 969);
}

TEST(WordsOfAScene, GoalsNameElementsThatThereAre) {
  Diagnostics diagnostics;
  parseScene(R"(<scene version="1.0" name="s"><world gravity="0 0 -9.81"/>
    <materials><material name="m" stiffness="1000"/></materials>
    <body name="a"><physics mass="0.1"><sphere radius="0.01"/></physics></body>
    <assembly><words><element name="drum" called="Drum"/></words>
      <goal name="g" bodies="a" pos="0 0 1" element="drun"/></assembly></scene>)",
             "scene.xml", ".", {}, diagnostics);
  ASSERT_EQ(diagnostics.errorCount(), 1U) << diagnostics.text();
  EXPECT_EQ(diagnostics.all().front().code, 218);
  EXPECT_NE(diagnostics.text().find("drum"), std::string::npos) << "it says what is allowed";
}

}  // namespace
}  // namespace presa::temple
