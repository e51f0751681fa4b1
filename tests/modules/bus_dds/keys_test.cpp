// Access control with keys: DDS Security, tested over loopback, because the code is the same on every network.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/bus/bus_keys.h"
#include "framework/bus/guide_link.h"
#include "framework/bus/state_bus.h"
#include "framework/core/schedule/clock.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::bus {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Two laboratories, each with its own authority.
class BusKeys : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::remove_all(root());
    fs::create_directories(root());
    for (const char* lab : {"ours", "theirs"}) {
      const Said made = say({.network = ""}, {"bus", "keys", root() / lab});
      ASSERT_EQ(made.status, 0) << made.text;
    }
  }
  static void TearDownTestSuite() { fs::remove_all(root()); }
  static fs::path root() { return fs::path(testing::TempDir()) / ("bus_keys_" + std::to_string(getpid())); }
  BusSettings as(const std::string& part) const {
    BusSettings settings = bus_;
    settings.keys = root() / part;
    return settings;
  }
  const BusSettings bus_ = ownDomain();
};

// One run, and all kinds of viewers and commanders.
TEST_F(BusKeys, LetInWhoHasThemAndNobodyElse) {
  ViewerProcess run({"run", kCube, "--lockstep", "--speed", "0.02", "--for", "4", "--quiet", "--bus-commands"},
                    as("ours/run"));
  const std::vector<std::string> listen{"bus", "listen", "--for", "1", "--wait", "30", "--json"},
      briefly{"bus", "listen", "--for", "1", "--wait", "3", "--json"};
  const Said viewer = say(as("ours/viewer"), listen);
  EXPECT_THAT(viewer.text, HasSubstr("\"joined\": true")) << viewer.text;
  EXPECT_THAT(viewer.text, Not(HasSubstr("\"received\": 0,"))) << viewer.text;
  const Said nobody = say(bus_, briefly);
  EXPECT_THAT(nobody.text, HasSubstr("\"joined\": false")) << nobody.text;
  const Said stranger = say(as("theirs/viewer"), briefly);
  EXPECT_THAT(stranger.text, HasSubstr("\"joined\": false")) << stranger.text;

  const std::vector<std::string> soften{"bus", "set", "material/rubber/stiffness=700", "--wait", "30"},
      try_it{"bus", "set", "material/rubber/stiffness=600", "--wait", "3"};
  const Said commander = say(as("ours/commander"), soften);
  EXPECT_EQ(commander.status, 0) << commander.text;
  EXPECT_THAT(commander.text, HasSubstr("stiffness = 700"));
  EXPECT_NE(say(as("ours/viewer"), try_it).status, 0);  // may view but not command
  EXPECT_NE(say(as("theirs/commander"), try_it).status, 0);
  EXPECT_NE(say(bus_, try_it).status, 0);
  EXPECT_THAT(say(as("ours/commander"), {"bus", "list", "--wait", "30"}).text, HasSubstr(" 700 "));
  run.signal(SIGINT);
  EXPECT_EQ(run.end(), 130);
}

// A viewer's certificate does not allow publishing state.
TEST_F(BusKeys, LetNoViewerPublish) {
  try {
    openWriter(as("ours/viewer"));
    FAIL() << "a viewer may publish";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("error[E720]"));
  }
}

// Nor does it allow guiding; that of a guide does.
TEST_F(BusKeys, LetOnlyAGuideOrder) {
  try {
    openOrderSender(as("ours/viewer"));
    FAIL() << "a viewer may order";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("error[E720]"));
  }
  EXPECT_NE(openOrderSender(as("ours/guide")), nullptr);
  EXPECT_NE(openOrderPost(as("ours/run")), nullptr);
}

TEST_F(BusKeys, AreNeededForCommandsOnLan) {
  const Said refused = say({.network = "lan"}, {"run", kCube, "--lockstep", "--for", "0.1", "--bus-commands"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.text, HasSubstr("error[E752]"));
  EXPECT_THROW(openPost({.network = "lan:lo"}), InputError);
  EXPECT_THROW(openOrderPost({.network = "lan:lo"}), InputError);
}

TEST_F(BusKeys, AreCheckedBeforeTheyAreUsed) {
  const Said missing = say(as("ours"), {"bus", "listen", "--wait", "1"});
  EXPECT_EQ(missing.status, 2) << missing.text;
  EXPECT_THAT(missing.text, HasSubstr("error[E753]"));
  const fs::path open = root() / "open";
  fs::copy(root() / "ours" / "viewer", open);
  chmod((open / "key.pem").c_str(), 0644);
  const Said readable = say(as("open"), {"bus", "listen", "--wait", "1"});
  EXPECT_EQ(readable.status, 2) << readable.text;
  EXPECT_THAT(readable.text, HasSubstr("others on this machine may read the private key"));
  chmod((open / "key.pem").c_str(), 0600);
  // modified permissions: the signature does not match any more
  std::string rules;
  {
    std::ifstream in(open / "permissions.p7s");
    rules.assign(std::istreambuf_iterator<char>(in), {});
  }
  rules.replace(rules.find("presa_beat"), 10, "presa_bear");
  std::ofstream(open / "permissions.p7s") << rules;
  const Said changed = say(as("open"), {"bus", "listen", "--wait", "1"});
  EXPECT_EQ(changed.status, 2) << changed.text;
  EXPECT_THAT(changed.text, HasSubstr("error[E720]"));
}

TEST_F(BusKeys, AreNeverWrittenOverAndNobodyElseReadsThem) {
  const Said again = say({.network = ""}, {"bus", "keys", root() / "ours"});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.text, HasSubstr("error[E754]"));
  for (const char* part : {"authority", "run", "viewer", "guide", "commander"}) {
    struct stat status {};
    ASSERT_EQ(stat((root() / "ours" / part / "key.pem").c_str(), &status), 0) << part;
    EXPECT_EQ(status.st_mode & 077U, 0u) << part;
  }
}

}  // namespace
}  // namespace presa::bus
