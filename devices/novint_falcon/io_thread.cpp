#include "devices/novint_falcon/io_thread.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include "framework/core/schedule/clock.h"

namespace presa::falcon {
namespace {

constexpr std::int64_t kWake = 250'000;   // [ns]
constexpr int kPriority = 82;             // above the haptic thread (80), so that it does not delay this thread
constexpr double kZeroForceTime = 20e-3;  // [s] of zero force at the end
constexpr double kEndPatience = 1;        // [s] max wait at the end for a device that accepts no requests

}  // namespace

FalconIo::FalconIo(std::unique_ptr<FalconTransport> transport, std::vector<std::uint8_t> firmware,
                   const LinkSettings& settings)
    : transport_(std::move(transport)),
      firmware_(std::move(firmware)),
      link_(*transport_, firmware_, settings),
      thread_([this] { run(); }) {}

FalconIo::~FalconIo() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

LinkSample FalconIo::latest(const Tick& tick) noexcept {
  // asked before the sample is taken, which may be from before the re-arm
  const bool rearming = rearms_done_.load(std::memory_order_acquire) != rearms_.load(std::memory_order_relaxed);
  // catch-up ticks after a late wake-up come all at once: no time has passed between them
  if (sample_.update()) {
    silence_ = 0;
  } else if (!tick.catch_up) {
    silence_ += tick.period;
  }
  LinkSample sample = sample_.value();
  sample.valid = sample.valid && silence_ <= FalconLink::kHold;
  sample.lost = sample.lost && !rearming;
  return sample;
}

LinkStatus FalconIo::status() noexcept {
  status_.update();
  return status_.value();
}

void FalconIo::run() noexcept {
  pthread_setname_np(pthread_self(), "presa-falcon");
  prctl(PR_SET_TIMERSLACK, 1);
  const std::int64_t start = monotonicNs();
  const auto seconds = [start](std::int64_t ns) { return static_cast<double>(ns - start) * 1e-9; };
  link_.open(0);
  double end = 0;
  for (std::int64_t wake = start;;) {
    wake += kWake;
    sleepUntilNs(wake);
    const std::int64_t now = monotonicNs();
    if (now - wake > kWake) wake = now;  // more than a period late: skip the missed wake-ups
    if (end == 0 && stop_.load(std::memory_order_relaxed)) {
      link_.release();
      end = seconds(now) + kZeroForceTime;
    }
    step(seconds(now));
    if (end > 0 && link_.status().state == LinkState::kDead) return;
    if (end > 0 && seconds(now) >= (link_.status().quiet ? end : end + kEndPatience)) return;
  }
}

void FalconIo::step(double now) noexcept {
  const std::uint32_t rearms = rearms_.load(std::memory_order_relaxed);
  if (rearms != rearms_done_.load(std::memory_order_relaxed)) link_.rearm();
  if (force_.update()) command_ = {force_.value(), now};
  link_.step(now, command_);
  sample_.publish(link_.sample(), now);
  rearms_done_.store(rearms, std::memory_order_release);
  const LinkStatus status = link_.status();
  status_.publish(status, now);
  // only now: control requests block and may spin
  if (status.state != LinkState::kStarting && refused_.load(std::memory_order_relaxed) < 0) raisePriority();
}

void FalconIo::raisePriority() noexcept {
  const sched_param param{.sched_priority = kPriority};
  refused_.store(pthread_setschedparam(pthread_self(), SCHED_FIFO, &param), std::memory_order_relaxed);
}

}  // namespace presa::falcon
