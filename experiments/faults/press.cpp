#include "experiments/faults/press.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>

#include "experiments/study/experiment_file.h"
#include "framework/core/schedule/clock.h"
#include "framework/session/run.h"

namespace presa::faults {
namespace {

constexpr double kStartPatience = 60, kPatience = 5;  // for the first write, and from it until the finger presses [s]

/// Creates the shared log and returns its path /proc/PID/fd/N, which the program under test opens.
std::string makeLog(ProbeLog*& log) {
  const int fd = memfd_create("presa-probe", 0);
  if (fd < 0 || ftruncate(fd, sizeof(ProbeLog)) != 0) throw std::runtime_error("no memory for the probe's log");
  void* memory = mmap(nullptr, sizeof(ProbeLog), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory for the probe's log");
  log = new (memory) ProbeLog;
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(fd);
}

std::string textOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string limitsElement(const std::string& limits) { return limits.empty() ? "" : "<limits " + limits + "/>"; }

/// The text of a scene file with limits added to its finger.
std::string sceneText(const std::string& file, const std::string& limits) {
  std::string text = textOf(file);
  const std::string plain = "<device role=\"finger\"/>";
  return text.replace(text.find(plain), plain.size(), "<device role=\"finger\">" + limitsElement(limits) + "</device>");
}

std::string rigText(const std::string& log, const PressingProgram::Limits& limits) {
  const auto set = [](const std::string& key, const std::string& value) {
    return "<set key=\"" + key + "\" value=\"" + value + "\"/>";
  };
  return "<rig version=\"1.0\" name=\"probe\"><device role=\"finger\" driver=\"fault_probe\">" + set("log", log) +
         set("pos", "0 0 0.004") + set("stall", std::to_string(limits.stall)) + limitsElement(limits.rig) +
         "</device></rig>";
}

/// Becomes `presa`, which lies beside this program, as a user would start it.
[[noreturn]] void becomePresa(const std::string& rig) {
  const std::string presa = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "presa").string();
  const std::string scene = experimentFile("faults/press.xml");
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1}) dup2(nowhere, stream);
  execl(presa.c_str(), presa.c_str(), "run", scene.c_str(), "--rig", rig.c_str(), "--realtime", "--for", "3600",
        "--quiet", static_cast<char*>(nullptr));
  throw std::runtime_error(presa + " cannot be started");
}

/// Runs the program under test until it is killed.
[[noreturn]] void runProgram(const std::string& log, const std::string& rig_file,
                             const PressingProgram::Limits& limits) {
  try {
    if (limits.presa) becomePresa(rig_file);
    const std::string scene = experimentFile("faults/press.xml"), rig = rigText(log, limits);
    RunOptions options;
    options.realtime = true;
    options.duration = 3600;
    Diagnostics diagnostics;
    Loaded loaded = loadWorldFromText({sceneText(scene, limits.scene), scene, rig}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    RunControl control;
    Run(std::move(loaded), control).execute();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  _exit(1);
}

/// True when the process has ended or is a zombie.
bool isOver(pid_t process) {
  const std::string stat = textOf("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name_end = stat.rfind(')');
  return name_end == std::string::npos || name_end + 2 >= stat.size() || stat[name_end + 2] == 'Z';
}

void nap() { sleepUntilNs(monotonicNs() + 1'000'000); }

}  // namespace

PressingProgram::PressingProgram(const Limits& limits) : file_(makeLog(log_)), rig_(rigText(file_, limits), ".xml") {
  program_ = fork();
  if (program_ < 0) throw std::runtime_error("no process for the pressing program");
  if (program_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // end with the parent, so that nobody is left pressing
    runProgram(file_, rig_.path(), limits);
  }
  problem_ = waitUntilPressed();
}

PressingProgram::~PressingProgram() {
  kill(program_, SIGKILL);
  waitpid(program_, nullptr, 0);
  isReleased();
  munmap(log_, sizeof(ProbeLog));
  ::close(std::stoi(file_.substr(file_.rfind('/') + 1)));
}

double longestPause(const ProbeLog& log, std::int64_t begin_ns) {
  const std::uint64_t written = log.written.load(std::memory_order_acquire);
  std::int64_t longest = 0;
  for (std::uint64_t i = 1; i < written; ++i) {
    if (log.entries[i].time_ns >= begin_ns)
      longest = std::max(longest, log.entries[i].time_ns - log.entries[i - 1].time_ns);
  }
  return static_cast<double>(longest) * 1e-9;
}

std::string PressingProgram::waitUntilPressed() {
  double force = 0;
  std::uint64_t written = 0;
  const std::int64_t begin = monotonicNs();
  const auto isPatient = [&] {
    const std::int64_t since = written > 0 ? log_->entries[0].time_ns : begin;
    return static_cast<double>(monotonicNs() - since) * 1e-9 < (written > 0 ? kPatience : kStartPatience);
  };
  for (; isPatient(); nap()) {
    written = log_->written.load(std::memory_order_acquire);
    force = written > 0 ? log_->entries[written - 1].force : 0;
    if (force > 0.99 * kForce) return {};
    if (longestPause(*log_, 0) > kLoss) return "the supervisor was held up before the finger pressed";
    if (int status = 0; waitpid(program_, &status, WNOHANG) != 0) {
      return "the program ended by itself, " + (WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                                    : "status " + std::to_string(WEXITSTATUS(status)));
    }
  }
  return "the program does not press its finger: " + std::to_string(force) + " N " +
         (written > 0 ? "five seconds after the first write" : "in a minute, without a write");
}

bool PressingProgram::isReleased() const {
  const pid_t supervisor = log_->writer;
  for (const std::int64_t begin = monotonicNs(); supervisor > 0 && !isOver(supervisor); nap()) {
    if (monotonicNs() - begin > 2'000'000'000) return false;
  }
  return true;
}

}  // namespace presa::faults
