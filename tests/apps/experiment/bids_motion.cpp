#include <cmath>
#include <regex>
#include <set>

#include "tests/apps/experiment/bids_tables.h"

namespace presa::experiment::bids {
namespace {

/// motion.md "Restricted keyword list for channel component" and "... type".
const std::set<std::string> kComponents{"x", "y", "z", "quat_x", "quat_y", "quat_z", "quat_w", "n/a"};
const std::set<std::string> kTypes{"ACCEL", "ANGACCEL", "GYRO", "JNTANG", "LATENCY",
                                   "MAGN",  "MISC",     "ORNT", "POS",    "VEL"};
const std::set<std::string> kSpatial{"ACCEL", "ANGACCEL", "GYRO", "MAGN", "POS", "VEL"};

class MotionRules {
 public:
  explicit MotionRules(const File& motion) : file_(motion) {}

  std::vector<std::string> check() {
    const std::string base =
        file_.path.string().substr(0, file_.path.string().size() - std::string("motion.tsv").size());
    rows_ = readTsv(file_.path, false);
    channels_ = readTsv(base + "channels.tsv", true);
    json_ = readJson(base + "motion.json");
    // motion.md: each file is accompanied by its motion.json and channels.tsv
    if (channels_.rows.empty()) find("motion.md: no channels.tsv beside it");
    if (!json_.is_object()) find("motion.md: no motion.json beside it");
    if (!found_.empty()) return found_;
    checkRows();
    checkChannels();
    checkSidecar();
    return found_;
  }

 private:
  void find(const std::string& what) { found_.push_back(file_.relative + ": " + what); }

  /// motion.md: no header row; as many columns as channels.tsv has rows.
  void checkRows() {
    for (const auto& row : rows_.rows) {
      if (row.size() != channels_.rows.size()) return find("motion.md: columns are not the rows of channels.tsv");
      for (const std::string& cell : row) {
        if (cell != "n/a" && !isNumber(cell)) return find("motion.md: a header row, or a cell that is no number");
      }
    }
  }

  const std::string& cell(const std::vector<std::string>& row, const char* column) const {
    return row.at(static_cast<std::size_t>(channels_.column(column)));
  }

  void checkChannels() {
    std::set<std::string> names;
    for (std::size_t i = 0; i < channels_.rows.size(); ++i) {
      const auto& row = channels_.rows[i];
      const std::string &type = cell(row, "type"), &component = cell(row, "component"), &units = cell(row, "units");
      if (!names.insert(cell(row, "name")).second) find("channels: a name twice");
      if (!kComponents.contains(component)) find("motion.md: component " + component);
      if (!kTypes.contains(type)) find("motion.md: type " + type);
      const bool axis = component == "x" || component == "y" || component == "z";
      if (kSpatial.contains(type) && !axis) find("motion.md: " + type + " needs an axis");
      if (type == "ORNT" && component == "n/a") find("motion.md: ORNT needs an axis or a part of a quaternion");
      // columns.yaml units__motion: n/a for quaternions; SI otherwise, or named in the sidecar
      if (component.starts_with("quat_") && units != "n/a") find("columns.yaml: a quaternion has the units n/a");
      if (type == "POS" && units != "m") find("Units: positions in m");
      if (type == "LATENCY") checkLatency(i);
      ++counts_[type];
      if (cell(row, "tracked_point") != "n/a") points_.insert(cell(row, "tracked_point"));
    }
  }

  /// motion.md type LATENCY: s[.000000], from the onset of the recording.
  void checkLatency(std::size_t column) {
    static const std::regex kSeconds(R"(\d+(\.\d+)?)");
    double last = -1;
    for (const auto& row : rows_.rows) {
      if (!std::regex_match(row[column], kSeconds)) return find("motion.md: LATENCY is not of the form s[.000000]");
      if (std::stod(row[column]) <= last) return find("LATENCY does not grow");
      last = std::stod(row[column]);
    }
    if (std::stod(rows_.rows.front()[column]) != 0) find("LATENCY does not begin at the onset");
    duration_ = last;
  }

  /// rules/sidecars/motion.yaml, rules/checks/motion.yaml.
  void checkSidecar() {
    if (!json_.contains("TaskName") || !json_["TaskName"].is_string()) find("sidecars: needs TaskName");
    if (!json_.contains("SamplingFrequency") || !json_["SamplingFrequency"].is_number() ||
        json_["SamplingFrequency"] <= 0)
      return find("sidecars: needs SamplingFrequency");
    if (json_.contains("TrackingSystemName") && json_["TrackingSystemName"] != file_.name->value("tracksys"))
      find("motion.yaml TRACKSYS_MISMATCH");
    for (const std::string& type : kTypes) {
      if (json_.value(type + "ChannelCount", 0) != counts_[type]) find("sidecars: " + type + "ChannelCount");
    }
    if (json_.value("TrackedPointsCount", 0) != static_cast<int>(points_.size())) find("sidecars: TrackedPointsCount");
    if (std::abs(json_.value("RecordingDuration", -1.0) - duration_) > 1e-6) find("sidecars: RecordingDuration");
    const double effective = json_.value("SamplingFrequencyEffective", 0.0);
    // from the first sample to the last: virtual time is exact except for the six decimals of a latency
    const double counted = static_cast<double>(rows_.rows.size() - 1) / duration_;
    if (std::abs(effective / counted - 1) > 1e-5) find("sidecars: SamplingFrequencyEffective");
  }

  const File& file_;
  Table rows_, channels_;
  Json json_;
  std::map<std::string, int> counts_;
  std::set<std::string> points_;
  double duration_ = 0;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> motionViolations(const File& motion) { return MotionRules(motion).check(); }

}  // namespace presa::experiment::bids
