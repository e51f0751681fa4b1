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

/// The time now, taken apart for a zone by `parts`.
std::string now(const char* pattern, std::tm* (*parts)(const std::time_t*, std::tm*)) {
  const std::time_t time = std::time(nullptr);
  std::tm split{};
  parts(&time, &split);
  std::array<char, 48> text{};
  std::strftime(text.data(), text.size(), pattern, &split);
  return text.data();
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

std::string hardwareText() {
  std::string text;
  for (const auto& [name, value] : machineFacts())
    if (name != "load average") text += (text.empty() ? "" : "; ") + value;
  return text;
}

std::string utcNow() { return now("%Y-%m-%dT%H:%M:%SZ", ::gmtime_r); }

std::string localNow() { return now("%Y-%m-%d %H:%M:%S %z", ::localtime_r); }

std::string machineLine() {
  return processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " + system();
}

}  // namespace presa
