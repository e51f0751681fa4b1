#include <algorithm>

#include "devices/replay/settings.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A finger that repeats a recorded motion.
class ReplayedFinger final : public Device {
 public:
  explicit ReplayedFinger(ReplaySettings settings)
      : settings_(std::move(settings)), reader_(*settings_.path, settings_.speed) {
    namePhases();
  }

  void open() override { reader_.rewind(); }

  FingerInput read(const Tick& tick) noexcept override {
    if (!reader_.ended(tick.time)) return reader_.at(tick.time);
    FingerInput sample = reader_.last();
    sample.lost = sample.lost || settings_.lost_at_end;
    sample.valid = sample.valid && !sample.lost;
    return sample;
  }

  void write(const Wrench&, const Tick&) noexcept override {}

  std::vector<std::string> phases() const override { return phases_; }
  std::vector<double> phaseTimes() const override { return phase_times_; }
  std::string model() const override { return "replayed fingers: a recording, which does not yield"; }
  std::vector<std::string> notes() const override { return settings_.notes; }

 private:
  /// Start time of each phase: its first row, or that of the next phase if it never occurs. Without phases, one phase
  /// covers the whole.
  void namePhases() {
    const std::vector<RecordedPath::Row>& rows = settings_.path->rows;
    const double end = settings_.path->end() / settings_.speed;
    std::int32_t last = 0;
    for (const RecordedPath::Row& row : rows) last = std::max(last, row.sample.phase);
    phase_times_.assign(static_cast<std::size_t>(last) + 1, end);
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
      if (row->sample.phase >= 0)
        phase_times_[static_cast<std::size_t>(row->sample.phase)] = row->time / settings_.speed;
    }
    for (std::size_t p = phase_times_.size() - 1; p-- > 0;)
      phase_times_[p] = std::min(phase_times_[p], phase_times_[p + 1]);
    phase_times_.front() = 0;
    phase_times_.push_back(end);
    for (std::int32_t p = 0; p <= last; ++p)
      phases_.push_back(settings_.path->hasPhases() ? "phase " + std::to_string(p) : "recorded");
  }

  ReplaySettings settings_;
  PathReader reader_;
  std::vector<std::string> phases_;
  std::vector<double> phase_times_;
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  ReplaySettings settings = readReplaySettings(binding, world, diagnostics);
  if (!settings.path) return nullptr;
  return std::make_unique<ReplayedFinger>(std::move(settings));
}

const DevicePlugin kPlugin{.name = "replay", .create = createEach<create>, .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
