#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/apps/support/support.h"

namespace presa {
namespace {

using test::scratch;
using test::source;
using testing::HasSubstr;

/// What somebody types, the status that it ends with, and a part of what is said. CUBE, RIG, MOTION, EXPERIMENT stand for
/// shipped files; BADRIG, CUBELIKE and FILE for files of the test.
struct Mistake {
  const char* words;
  int status;
  const char* said;
};

constexpr Mistake kMistakes[] = {
    // no command, or another one
    {"", 2, "presa: error[E123]: a command is missing: run, gallery, check, explain"},
    {"rnu", 2, "presa: error[E123]: there is no command 'rnu' (did you mean 'run'?)"},
    {"chekc CUBE", 2, "there is no command 'chekc' (did you mean 'check'?)"},
    {"experimnet", 2, "there is no command 'experimnet' (did you mean 'experiment'?)"},
    {"tempel", 2, "there is no command 'tempel' (did you mean 'temple'?)"},
    {"version", 2, "presa --version prints the version"},
    {"-v", 2, "presa --version prints the version"},
    {"CUBE", 2, "a command must come before the file"},
    {"cube.xml", 2, "presa run cube.xml"},
    {"some.h5", 2, "presa replay some.h5"},
    {"--lockstep", 2, "a command must come before the option '--lockstep'"},
    {"device", 2, "presa device: error[E123]: a command is missing: list, check"},
    {"device doktor", 2, "there is no command 'doktor' (did you mean 'doctor'?)"},
    {"device fautls", 2, "there is no command 'fautls' (did you mean 'faults'?)"},
    {"bus", 2, "presa bus: error[E123]: a command is missing"},
    {"experiment", 2, "presa experiment: error[E123]: a command is missing: dry-run"},
    {"experiment rnu", 2, "there is no command 'rnu' (did you mean 'run'?)"},
    // help is no mistake
    {"help", 0, "Usage"},
    {"help run", 0, "--lockstep"},
    {"help experiment run", 0, "--subject"},
    {"experiment help", 0, "dry-run"},
    {"run --help", 0, "--report"},
    // what is missing or too much
    {"run", 2, "presa run: error[E123]: SCENE is missing: scene file, e.g. config/scenes/cube.xml"},
    {"run --for 3", 2, "SCENE is missing"},
    {"check", 2, "FILE is missing: files of scenes, rigs, motions, experiments or walls"},
    {"replay", 2, "FILE is missing"},
    {"new effect", 2, "NAME is missing"},
    {"run CUBE CUBE", 2, "is one argument too many: presa run takes SCENE"},
    {"plugins all", 2, "'all' is one argument too many: presa plugins takes no file and no name"},
    {"run CUBE --locksteps", 2, "there is no option '--locksteps' (did you mean '--lockstep'?)"},
    {"run CUBE --reprot=a.html", 2, "there is no option '--reprot' (did you mean '--report'?)"},
    {"run CUBE --record", 2, "--record needs a value"},
    {"run CUBE --for", 2, "--for needs a value"},
    {"run CUBE --lockstep --realtime", 2, "exclude each other"},
    // values
    {"run CUBE --for -1", 2, "--for expects a number above 0, found '-1'"},
    {"run CUBE --for 0", 2, "--for expects a number above 0, found '0'"},
    {"run CUBE --for 5s", 2, "found '5s'; write it without a unit: 5"},
    {"run CUBE --for long", 2, "--for expects a number, found 'long'"},
    {"run CUBE --seed -1", 2, "--seed expects a whole number of at least 0, found '-1'"},
    {"run CUBE --seed 1.5", 2, "--seed expects a whole number of at least 0, found '1.5'"},
    {"run CUBE --speed 0", 2, "--speed expects a number above 0"},
    {"run CUBE --view windw", 2, "expects window, offscreen or none, found 'windw' (did you mean 'window'?)"},
    {"temple --size big", 2, "--size expects first, column or facade, found 'big'"},
    {"bus listen --domain 999", 2, "--domain expects a whole number from 0 to 200, found '999'"},
    {"run CUBE --set foo", 2, "error[E123]: expected PATH=VALUE, found 'foo'"},
    {"run CUBE --set bod/cube=1", 2, "error[E202]"},
    {"run CUBE --bus wlan", 2, "a network is loopback, lan, lan:INTERFACE or none, found 'wlan'"},
    // options that say nothing together
    {"run CUBE --realtime --speed 2 --view none", 2, "--speed: error[E123]: only a run in virtual time has a speed"},
    {"run CUBE --lockstep --for 1 --screenshot SHOT --screenshot-at 5", 2,
     "the run ends at 1 s, before the picture at 5 s"},
    {"run CUBE --lockstep --screenshot-at 1", 2, "add --screenshot FILE.png"},
    {"run CUBE --view none --screenshot SHOT", 2, "error[E121]"},
    {"run CUBE --bus-commands", 2, "error[E122]"},
    {"view CUBE", 2, "presa run SCENE --view window"},
    // files
    {"run nowhere.xml", 2, "nowhere.xml: error[E101]: the file cannot be read"},
    {"run RIG", 2, "the root element is <rig>, expected <scene>"},
    {"run CUBE --rig BADRIG", 2, "(did you mean 'scripted'?)"},
    {"check BADRIG", 2, "there is no driver 'scriptd' (did you mean 'scripted'?)"},
    {"replay CUBE", 2, "error[E604]: is not an HDF5 file"},
    {"run CUBE --lockstep --for 0.1 --report /proc/none/r.html", 2,
     "--report: error[E124]: '/proc/none/r.html' cannot be written"},
    {"run CUBE --lockstep --for 0.1 --report /proc/r.html", 2, "--report: error[E124]"},
    {"run CUBE --lockstep --for 0.1 --summary FOLDER", 2, "--summary: error[E124]"},
    {"check MOTION RIG CUBE", 0, "good"},
    {"check EXPERIMENT", 0, "good (experiment)"},
    {"run CUBE --lockstep --for 0.1 --quiet --allow-no-rt", 0, ""},
};

std::string replaced(std::string text, const std::string& word, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += with.size())
    text.replace(at, word.size(), with);
  return text;
}

std::string withFiles(const std::string& words) {
  const std::string bad_rig = scratch("rig.xml");
  std::ofstream(bad_rig) << R"(<rig version="1.0" name="r"><device role="thumb" driver="scriptd"/>
    <device role="index" driver="scripted"><set key="motion" value=")"
                         << source("config/motions/pinch_cube.xml") << R"("/></device></rig>)";
  std::string text = replaced(words, "BADRIG", bad_rig);
  text = replaced(text, "CUBE", source("config/scenes/cube.xml"));
  text = replaced(text, "RIG", source("config/rigs/pinch_cube.xml"));
  text = replaced(text, "MOTION", source("config/motions/pinch_cube.xml"));
  text = replaced(text, "EXPERIMENT", source("experiments/stiffness_2afc/experiment.xml"));
  text = replaced(text, "SHOT", scratch("shot.png"));
  return replaced(text, "FOLDER", std::filesystem::path(bad_rig).parent_path().string());
}

// Sixty things that people type wrong: each gets one sentence that names the cure, before anything runs.
TEST(Mistakes, GetASentenceAndAStatus) {
  static_assert(std::size(kMistakes) >= 60);
  for (const Mistake& mistake : kMistakes) {
    const test::Outcome outcome = test::presa(withFiles(mistake.words) + " </dev/null");
    EXPECT_EQ(outcome.status, mistake.status) << "presa " << mistake.words << "\n" << outcome.out << outcome.err;
    EXPECT_THAT(outcome.err + outcome.out, HasSubstr(mistake.said)) << "presa " << mistake.words;
  }
}

// Without status and closing text a fault would leave no word but its status.
TEST(Mistakes, AFaultIsToldInAQuietRun) {
  const std::string rig = scratch("jump.xml");
  std::ofstream(scratch("jump.csv")) << "time_s,role,x_m,y_m,z_m\n0,thumb,-0.1,0,0.03\n0,index,0.1,0,0.03\n"
                                        "0.1,thumb,-0.1,0,0.03\n0.102,thumb,1.5,0,0.03\n2,thumb,1.5,0,0.03\n";
  std::ofstream(rig) << R"(<rig version="1.0" name="j">
    <device role="thumb" driver="scripted"><set key="motion" value="jump.csv"/></device>
    <device role="index" driver="scripted"><set key="motion" value="jump.csv"/></device></rig>)";
  const auto outcome = test::presa(withFiles("run CUBE --quiet --for 0.5 --view none --rig ") + rig);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, testing::StartsWith("presa run: fault at 0.1"));
  EXPECT_EQ(outcome.out, "");
}

// A program without its scenes says so at once, and does not fail 830 trials. Copied, it finds no folder experiments.
TEST(Mistakes, StabilityWithoutItsScenesSaysWhatItNeeds) {
  const std::filesystem::path folder = scratch("moved");
  const std::filesystem::path moved = folder / "a/b/c/d", program = moved / "bin/presa-stability";
  std::filesystem::create_directories(moved / "bin");
  std::filesystem::create_directories(moved / "lib/presa");
  std::filesystem::copy_file(PRESA_BINARY_DIR "/bin/presa-stability", program);
  // the folder experiments is looked for above the library
  std::filesystem::copy_file(PRESA_BINARY_DIR "/lib/presa/libpresa_framework.so",
                             moved / "lib/presa/libpresa_framework.so");
  const auto outcome = test::shell("cd " + folder.string() + "; LD_LIBRARY_PATH=" + (moved / "lib/presa").string() +
                                   " " + program.string() + " --quick");
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("error[E615]"));
  EXPECT_THAT(outcome.err, HasSubstr("set PRESA_EXPERIMENTS to the folder experiments"));
}

// A run that is refused leaves nothing behind.
TEST(Mistakes, WriteNothing) {
  const std::string summary = scratch("never.json");
  EXPECT_EQ(test::presa(withFiles("run CUBE --lockstep --for 0.1 --report /proc/r.html --summary ") + summary).status,
            2);
  EXPECT_FALSE(std::filesystem::exists(summary));
}

}  // namespace
}  // namespace presa
