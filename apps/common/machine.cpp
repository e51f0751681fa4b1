#include "apps/common/machine.h"

#include <sys/utsname.h>

#include <Eigen/Core>
#include <array>
#include <ctime>
#include <fstream>
#include <thread>

#include "apps/common/version.h"

namespace presa {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string load() {
  std::ifstream info("/proc/loadavg");
  std::string one, five, fifteen;
  info >> one >> five >> fifteen;
  return one + ", " + five + ", " + fifteen;
}

std::string system() {
  utsname name{};
  if (::uname(&name) != 0) return "unknown";
  return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machineFacts() {
  return {{"processor", processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " available"},
          {"load average", load()},
          {"system", system()},
          {"compiler", std::string("gcc ") + __VERSION__},
          {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"Presa", versionText()}};
}

std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::string localNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::localtime_r(&now, &parts);
  std::array<char, 48> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S %z", &parts);
  return text.data();
}

std::string machineLine() {
  return processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " + system();
}

}  // namespace presa
