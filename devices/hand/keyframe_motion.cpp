#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "devices/hand/motion.h"
#include "framework/input/input.h"

namespace presa {
namespace {

struct Keyframe {
  double time = 0;
  Vec3 position = Vec3::Zero();
  Vec3 force = Vec3::Zero();
  Quat q_WT = Quat::Identity();
  std::string phase;
  PhaseIntent intent = PhaseIntent::kNone;
};

class KeyframeMotion final : public Motion {
 public:
  KeyframeMotion(std::vector<Keyframe> frames, bool turns) : frames_(std::move(frames)) {
    oriented = turns;
    for (const Keyframe& frame : frames_) {
      if (frame.phase.empty() || (!phase_names.empty() && phase_names.back() == frame.phase)) continue;
      phase_names.push_back(frame.phase);
      phase_intents.push_back(frame.intent);
      phase_times.push_back(frame.time);
    }
    if (!phase_names.empty()) phase_times.push_back(frames_.back().time);
  }

  MotionTarget at(double time) const noexcept override {
    MotionTarget target;
    const auto after = std::upper_bound(frames_.begin(), frames_.end(), time,
                                        [](double t, const Keyframe& frame) { return t < frame.time; });
    if (!phase_names.empty()) target.phase = phaseAt(time);
    if (after == frames_.begin() || after == frames_.end()) {
      const Keyframe& end = after == frames_.end() ? frames_.back() : frames_.front();
      target.p_WT = end.position;
      target.force_W = end.force;
      target.q_WT = end.q_WT;
      return target;
    }
    const Keyframe &from = *(after - 1), &to = *after;
    const double duration = to.time - from.time;
    const double s = (time - from.time) / duration;
    target.p_WT = from.position + minimumJerk(s) * (to.position - from.position);
    target.v_WT = minimumJerkSlope(s) / duration * (to.position - from.position);
    target.force_W = from.force + s * (to.force - from.force);
    if (oriented) turn(from, to, s, duration, target);
    return target;
  }

 private:
  /// About one axis, the shorter way.
  static void turn(const Keyframe& from, const Keyframe& to, double s, double duration, MotionTarget& target) noexcept {
    Quat way = to.q_WT * from.q_WT.conjugate();
    if (way.w() < 0) way.coeffs() = -way.coeffs();
    const Eigen::AngleAxisd whole(way);
    target.q_WT = Quat(Eigen::AngleAxisd(minimumJerk(s) * whole.angle(), whole.axis())) * from.q_WT;
    target.w_WT = minimumJerkSlope(s) / duration * whole.angle() * whole.axis();
  }

  std::vector<Keyframe> frames_;
};

struct Cell {
  std::string text;
  int column = 1;  ///< of its first character
};

std::vector<Cell> split(const std::string& line) {
  std::vector<Cell> cells;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin, last = end;
    while (first < last && std::isspace(static_cast<unsigned char>(line[first])) != 0) ++first;
    while (last > first && std::isspace(static_cast<unsigned char>(line[last - 1])) != 0) --last;
    cells.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

/// Enough for three hours of keyframes at 100 Hz.
constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20U;

class KeyframeReader {
 public:
  KeyframeReader(std::string file, const MotionContext& context, Diagnostics& diagnostics)
      : file_(std::move(file)), context_(context), diagnostics_(diagnostics) {}

  std::vector<Keyframe> read() {
    input::Refusal refusal;
    auto text = input::read(file_, kMaxBytes, refusal);
    if (!text) {
      if (refusal.trouble == input::Trouble::kUnreadable)
        diagnostics_.error(420, {file_, 0, 0}, "cannot open the motion file",
                           "check the path; it is relative to the rig file");
      else
        refusal.report(420, {file_, 0, 0}, "the motion file ", diagnostics_);
      return {};
    }
    std::istringstream input(std::move(*text));
    std::vector<Keyframe> frames;
    std::string line;
    while (std::getline(input, line)) {
      ++line_;
      if (line.empty() || line[0] == '#' || line == "\r") continue;
      if (columns_.empty()) {
        readHeader(split(line));
        if (columns_.empty()) return {};
      } else {
        readRow(split(line), frames);
      }
    }
    if (frames.empty()) {
      diagnostics_.error(424, {file_, line_, 1}, "no keyframe for role '" + context_.role + "'",
                         "add rows whose role column says '" + context_.role + "'");
    }
    return frames;
  }

  /// The file has orientations.
  bool turns() const noexcept { return turns_; }

 private:
  void readHeader(const std::vector<Cell>& cells) {
    static const std::vector<std::string> kKnown{"time_s", "role",  "x_m", "y_m", "z_m", "fx_N", "fy_N",
                                                 "fz_N",   "phase", "qw",  "qx",  "qy",  "qz",   "intent"};
    std::map<std::string, std::size_t> columns;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (std::find(kKnown.begin(), kKnown.end(), cells[i].text) == kKnown.end()) {
        diagnostics_.error(
            421, {file_, line_, cells[i].column},
            "unknown column '" + cells[i].text + "'" + didYouMean(cells[i].text, kKnown),
            "columns: time_s, role, x_m, y_m, z_m, and optionally fx_N, fy_N, fz_N, phase, intent, qw, qx, qy, qz");
      }
      columns[cells[i].text] = i;
    }
    for (std::size_t k = 0; k < 5; ++k) {
      if (!columns.contains(kKnown[k])) {
        diagnostics_.error(422, {file_, line_, 1}, "column '" + kKnown[k] + "' is missing");
        return;
      }
    }
    if (columns.contains("qw") || columns.contains("qx") || columns.contains("qy") || columns.contains("qz")) {
      for (const char* name : {"qw", "qx", "qy", "qz"}) {
        if (columns.contains(name)) continue;
        diagnostics_.error(422, {file_, line_, 1}, std::string("column '") + name + "' is missing",
                           "an orientation needs qw, qx, qy and qz");
        return;
      }
      turns_ = true;
    }
    if (columns.contains("intent") && !columns.contains("phase")) {
      diagnostics_.error(422, {file_, line_, 1}, "column 'phase' is missing", "an intent is that of a phase");
      return;
    }
    columns_ = std::move(columns);
  }

  void readRow(const std::vector<Cell>& cells, std::vector<Keyframe>& frames) {
    if (cells.size() != columns_.size()) {
      diagnostics_.error(
          423, {file_, line_, 1},
          "found " + std::to_string(cells.size()) + " values, expected " + std::to_string(columns_.size()));
      return;
    }
    if (cells[columns_.at("role")].text != context_.role) return;
    Keyframe frame;
    frame.time = number(cells, "time_s");
    frame.position = {number(cells, "x_m"), number(cells, "y_m"), number(cells, "z_m")};
    frame.force = {number(cells, "fx_N"), number(cells, "fy_N"), number(cells, "fz_N")};
    if (turns_) frame.q_WT = orientation(cells);
    if (columns_.contains("phase")) frame.phase = cells[columns_.at("phase")].text;
    if (columns_.contains("intent")) frame.intent = intent(cells[columns_.at("intent")]);
    if (!frames.empty() && !(frame.time > frames.back().time)) {
      diagnostics_.error(425, {file_, line_, cells[columns_.at("time_s")].column},
                         "time must increase from row to row: found " + cells[columns_.at("time_s")].text + " after " +
                             std::to_string(frames.back().time));
      return;
    }
    frames.push_back(std::move(frame));
  }

  PhaseIntent intent(const Cell& cell) {
    if (cell.text.empty()) return PhaseIntent::kNone;
    if (const auto found = phaseIntentOf(cell.text)) return *found;
    diagnostics_.error(429, {file_, line_, cell.column}, "'" + cell.text + "' is not an intent",
                       "the intent of a phase is lift, hold, release, or none");
    return PhaseIntent::kNone;
  }

  Quat orientation(const std::vector<Cell>& cells) {
    const Quat q(number(cells, "qw"), number(cells, "qx"), number(cells, "qy"), number(cells, "qz"));
    const double norm = q.norm();
    if (std::abs(norm - 1) <= 0.01) return q.normalized();
    diagnostics_.error(427, {file_, line_, cells[columns_.at("qw")].column},
                       "qw, qx, qy, qz must be a unit quaternion; its length is " + std::to_string(norm),
                       "e.g. 1,0,0,0, or 0.7071,0.7071,0,0 for a quarter turn about x");
    return Quat::Identity();
  }

  double number(const std::vector<Cell>& cells, const std::string& column) {
    const auto found = columns_.find(column);
    if (found == columns_.end()) return 0;
    const Cell& cell = cells[found->second];
    double value = 0;
    const char* end = cell.text.data() + cell.text.size();
    const auto [rest, status] = std::from_chars(cell.text.data(), end, value);
    if (status != std::errc{} || rest != end || !std::isfinite(value)) {
      diagnostics_.error(426, {file_, line_, cell.column},
                         column + " must be a finite number, found '" + cell.text + "'");
      return 0;
    }
    return value;
  }

  std::string file_;
  const MotionContext& context_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::size_t> columns_;
  int line_ = 0;
  bool turns_ = false;
};

}  // namespace

std::unique_ptr<Motion> readKeyframeMotion(const std::string& file, const MotionContext& context,
                                           Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  KeyframeReader reader(file, context, diagnostics);
  std::vector<Keyframe> frames = reader.read();
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<KeyframeMotion>(std::move(frames), reader.turns());
}

}  // namespace presa
