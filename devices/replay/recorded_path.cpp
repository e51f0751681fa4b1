#include "devices/replay/recorded_path.h"

#include <algorithm>

namespace presa {

bool RecordedPath::hasPhases() const {
  return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.sample.phase >= 0; });
}

FingerInput PathReader::at(double time) noexcept {
  const std::vector<RecordedPath::Row>& rows = path_.rows;
  const double t = time * speed_;
  while (row_ + 1 < rows.size() && rows[row_ + 1].time <= t + kSameInstant) ++row_;
  FingerInput sample = rows[row_].sample;
  const double since = t - rows[row_].time;
  if (since > kSameInstant && row_ + 1 < rows.size()) {
    const RecordedPath::Row& next = rows[row_ + 1];
    if (sample.valid && next.sample.valid) {
      const double s = since / (next.time - rows[row_].time);
      sample.p_WH += s * (next.sample.p_WH - sample.p_WH);
      sample.v_WH += s * (next.sample.v_WH - sample.v_WH);
    }
  }
  sample.v_WH *= speed_;
  return sample;
}

FingerInput PathReader::last() const noexcept {
  FingerInput sample = path_.rows.back().sample;
  sample.v_WH.setZero();
  return sample;
}

}  // namespace presa
