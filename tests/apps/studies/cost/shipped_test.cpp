// The studies that ship can be planned, and say what they are named for.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "apps/studies/cost/plan.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

Study planned(const std::string& file, Diagnostics& diagnostics) {
  Request request;
  request.input = file;
  request.out = test::scratch("planned");
  return planStudy(request, diagnostics);
}

TEST(ShippedStudies, CanBePlanned) {
  int studies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source("experiments/accuracy_cost"))) {
    if (entry.path().extension() != ".xml") continue;
    ++studies;
    SCOPED_TRACE(entry.path().filename());
    Diagnostics diagnostics;
    const Study study = planned(entry.path().string(), diagnostics);
    EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    EXPECT_EQ(study.name, entry.path().stem());
    EXPECT_GE(study.settings.size(), 4u);
    EXPECT_GE(study.sentences.size(), 3u);
  }
  EXPECT_EQ(studies, 16);
}

// Also of one whose rates fit to no round ones: 167 Hz everywhere.
TEST(ShippedScenes, HaveAQuickStudy) {
  for (const char* scene : {"cube", "rate_167", "plane", "pile"}) {
    Request request;
    request.input = test::source(std::string("config/scenes/") + scene + ".xml");
    request.out = test::scratch("planned");
    request.quick = true;
    Diagnostics diagnostics;
    const Study study = planStudy(request, diagnostics);
    EXPECT_FALSE(diagnostics.hasErrors()) << scene << diagnostics.text();
    EXPECT_GE(study.settings.size(), 2u) << scene;
    EXPECT_EQ(study.reference.size(), std::string(scene) == "pile" ? 2u : 4u) << scene;
  }
}

// A quick study repeats no run more often than the whole one.
TEST(ShippedStudies, AreNoLongerWhenQuick) {
  Request request;
  request.input = test::source("experiments/accuracy_cost/pile_125.xml");
  request.out = test::scratch("planned");
  Diagnostics diagnostics;
  const int repeats = planStudy(request, diagnostics).repeats;
  request.quick = true;
  EXPECT_LE(planStudy(request, diagnostics).repeats, repeats);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
}

// Each grid has values of its own; a sentence may compare those of any.
TEST(StudyFile, ASentenceMayNameAKnobOfSeveralGrids) {
  const std::string file = test::scratch("grids.xml");
  std::ofstream(file) << "<accuracy_cost version=\"1.0\" name=\"grids\" scene=\"" +
                             test::source("config/scenes/cube.xml") +
                             "\">\n<grid><knob name=\"coupling\" values=\"soft,explicit\"/></grid>\n"
                             "<grid><knob name=\"coupling\" values=\"averaged\"/></grid>\n"
                             "<compare knob=\"coupling\" a=\"soft\" b=\"averaged\" metric=\"force_rms\"/>\n"
                             "<compare knob=\"coupling\" a=\"sof\" b=\"averaged\" metric=\"force_rms\"/>\n"
                             "</accuracy_cost>\n";
  Diagnostics diagnostics;
  planned(file, diagnostics);
  EXPECT_EQ(diagnostics.text(),
            file + ":5:26: error[E806]: knob 'coupling' has no value 'sof' (did you mean 'soft'?)\n");
}

}  // namespace
}  // namespace presa::cost
