// Sockets of `--bus loopback`: the kernel's own list, and reachability from another machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <fstream>
#include <set>
#include <sstream>

#include "framework/bus/loopback_only.h"
#include "framework/bus/state_bus.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::bus {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Local addresses of this process's UDP sockets from /proc/net/udp, hexadecimal: 0100007F is 127.0.0.1.
std::multiset<std::string> udpAddresses() {
  std::set<std::string> own;
  for (int descriptor = 0; descriptor < 256; ++descriptor) {
    std::array<char, 64> target{};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    if (readlink(link.c_str(), target.data(), target.size() - 1) > 0) own.insert(target.data());
  }
  std::multiset<std::string> addresses;
  for (const char* table : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream in(table);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string slot, local, skipped, inode;
      words >> slot >> local;
      for (int i = 0; i < 7; ++i) words >> skipped;
      words >> inode;
      if (own.contains("socket:[" + inode + "]")) addresses.insert(local.substr(0, local.find(':')));
    }
  }
  return addresses;
}

TEST(BusLoopback, BindsEverySocketToTheLoopback) {
  ASSERT_TRUE(udpAddresses().empty());
  const BusSettings bus = ownDomain();
  const auto writer = openWriter(bus);
  const auto reader = openReader(bus);
  const auto addresses = udpAddresses();
  EXPECT_GE(addresses.size(), 3u);
  EXPECT_EQ(addresses.count("0100007F"), addresses.size());
}

// Only sockets bound while a LoopbackOnly exists are affected.
TEST(BusLoopback, ChangesNobodyElsesSockets) {
  { const LoopbackOnly inside; }
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  ASSERT_EQ(::bind(descriptor, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
  EXPECT_EQ(udpAddresses().count("00000000"), 1u);
  close(descriptor);
}

struct Seen {
  std::string text;
  int status = -1;
};

Seen fromTheOtherHost(const std::string& network) {
  const std::string script = std::string(PRESA_SOURCE_DIR) + "/tests/modules/bus_dds/two_hosts.sh",
                    command = "bash " + script + " " + PRESA_BINARY_DIR + "/bin/presa " + PRESA_SOURCE_DIR +
                              "/config/scenes/cube.xml " + network;
  Seen seen;
  std::FILE* out = popen(command.c_str(), "r");
  std::array<char, 4096> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), out)) seen.text.append(part.data(), count);
  const int status = pclose(out);
  seen.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return seen;
}

// A neighbouring host that knows the ports sends packets to a run on loopback: the kernel refuses each. The same host
// reaches a run on lan, which proves that the connection works.
TEST(BusLoopback, IsOutOfReachOfAnotherHost) {
  const Seen loopback = fromTheOtherHost("loopback");
  if (loopback.status == 77)
    GTEST_SKIP()
        << "this system lets nobody make network namespaces and set their routes (unshare --net, /proc/sys/net)";
  ASSERT_EQ(loopback.status, 0) << loopback.text;
  EXPECT_THAT(loopback.text, AllOf(HasSubstr("listens 127.0.0.1%lo:7410\n"), HasSubstr("listens 127.0.0.1%lo:7411\n"),
                                   Not(HasSubstr("listens 0.0.0.0")), Not(HasSubstr("listens *"))));
  for (const char* place : {"10.9.8.1:7410", "10.9.8.1:7411", "127.0.0.1:7410", "127.0.0.1:7411"})
    EXPECT_THAT(loopback.text, HasSubstr(std::string(place) + " refused\n")) << loopback.text;
  const Seen lan = fromTheOtherHost("lan:here");
  ASSERT_EQ(lan.status, 0) << lan.text;
  EXPECT_THAT(lan.text, HasSubstr("10.9.8.1:7410 open\n"));
}

}  // namespace
}  // namespace presa::bus
