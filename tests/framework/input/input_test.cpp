#include "framework/input/input.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "framework/input/folders.h"
#include "tests/apps/presa/files/program.h"

namespace presa {
namespace {

namespace fs = std::filesystem;
using input::Refusal;
using input::Trouble;
using test::Bench;

Trouble troubleOf(const std::string& file, std::uint64_t max = 100) {
  Refusal refusal;
  const auto text = input::read(file, max, refusal);
  EXPECT_FALSE(text) << file;
  return refusal.trouble;
}

// A file is read completely up to the size limit, and refused one byte above it.
TEST(Door, GivesARegularFileUpToItsBound) {
  const Bench bench;
  const std::string text(100, 'x');
  bench.write("a", text);
  Refusal refusal;
  EXPECT_EQ(input::read(bench.file("a"), 100, refusal), text);
  EXPECT_EQ(troubleOf(bench.file("a"), 99), Trouble::kTooLarge);
  bench.write("empty", "");
  EXPECT_EQ(input::read(bench.file("empty"), 0, refusal), "");
}

// The logical size counts: holes take memory although they take no disk space.
TEST(Door, CountsHoles) {
  const Bench bench;
  bench.write("hole", "");
  fs::resize_file(bench.file("hole"), std::uint64_t{2} << 30U);
  EXPECT_EQ(troubleOf(bench.file("hole"), 1 << 20), Trouble::kTooLarge);
}

// A file of /proc reports size 0, so bytes are counted while reading.
TEST(Door, CountsWhatComesNotWhatIsSaid) {
  ASSERT_EQ(fs::file_size("/proc/self/maps"), 0u);
  Refusal refusal;
  const auto maps = input::read("/proc/self/maps", 1 << 20, refusal);
  ASSERT_TRUE(maps) << refusal.what;
  ASSERT_GT(maps->size(), 100u);
  EXPECT_EQ(troubleOf("/proc/self/maps", 100), Trouble::kTooLarge);
}

// None of these may block. With an ordinary open each case would hang or never end.
TEST(Door, LetsNothingInThatIsNoRegularFile) {
  const Bench bench;
  bench.fifo("fifo");
  fs::create_symlink("/dev/zero", bench.file("zero"));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string socket_name = bench.file("socket");
  ASSERT_LT(socket_name.size(), sizeof address.sun_path);
  std::strcpy(address.sun_path, socket_name.c_str());
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const std::string name : {"fifo", "zero", "socket"})
    EXPECT_EQ(troubleOf(bench.file(name)), Trouble::kNotRegular) << name;
  ::close(socket);
  EXPECT_EQ(troubleOf("/dev/null"), Trouble::kNotRegular);
  EXPECT_EQ(troubleOf(bench.file(".")), Trouble::kUnreadable);  // a folder: the reader's own code, as for a missing one
  EXPECT_EQ(troubleOf(bench.file("none")), Trouble::kUnreadable);
}

// The folder of the naming file and below, by real path: neither .. nor a link leads out.
TEST(Folders, AFileNamesOnlyWhatLiesBesideIt) {
  const Bench bench;
  bench.write("lab/sub/a.obj", "");
  bench.write("laboratory/b.obj", "");
  fs::create_symlink(bench.file("laboratory/b.obj"), bench.file("lab/link.obj"));
  fs::create_directory_symlink("/etc", bench.file("lab/etc"));
  const std::string lab = bench.file("lab");
  EXPECT_TRUE(input::mayName(lab, lab + "/sub/a.obj"));
  EXPECT_TRUE(input::mayName(lab, lab + "/sub/../sub/a.obj"));
  EXPECT_TRUE(input::mayName(lab, lab + "/not/there.obj"));
  EXPECT_FALSE(input::mayName(lab, lab + "/../laboratory/b.obj")) << "a folder whose name begins alike";
  EXPECT_FALSE(input::mayName(lab, lab + "/link.obj"));
  EXPECT_FALSE(input::mayName(lab, lab + "/etc/passwd"));
  EXPECT_FALSE(input::mayName(lab, "/etc/passwd"));
  EXPECT_TRUE(input::mayName(lab, PRESA_SOURCE_DIR "/config/meshes/amphora.obj")) << "Presa's own";
  EXPECT_FALSE(input::mayName(lab, PRESA_SOURCE_DIR "/config/../README.md"));
  input::allowFolder(bench.file("laboratory"));
  EXPECT_TRUE(input::mayName(lab, lab + "/../laboratory/b.obj"));
  EXPECT_TRUE(input::mayName(lab, lab + "/link.obj"));
  EXPECT_FALSE(input::mayName(lab, "/etc/passwd"));
}

TEST(Folders, SayWhereAFileWasLookedForAndWhatAllowsIt) {
  const Bench bench;
  Diagnostics diagnostics;
  EXPECT_FALSE(input::checkNamed({bench.file("scene.xml"), 3, 7}, "/etc/passwd", diagnostics));
  const std::string text = diagnostics.text();
  EXPECT_NE(text.find("scene.xml:3:7: error[E692]: '/etc/passwd' lies outside the folder"), std::string::npos) << text;
  EXPECT_NE(text.find("--allow-folder"), std::string::npos) << text;
}

}  // namespace
}  // namespace presa
