#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "apps/temple/voice.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

/// A PATH on which espeak-ng writes down what it is asked to say, and speaks into a file where the real one is installed.
class VoiceTest : public testing::Test {
 protected:
  VoiceTest() : folder_(test::scratch("voice")), path_(std::getenv("PATH")) {
    std::ofstream script(folder_ + "/espeak-ng");
    script << "#!/bin/sh\necho \"$@\" >> '" << folder_ << "/said'\n"
           << "[ ! -x /usr/bin/espeak-ng ] || /usr/bin/espeak-ng -w '" << folder_
           << "/said.wav' \"$@\" || echo failed >> '" << folder_ << "/said'\nexec sleep 5\n";
    script.close();
    std::filesystem::permissions(folder_ + "/espeak-ng", std::filesystem::perms::owner_all);
    setenv("PATH", (folder_ + ":" + path_).c_str(), 1);
  }
  ~VoiceTest() override { setenv("PATH", path_.c_str(), 1); }

  /// What was said, once it has this many lines; waits for the other process.
  std::string said(long lines) const {
    std::string text;
    for (int i = 0; i < 500; ++i) {
      std::ostringstream all;
      all << std::ifstream(folder_ + "/said").rdbuf();
      text = all.str();
      if (std::ranges::count(text, '\n') >= lines) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return text;
  }

  const std::string folder_, path_;
};

TEST_F(VoiceTest, SaysEachSentenceOnceAndInterruptsTheLastOne) {
  const auto begin = std::chrono::steady_clock::now();
  {
    Voice voice("it");
    voice.say("");
    voice.say("Un cuscino rotondo.");
    voice.say("Un cuscino rotondo.");
    EXPECT_EQ(said(1), "-v it -s 150 -- Un cuscino rotondo.\n");
    voice.say("-- La trave.");  // not an option
    EXPECT_EQ(said(2), "-v it -s 150 -- Un cuscino rotondo.\n-v it -s 150 -- -- La trave.\n");
  }
  // neither sentence was waited for
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(VoiceTest, IsRefusedWhereNothingSpeaks) {
  Diagnostics diagnostics;
  Voice::check(diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  setenv("PATH", "/nowhere", 1);
  Voice::check(diagnostics);
  EXPECT_NE(diagnostics.text().find("error[E965]"), std::string::npos);
  Voice("en").say("Nobody hears this.");
}

}  // namespace
}  // namespace presa::temple
