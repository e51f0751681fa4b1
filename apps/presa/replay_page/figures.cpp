#include "apps/presa/replay_page/figures.h"

#include <algorithm>

namespace presa::replay_page {

PageFigures figuresOf(const Rig& rig, const RecordedSamples& samples) {
  PageFigures figures;
  for (std::size_t f = 0; f < samples.fingers.size(); ++f) {
    const auto binding = std::ranges::find(rig.devices, samples.fingers[f].name, &DeviceBinding::role);
    if (binding == rig.devices.end() || binding->frame != kWorldFrame) continue;
    if (auto drawn = figureOf(*binding)) figures.push_back({f, std::move(drawn)});
  }
  return figures;
}

std::size_t partCount(const PageFigures& figures) {
  std::size_t count = 0;
  for (const PageFigure& figure : figures) count += figure.drawn->parts().size();
  return count;
}

std::vector<std::vector<Pose>> motionOf(const PageFigure& figure, const RecordedSamples& samples,
                                        const std::vector<std::size_t>& rows) {
  const RecordedTable& finger = samples.fingers[figure.finger];
  const auto tool = std::ranges::find(samples.tools, finger.name, &RecordedTable::name);
  const auto at = [](const RecordedTable& table, const char* column, std::size_t row) {
    return table.values(column)[row];
  };
  std::vector<std::vector<Pose>> motion(figure.drawn->parts().size());
  std::vector<Pose> X_FP;
  FigureMoment moment;
  for (const std::size_t row : rows) {
    const Vec3 p(at(finger, "p_WH_x", row), at(finger, "p_WH_y", row), at(finger, "p_WH_z", row));
    if (at(finger, "valid", row) > 0 || row == rows.front()) {  // without a report it stays where it was
      moment.time = samples.time[row];
      moment.p_FH = p;
      moment.oriented = tool != samples.tools.end();
      if (moment.oriented)
        moment.q_FT =
            Quat(at(*tool, "q_WT_w", row), at(*tool, "q_WT_x", row), at(*tool, "q_WT_y", row), at(*tool, "q_WT_z", row))
                .normalized();
    }
    figure.drawn->place(moment, X_FP);
    for (std::size_t i = 0; i < motion.size(); ++i) motion[i].push_back(X_FP[i]);
  }
  return motion;
}

}  // namespace presa::replay_page
