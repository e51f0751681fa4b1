#include <algorithm>
#include <random>

#include "framework/device/device_plugin.h"
#include "framework/device/wrapped_device.h"

namespace presa {
namespace {

/// A scripted finger whose hand presses buttons 1 (clutch), 2 and 3 (zoom) at random between two times, that may have
/// no samples between two others, and that measures what its device does to it: in the device's own frame, after
/// everything that the framework does to a force.
class RestlessFinger final : public WrappedDevice {
 public:
  struct Lost {
    double from, until;  // [s]
  };
  RestlessFinger(std::unique_ptr<Device> scripted, double from, double until, Lost lost, unsigned seed)
      : WrappedDevice(std::move(scripted)), from_(from), until_(until), lost_(lost), random_(seed) {}

  FingerInput read(const Tick& tick) noexcept override {
    FingerInput sample = inner().read(tick);
    if (tick.time >= lost_.from && tick.time < lost_.until) sample.valid = false;
    if (started_) energy_ += sent_.dot(sample.p_WH - x_);
    peak_energy_ = std::max(peak_energy_, energy_);
    x_ = sample.p_WH;
    started_ = true;
    if (tick.index % kHold == 0) pressed_ = random_() % 2 == 0 ? 0U : 2U << (random_() % 3);
    const bool restless = tick.time >= from_ && tick.time < until_;
    sample.buttons = restless ? pressed_ : 0;
    return sample;
  }
  void write(const Wrench& F_H, const Tick& tick) noexcept override {
    rate_ = std::max(rate_, (F_H.f - sent_).norm() / tick.period);
    force_ = std::max(force_, F_H.f.norm());
    touches_ += sent_.isZero() && !F_H.f.isZero() ? 1 : 0;
    felt_ += F_H.f.isZero() ? 0 : 1;  // ticks
    sent_ = F_H.f;
    inner().write(F_H, tick);
  }
  int buttons() const override { return 4; }
  std::vector<DeviceFact> facts() const override {
    return {{"force_rate", "N/s", rate_, true},       {"force", "N", force_, true},     {"energy", "J", energy_, true},
            {"peak_energy", "J", peak_energy_, true}, {"touches", "1", touches_, true}, {"felt", "1", felt_, true}};
  }

 private:
  static constexpr std::uint64_t kHold = 20;  // [ticks]
  double from_, until_;
  Lost lost_;
  std::mt19937 random_;
  std::uint32_t pressed_ = 0;
  bool started_ = false;
  Vec3 x_ = Vec3::Zero(), sent_ = Vec3::Zero();
  double rate_ = 0, force_ = 0, energy_ = 0, peak_energy_ = 0, touches_ = 0, felt_ = 0;
};

double taken(DeviceBinding& binding, const std::string& key) {
  if (!binding.settings.contains(key)) return 0;
  const double value = std::stod(binding.settings.at(key).value);
  binding.settings.erase(key);
  return value;
}

std::unique_ptr<Device> create(const DeviceBinding& binding, const std::shared_ptr<const World>& world,
                               const RunOptions& options, Diagnostics& diagnostics) {
  DeviceBinding scripted = binding;
  const double from = taken(scripted, "from"), until = taken(scripted, "until");
  const RestlessFinger::Lost lost{taken(scripted, "lost_from"), taken(scripted, "lost_until")};
  const auto seed = static_cast<unsigned>(taken(scripted, "seed"));
  DeviceList made = devicePlugin("scripted").create({scripted}, world, options, diagnostics);
  if (diagnostics.hasErrors()) return nullptr;
  return std::make_unique<RestlessFinger>(std::move(made[0]), from, until, lost, seed);
}

const DevicePlugin kPlugin{.name = "restless", .create = createEach<create>, .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
