#include "framework/device/supervision/supervisor.h"

#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "framework/core/schedule/clock.h"
#include "framework/device/device_plugin.h"
#include "framework/device/supervision/shared_memory.h"
#include "framework/device/supervision/task.h"
#include "framework/device/transport_watch.h"

namespace presa {
namespace {

constexpr int kPriority = 84;  // above the program's haptic thread and a driver's own

/// Ctrl-C, Ctrl-Z and a closed terminal are meant for the program, not for its supervisor.
void ignoreSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGTTIN, SIGTTOU, SIGPIPE})
    std::signal(signal, SIG_IGN);
}

void answer(SupervisorShare& share, const std::string& text, SupervisorShare::State state) {
  share.answer_size = std::min(text.size(), sizeof share.answer);
  std::memcpy(share.answer, text.data(), share.answer_size);
  share.state.store(state, std::memory_order_release);
}

/// The part of a world that a hardware driver may use: its binding and its role.
std::shared_ptr<const World> worldOf(const SupervisorTask& task) {
  auto world = std::make_shared<World>();
  world->rig.file = task.rig_file;
  world->rig.devices = {task.binding};
  world->scene.devices.emplace_back().role = task.binding.role;
  return world;
}

std::unique_ptr<Device> openDevice(const SupervisorTask& task) {
  Diagnostics diagnostics;
  RunOptions options;
  options.realtime = true;
  DeviceList made = devicePlugin(task.binding.driver).create({task.binding}, worldOf(task), options, diagnostics);
  if (diagnostics.hasErrors() || made.size() != 1 || !made.front()) throw InputError(diagnostics);
  made.front()->open();
  return std::move(made.front());
}

std::vector<std::string> becomeRealTime(const std::string& role) {
  std::vector<std::string> notes;
  const sched_param priority{.sched_priority = kPriority};
  if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    notes.push_back(role + ": its supervisor runs without SCHED_FIFO (" + std::strerror(errno) +
                    "): other programs may delay it");
  if (mlockall(MCL_CURRENT) != 0)
    notes.push_back(role + ": its supervisor's memory is not locked (" + std::strerror(errno) + ")");
  prctl(PR_SET_TIMERSLACK, 1);
  return notes;
}

bool isGone(int life_fd) noexcept {
  pollfd life{.fd = life_fd, .events = 0, .revents = 0};
  return poll(&life, 1, 0) > 0 && (life.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

void runCycles(Supervisor& supervisor, double period, int life_fd) {
  const auto period_ns = static_cast<std::int64_t>(period * 1e9);
  bool alone = false;
  std::int64_t look = 0;  // next poll of the pipe; 1 ms suffices, because a dead program also stops sending commands
  std::int64_t before = monotonicNs();
  for (std::int64_t wake = before;;) {
    wake += period_ns;
    sleepUntilNs(wake);
    const std::int64_t now = monotonicNs();
    if (now > wake)
      wake += (now - wake) / period_ns * period_ns;  // missed cycles are skipped; the next one comes at its time
    if (wake >= look) {
      alone = alone || isGone(life_fd);
      look = wake + 1'000'000;
    }
    if (!supervisor.cycle(alone, static_cast<double>(now - before) * 1e-9)) return;
    before =
        monotonicNs();  // after the write: a delay within this cycle does not count as elapsed time of the next one
  }
}

}  // namespace

Supervisor::Supervisor(SupervisorShare& share, std::unique_ptr<Device> device, const DeviceRating& rating,
                       CountAllocations count)
    : share_(share),
      device_(watched(std::move(device), limitsOf(rating), rating)),
      keeper_(rating),
      count_(count),
      allocated_before_(count()) {}

bool Supervisor::cycle(bool alone, double elapsed) noexcept {
  time_ += elapsed;
  const Tick tick{.index = report_.cycles, .time = time_, .period = elapsed};
  if (const std::uint32_t rearms = share_.rearms.load(std::memory_order_relaxed); rearms != report_.rearms_done) {
    device_->rearm();
    keeper_.rearm();
    report_.rearms_done = rearms;
  }
  const bool ending = alone || share_.close.load(std::memory_order_relaxed);
  report_.finger = device_->read(tick);
  const bool fresh = share_.command.update();
  report_.sent = keeper_.step(
      {.fresh = fresh, .alone = ending, .command = share_.command.value().F_H_W, .finger = report_.finger}, elapsed);
  device_->write(report_.sent, tick);
  report_.dropped = keeper_.dropped();
  ++report_.cycles;
  report_.allocated = count_() - allocated_before_;
  share_.report.publish(report_, tick.time);
  zero_force_time_ = ending && report_.sent == Wrench() ? zero_force_time_ + elapsed : 0;
  return zero_force_time_ < kZeroForceTime;
}

int superviseDevice(int share_fd, int life_fd, CountAllocations count) {
  ignoreSignals();
  SharedMemory<SupervisorShare> memory = SharedMemory<SupervisorShare>::joined(share_fd);
  SupervisorShare& share = *memory;
  const SupervisorTask task = unpackedTask({share.task, share.task_size});
  try {
    std::unique_ptr<Device> device = openDevice(task);
    std::vector<std::string> notes = device->notes();
    for (std::string& note : becomeRealTime(task.binding.role)) notes.push_back(std::move(note));
    answer(share, packed(notes), SupervisorShare::State::kRunning);
    Supervisor supervisor(share, std::move(device), devicePlugin(task.binding.driver).rating, count);
    runCycles(supervisor, share.period, life_fd);
    supervisor.close();
  } catch (const InputError& error) {
    answer(share, packed(error.diagnostics()), SupervisorShare::State::kRefused);
    return 2;
  }
  share.state.store(SupervisorShare::State::kOver, std::memory_order_release);
  return 0;
}

}  // namespace presa
