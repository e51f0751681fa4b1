#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "experiments/faults/probe/probe_log.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/schedule/clock.h"
#include "framework/device/device_plugin.h"

namespace presa::faults {
namespace {

/// Replacement for hardware: a finger at a fixed position that logs every force it receives.
class Probe final : public Device {
 public:
  Probe(std::string file, const Vec3& p_WH, double stall) : file_(std::move(file)), p_WH_(p_WH), stall_(stall) {}
  ~Probe() override { close(); }

  void open() override {
    const int fd = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
    if (fd < 0) refuse(478, file_, "cannot be opened");
    void* memory = mmap(nullptr, sizeof(ProbeLog), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, fd, 0);
    ::close(fd);
    if (memory == MAP_FAILED) refuse(478, file_, "cannot be mapped");
    log_ = static_cast<ProbeLog*>(memory);
    log_->writer = getpid();
  }
  void close() noexcept override {
    if (log_ != nullptr) munmap(log_, sizeof(ProbeLog));
    log_ = nullptr;
  }
  FingerInput read(const Tick&) noexcept override {
    FingerInput finger;
    finger.p_WH = p_WH_;
    finger.valid = true;
    return finger;
  }
  void write(const Wrench& F_H_W, const Tick&) noexcept override {
    const bool falls = F_H_W.f.norm() < 0.99 * sent_.norm();
    if (falls && stall_ > 0) sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(1e9 * std::exchange(stall_, 0)));
    const std::uint64_t entry = log_->written.load(std::memory_order_relaxed);
    if (entry < ProbeLog::kEntries) {
      log_->entries[entry] = {monotonicNs(), F_H_W.f.norm(), (F_H_W.f - sent_).norm()};
      log_->written.store(entry + 1, std::memory_order_release);
    }
    sent_ = F_H_W.f;
  }

 private:
  std::string file_;
  Vec3 p_WH_, sent_ = Vec3::Zero();
  double stall_ = 0;  // before the first lower force [s]
  ProbeLog* log_ = nullptr;
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World&, Diagnostics& diagnostics) {
  const auto stall = binding.settings.find("stall");
  const auto log = binding.settings.find("log"), pos = binding.settings.find("pos");
  Vec3 p = Vec3::Zero();
  if (log == binding.settings.end() || pos == binding.settings.end() ||
      std::sscanf(pos->second.value.c_str(), "%lf %lf %lf", &p[0], &p[1], &p[2]) != 3) {
    diagnostics.error(479, binding.where, "a probe needs the settings log (a file) and pos (three numbers)");
    return nullptr;
  }
  const double late = stall == binding.settings.end() ? 0 : std::atof(stall->second.value.c_str());
  return std::make_unique<Probe>(log->second.value, p, late);
}

const DevicePlugin kPlugin{
    .name = "fault_probe", .create = createEach<create>, .rating = {.force = 10}, .hardware = true};

}  // namespace
}  // namespace presa::faults

PRESA_DEVICE_PLUGIN(presa::faults::kPlugin)
