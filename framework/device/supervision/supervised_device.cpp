#include "framework/device/supervision/supervised_device.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "framework/core/schedule/clock.h"
#include "framework/plugin/plugin_loader.h"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace presa {
namespace {

enum SupervisedCode { kNotStarted = 498, kDied = 499 };

constexpr int kShareFd = 3, kLifeFd = 4;                              // in the supervisor
constexpr std::int64_t kLook = 5'000'000, kPatience = 1'000'000'000;  // [ns]

/// The new process keeps the standard streams, the shared memory and the pipe. It gets a session of its own, so that
/// Ctrl-C and Ctrl-Z reach only the program.
class SpawnSettings {
 public:
  SpawnSettings(int share_fd, int life_fd) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, share_fd, kShareFd);
    posix_spawn_file_actions_adddup2(&files_, life_fd, kLifeFd);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

/// Moves a descriptor to 16 or above, away from kShareFd and kLifeFd: dup2 onto itself would leave it closed on exec.
int movedUp(int fd) noexcept {
  const int moved = fcntl(fd, F_DUPFD_CLOEXEC, 16);
  ::close(fd);
  return moved;
}

}  // namespace

SupervisedDevice::SupervisedDevice(std::unique_ptr<Device> driver, const DeviceBinding& binding, std::string rig_file)
    : driver_(std::move(driver)), task_{binding, std::move(rig_file)} {}

void SupervisedDevice::refuse(int code, const std::string& message, const std::string& help) const {
  Diagnostics findings;
  findings.error(code, task_.binding.where, "role '" + task_.binding.role + "': " + message, help);
  throw InputError(findings);
}

void SupervisedDevice::spawn() {
  share_ = SharedMemory<SupervisorShare>::made("presa-supervisor");
  const std::string task = packed(task_);
  if (task.size() > sizeof share_->task) refuse(kNotStarted, "its settings are too long for its supervisor", "");
  std::memcpy(share_->task, task.data(), task.size());
  share_->task_size = task.size();

  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) refuse(kNotStarted, "its supervisor does not start", std::strerror(errno));
  const int heard = movedUp(pipe_ends[0]), shared = fcntl(share_.fd(), F_DUPFD_CLOEXEC, 16);
  life_ = movedUp(pipe_ends[1]);
  const std::string program = helperProgram("presa_supervisor");
  std::string name = "presa_supervisor";
  char* const arguments[] = {name.data(), task_.binding.role.data(), nullptr};
  const SpawnSettings settings(shared, heard);
  const int failed = posix_spawn(&child_, program.c_str(), &settings.files_, &settings.attributes_, arguments, environ);
  ::close(heard);
  ::close(shared);
  if (failed == 0) return;
  child_ = -1;
  end();
  refuse(kNotStarted, "its supervisor does not start: " + program, std::strerror(failed));
}

bool SupervisedDevice::hasEnded() noexcept {
  if (child_ < 0) return true;
  int status = 0;
  if (waitpid(child_, &status, WNOHANG) == 0) return false;
  child_ = -1;
  return true;
}

void SupervisedDevice::open() {
  start(false);
  notes_.push_back(task_.binding.role + ": held by process " + std::to_string(child_) +
                   ", which takes the force to zero when this one stops or dies");
}

void SupervisedDevice::reopen(const std::atomic<bool>& stop) {
  if (!lost_.load(std::memory_order_acquire)) return;
  end();
  retired_.push_back(std::move(share_));
  start(stop);
}

void SupervisedDevice::start(const std::atomic<bool>& stop) {
  using State = SupervisorShare::State;
  spawn();
  while (share_->state.load(std::memory_order_acquire) == State::kStarting && !hasEnded()) {
    if (stop.load(std::memory_order_relaxed)) return end();
    sleepUntilNs(monotonicNs() + kLook);
  }
  const State state = share_->state.load(std::memory_order_acquire);
  const std::string_view answer{share_->answer, share_->answer_size};
  if (state == State::kRefused) {
    const Diagnostics findings = unpackedFindings(answer);
    end();
    throw InputError(findings);
  }
  if (state != State::kRunning) {
    end();
    refuse(kDied, "its supervisor ended before it had opened the device", "please report this, with the rig");
  }
  notes_ = unpackedLines(answer);
  live_.store(&*share_, std::memory_order_release);
}

void SupervisedDevice::close() noexcept { end(); }

void SupervisedDevice::end() noexcept {
  if (share_) share_->close.store(true, std::memory_order_relaxed);
  if (life_ >= 0) ::close(std::exchange(life_, -1));
  for (const std::int64_t begin = monotonicNs(); !hasEnded(); sleepUntilNs(monotonicNs() + kLook)) {
    if (monotonicNs() - begin > kPatience) kill(child_, SIGKILL);
  }
}

FingerInput SupervisedDevice::read(const Tick& tick) noexcept {
  SupervisorShare& share = *live_.load(std::memory_order_acquire);
  // catch-up ticks come all at once: no time has passed between them
  if (share.report.update() || std::exchange(seen_, &share) != &share)
    silence_ = 0;
  else if (!tick.catch_up)
    silence_ += tick.period;
  const SupervisorReport& report = share.report.value();
  FingerInput finger = report.finger;
  if (report.rearms_done != share.rearms.load(std::memory_order_relaxed))
    finger.lost = false;  // from before the re-arm
  finger.valid = finger.valid && !report.dropped && silence_ <= kSilent;
  finger.lost = finger.lost || silence_ > kDead;
  finger.age += silence_;
  lost_.store(finger.lost, std::memory_order_release);
  return finger;
}

void SupervisedDevice::write(const Wrench& F_H_W, const Tick& tick) noexcept {
  live_.load(std::memory_order_relaxed)->command.publish({F_H_W}, tick.time);
}

void SupervisedDevice::rearm() noexcept {
  live_.load(std::memory_order_relaxed)->rearms.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace presa
