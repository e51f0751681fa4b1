#pragma once
#include <string>
#include <vector>

#include "framework/record/recording.h"

namespace presa::experiment {

/// One column of a time series, as Motion-BIDS describes it.
struct Channel {
  std::string name;           ///< such as "thumb_pos_x"
  std::string component;      ///< x y z quat_w …, or n/a
  std::string type;           ///< LATENCY POS ORNT MISC
  std::string tracked_point;  ///< role of a finger, name of a body, or n/a
  std::string units;          ///< SI; n/a: dimensionless
  std::string description;
};

/// A recording as channels: time; per finger the position of the HIP, the commanded force, the normal and tangential
/// contact force, depth and contact mode; per free body its position and orientation. SI units, world frame.
class Motion {
 public:
  explicit Motion(const RecordedSamples& samples);

  const std::vector<Channel>& channels() const noexcept { return channels_; }
  std::size_t count(const std::string& type) const;
  std::size_t trackedPoints() const noexcept { return tracked_points_; }
  /// Ticks of a time series at `rate` [Hz]: the newest tick at each of its times. Decimation only, without a filter.
  std::vector<std::size_t> ticksAt(double rate) const;
  /// Text rows of `ticks` (empty: all), cells divided by `separator`. Single precision; n/a where a device gave no
  /// sample.
  std::string rows(char separator, const std::vector<std::size_t>& ticks = {}) const;
  double nominalRate() const noexcept { return 1 / samples_.haptic_period; }
  double duration() const { return samples_.time.back() - samples_.time.front(); }
  /// Time of the first row [s], in the time of the trial.
  double begin() const { return samples_.time.front(); }
  std::size_t ticks() const noexcept { return samples_.time.size(); }

 private:
  void add(Channel channel, std::vector<double> values);
  void addFinger(const RecordedTable& finger);
  void addBody(const RecordedTable& body);

  const RecordedSamples& samples_;
  std::vector<Channel> channels_;
  std::vector<std::vector<double>> values_;  // in the order of channels_
  std::size_t tracked_points_ = 0;
};

}  // namespace presa::experiment
