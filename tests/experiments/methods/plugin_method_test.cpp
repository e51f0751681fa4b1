#include "experiments/runner/definition/plugin_method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "experiments/runner/definition/read.h"
#include "experiments/runner/definition/trial_source.h"
#include "framework/scene/manifest.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The shipped comparison of two stiffnesses, in a folder of its own, with another method.
class PluginMethod : public testing::Test {
 protected:
  PluginMethod() {
    fs::copy(std::string(PRESA_SOURCE_DIR) + "/experiments/stiffness_2afc", folder_, fs::copy_options::recursive);
  }
  ~PluginMethod() override { fs::remove_all(folder_); }

  std::optional<Experiment> read(const std::string& method) {
    const std::string own =
        R"(<constant_stimuli values="600 740 870 1000 1150 1350 1660" per_level="36" per_block="4"/>)";
    std::ostringstream text;
    text << std::ifstream(folder_ / "experiment.xml").rdbuf();
    std::string changed = text.str();
    const std::size_t at = changed.find(own);
    EXPECT_NE(at, std::string::npos);
    if (at != std::string::npos) changed.replace(at, own.size(), method);
    const std::string file = folder_ / "changed.xml";
    std::ofstream(file) << changed;
    return readExperiment(file, {}, diagnostics_);
  }
  std::string findings() const { return diagnostics_.text(); }

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("presa_method_" + std::to_string(::getpid()));
  Diagnostics diagnostics_;
};

TEST_F(PluginMethod, StandsInTheProcedureAndChoosesTheTrials) {
  const auto experiment = read(R"(<weighted_up_down start="0.5" step="0.3" min="-1" trials="3"/>)");
  ASSERT_TRUE(experiment) << findings();
  EXPECT_EQ(maxTrials(*experiment->procedure), 3U);
  EXPECT_THAT(experiment->resolved_xml, HasSubstr("target=\"0.75\""));  // defaults are written out
  const auto method = makeMethod(*experiment->procedure, 1);
  std::vector<double> levels;
  for (const bool positive : {true, false, true}) {
    levels.push_back(method->next()->level);
    method->respond(method->responseFor(positive));
  }
  EXPECT_TRUE(method->finished());
  // down by 0.3 (1 - 0.75) / 0.75, up by 0.3
  EXPECT_THAT(levels, testing::Pointwise(testing::DoubleNear(1e-12), {0.5, 0.4, 0.7}));
  const auto resumed = makeMethod(*experiment->procedure, 1);
  psychophysics::replay(*resumed, method->trials());
  EXPECT_TRUE(resumed->finished());
}

TEST_F(PluginMethod, MisspeltAttributeHasItsPlace) {
  EXPECT_FALSE(read(R"(<weighted_up_down start="0.5" stepp="0.3" trials="3"/>)"));
  EXPECT_THAT(findings(), HasSubstr("changed.xml:7:"));
  EXPECT_THAT(findings(), HasSubstr("did you mean 'step'?"));
}

TEST_F(PluginMethod, ValueOutsideOfTheManifestsBounds) {
  EXPECT_FALSE(read(R"(<weighted_up_down start="0.5" step="0" trials="3"/>)"));
  EXPECT_THAT(findings(), HasSubstr("changed.xml:7:"));
}

TEST_F(PluginMethod, MistakeThatOnlyItsLibraryKnows) {
  EXPECT_FALSE(read(R"(<weighted_up_down start="-1" step="0.3" trials="3"/>)"));
  EXPECT_THAT(findings(), HasSubstr("changed.xml:7:5: error[E596]"));
  EXPECT_THAT(findings(), HasSubstr("start must lie between min and max"));
}

TEST_F(PluginMethod, OneOfPresaAndOneOfAPluginAreTwo) {
  EXPECT_FALSE(
      read(R"(<constant_stimuli values="600" per_level="4"/><weighted_up_down start="1" step="1" trials="3"/>)"));
  EXPECT_THAT(findings(), HasSubstr("error[E908]: <procedure> needs one method, found 2"));
}

TEST(MethodManifest, CannotTakeTheNameOfAnElementOfExperiments) {
  Manifest manifest;
  manifest.name = "mine";
  manifest.kind = PluginKind::kMethod;
  manifest.elements.push_back({"staircase", Manifest::Place::kProcedure, {}, {"presa_mine.xml", 3, 3}});
  try {
    experimentSchemaWith("<xs:element name=\"staircase\"/>", {manifest});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostics().text(), HasSubstr("presa_mine.xml:3:3: error[E594]"));
  }
}

class BrokenContract : public testing::Test {
 protected:
  BrokenContract() { ::setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1); }
  ~BrokenContract() override { ::unsetenv("PRESA_PLUGIN_PATH"); }

  static std::unique_ptr<psychophysics::Method> make(const std::map<std::string, std::string>& attributes) {
    return makePluginMethod({"endless", "endless", kNoBody, attributes, {"e.xml", 4, 5}, PluginKind::kMethod, -1}, {},
                            RandomStream(1, "method"));
  }
  template <class Call>
  static std::string refusal(const Call& call) {
    try {
      call();
    } catch (const InputError& error) {
      return error.diagnostics().text();
    }
    return "accepted";
  }
};

TEST_F(BrokenContract, LevelThatIsNoNumber) {
  EXPECT_THAT(refusal([] { make({}); }), HasSubstr("e.xml:4:5: error[E617]"));
}

TEST_F(BrokenContract, MoreAnswersThanAnnounced) {
  const auto method = make({{"level", "0.5"}});
  method->respond({});
  method->discard();  // no answer
  method->respond({});
  EXPECT_THAT(refusal([&] { method->respond({}); }), HasSubstr("has not finished after the 3 answers"));
}

TEST_F(BrokenContract, ExceptionInTheSession) {
  const auto method = make({{"level", "0.5"}, {"throws", "1"}});
  EXPECT_THAT(
      refusal([&] { method->respond({}); }),
      testing::AllOf(HasSubstr("e.xml:4:5: error[E617]"), HasSubstr("throws during the session: no level left")));
}

TEST_F(BrokenContract, NoMethod) {
  EXPECT_THAT(refusal([] { make({{"nothing", "1"}}); }), HasSubstr("e.xml:4:5: error[E596]"));
}

}  // namespace
}  // namespace presa::experiment
