#pragma once
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace presa {

inline const std::string kCube = std::string(PRESA_SOURCE_DIR) + "/config/scenes/cube.xml";
inline constexpr double kPatience = 30;  // maximum wait for expected samples on a busy machine [s]

/// Loopback and a random domain that no other test has.
inline BusSettings ownDomain() {
  std::random_device random;
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) throw std::runtime_error("no socket");
  for (int tries = 0; tries < 1000; ++tries) {
    const int domain = 1 + static_cast<int>(random() % kMaxBusDomain);
    // a name that this process holds until it ends: no test that runs beside it gets the same domain
    sockaddr_un name{.sun_family = AF_UNIX, .sun_path = {}};
    const std::string text = "presa-test-domain-" + std::to_string(domain);
    text.copy(name.sun_path + 1, text.size());  // the leading zero makes it a name without a file
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
    if (bind(fd, reinterpret_cast<const sockaddr*>(&name), length) == 0)
      return {.network = "loopback", .domain = domain};
  }
  throw std::runtime_error("no free domain");
}

/// The program in a separate process, killed with this object if it is still running. Captures its stderr and stdout.
class ViewerProcess {
 public:
  ViewerProcess(std::vector<std::string> words, const BusSettings& bus) {
    words.insert(words.begin(), std::string(PRESA_BINARY_DIR) + "/bin/presa");
    if (!bus.network.empty()) words.insert(words.end(), {"--bus", bus.network, "--domain", std::to_string(bus.domain)});
    if (!bus.keys.empty()) words.insert(words.end(), {"--bus-keys", bus.keys});
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int failed = posix_spawn(&process_, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    said_ = fdopen(ends[0], "r");
    if (failed != 0) throw std::runtime_error("the program does not start");
  }
  ~ViewerProcess() {
    signal(SIGKILL);
    end();
    std::fclose(said_);
  }
  ViewerProcess(const ViewerProcess&) = delete;
  ViewerProcess& operator=(const ViewerProcess&) = delete;

  /// Waits for an output line that contains `word`; false: it ended without one.
  bool says(const std::string& word) {
    std::array<char, 4096> line;
    while (std::fgets(line.data(), line.size(), said_) != nullptr) {
      if (std::string(line.data()).find(word) != std::string::npos) return true;
    }
    return false;
  }
  void signal(int which) const {
    if (process_ > 0) kill(process_, which);
  }
  /// The remaining output.
  std::string rest() {
    std::string all;
    std::array<char, 4096> part;
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), said_)) all.append(part.data(), count);
    return all;
  }
  /// Waits for the end; returns the exit status, -1 if a signal ended it.
  int end() {
    if (process_ <= 0) return status_;
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return status_;
  }

 private:
  pid_t process_ = -1;
  std::FILE* said_ = nullptr;
  int status_ = -1;
};

struct Said {
  std::string text;
  int status;
};

/// Runs the program to its end.
inline Said say(const BusSettings& bus, std::vector<std::string> words) {
  ViewerProcess process(std::move(words), bus);
  std::string text = process.rest();
  return {text, process.end()};
}

}  // namespace presa
