#include "apps/presa/replay_page/keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/presa/replay_page/packed.h"
#include "apps/presa/replay_page/shapes.h"

namespace presa::replay_page {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = 1'100'000;               // base64 adds a third
constexpr double kMoves = 1e-5, kTurns = 1e-5;             // [m], of a quaternion: less is not seen
constexpr std::size_t kBodyBytes = 14, kFingerBytes = 42;  // of a keyframe

struct MovingBody {
  std::size_t index;  ///< in the scene
  const RecordedTable* table;
};

bool varies(const RecordedTable& table, const char* column, double more_than) {
  const auto [low, high] = std::ranges::minmax_element(table.values(column));
  return *high - *low > more_than;
}

bool moves(const RecordedTable& table) {
  for (const char* column : {"p_WB_x", "p_WB_y", "p_WB_z"})
    if (varies(table, column, kMoves)) return true;
  for (const char* column : {"q_WB_w", "q_WB_x", "q_WB_y", "q_WB_z"})
    if (varies(table, column, kTurns)) return true;
  return false;
}

/// The free bodies of the recording that the page draws, with their place in the scene.
std::vector<MovingBody> freeBodies(const RecordedSamples& samples, const World& world) {
  std::map<std::string, std::size_t> places;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) places.try_emplace(world.scene.bodies[b].name, b);
  std::vector<MovingBody> free;
  for (const RecordedTable& table : samples.bodies) {
    const auto place = places.find(table.name);
    if (place != places.end() && place->second < kMaxBodies) free.push_back({place->second, &table});
  }
  return free;
}

struct Raster {
  std::size_t count;
  double period;  ///< [s], a multiple of the haptic one: a keyframe is a tick, nothing is guessed between ticks
};

Raster rasterOf(const RecordedSamples& samples, std::size_t most) {
  const double ticks = std::max(1.0, std::round((samples.time.back() - samples.time.front()) / samples.haptic_period));
  const double usual = std::max(1.0, std::round(1 / (kMaxKeyframeRate * samples.haptic_period)));
  const double stride = std::max(usual, std::ceil(ticks / static_cast<double>(most - 1)));
  return {static_cast<std::size_t>(std::ceil(ticks / stride)) + 1, stride * samples.haptic_period};
}

/// The tick at or before each keyframe.
std::vector<std::size_t> rowsOf(const std::vector<double>& time, const Raster& raster) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < raster.count; ++k) {
    const double wanted = time.front() + static_cast<double>(k) * raster.period + 1e-9;
    const auto later = std::ranges::upper_bound(time, wanted);
    rows.push_back(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, later - time.begin() - 1)));
  }
  return rows;
}

json channel(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> picked;
  picked.reserve(rows.size());
  for (const std::size_t row : rows) picked.push_back(values[row]);
  return packed(picked);
}

json vectorOf(const RecordedTable& table, const std::string& name, const std::vector<std::size_t>& rows) {
  json axes = json::array();
  for (const char* axis : {"_x", "_y", "_z"}) axes.push_back(channel(table.values(name + axis), rows));
  return axes;
}

Quat orientationAt(const RecordedTable& table, std::size_t row, const std::string& name = "q_WB") {
  const auto q = [&](const char* part) { return table.values(name + part)[row]; };
  return Quat(q("_w"), q("_x"), q("_y"), q("_z")).normalized();
}

/// Signs are chosen so that neighbours can be interpolated: q and -q are the same orientation.
json orientationsOf(const RecordedTable& table, const std::vector<std::size_t>& rows,
                    const std::string& name = "q_WB") {
  std::array<std::vector<double>, 4> parts;
  Quat before = Quat::Identity();
  for (const std::size_t row : rows) {
    Quat q = orientationAt(table, row, name);
    if (q.dot(before) < 0) q.coeffs() = -q.coeffs();
    before = q;
    parts[0].push_back(q.w()), parts[1].push_back(q.x()), parts[2].push_back(q.y()), parts[3].push_back(q.z());
  }
  json channels = json::array();
  for (const std::vector<double>& part : parts) channels.push_back(packed(part));
  return channels;
}

json partsOf(const PageFigures& figures, const RecordedSamples& samples, const std::vector<std::size_t>& rows) {
  json parts = json::array();
  for (const PageFigure& figure : figures) {
    for (const std::vector<Pose>& motion : motionOf(figure, samples, rows)) {
      std::array<std::vector<double>, 7> channels;
      Quat before = Quat::Identity();
      for (const Pose& X : motion) {
        const double sign = X.q.dot(before) < 0 ? -1 : 1;
        before = Quat(sign * X.q.w(), sign * X.q.x(), sign * X.q.y(), sign * X.q.z());
        const std::array<double, 7> row{X.p.x(), X.p.y(), X.p.z(), before.w(), before.x(), before.y(), before.z()};
        for (std::size_t i = 0; i < row.size(); ++i) channels[i].push_back(row[i]);
      }
      json p = json::array(), q = json::array();
      for (std::size_t i = 0; i < channels.size(); ++i) (i < 3 ? p : q).push_back(packed(channels[i]));
      parts.push_back({{"p", p}, {"q", q}});
    }
  }
  return parts;
}

/// The touched points in W; where nothing is touched, the proxy.
json contactsOf(const RecordedTable& finger, const std::vector<std::size_t>& rows, const World& world,
                const std::map<std::size_t, const RecordedTable*>& tables) {
  const auto vector = [&](const RecordedTable& table, const std::string& name, std::size_t row) {
    return Vec3(table.values(name + "_x")[row], table.values(name + "_y")[row], table.values(name + "_z")[row]);
  };
  std::array<std::vector<double>, 3> axes;
  for (const std::size_t row : rows) {
    Vec3 point = vector(finger, "p_WP", row);
    const double body = finger.values("body")[row];
    if (finger.values("mode")[row] > 0 && body >= 0 && body < static_cast<double>(world.scene.bodies.size())) {
      const auto index = static_cast<std::size_t>(body);
      Pose X_WB = world.scene.bodies[index].X_WB;
      if (const auto table = tables.find(index); table != tables.end())
        X_WB = {vector(*table->second, "p_WB", row), orientationAt(*table->second, row)};
      point = X_WB * vector(finger, "p_BC", row);
    }
    for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)].push_back(point[i]);
  }
  return {packed(axes[0]), packed(axes[1]), packed(axes[2])};
}

}  // namespace

json keyframesOf(const RecordedSamples& samples, const World& world, const PageFigures& figures) {
  std::map<std::size_t, const RecordedTable*> tables;
  std::vector<MovingBody> moving;
  for (const MovingBody& body : freeBodies(samples, world)) {
    tables.emplace(body.index, body.table);
    if (moves(*body.table)) moving.push_back(body);
  }
  const std::size_t bytes =
      (moving.size() + partCount(figures)) * kBodyBytes + samples.fingers.size() * kFingerBytes + 1;
  const Raster raster = rasterOf(samples, std::min(kMaxKeyframes, kMaxBytes / bytes + 2));
  const std::vector<std::size_t> rows = rowsOf(samples.time, raster);

  json bodies = json::array(), fingers = json::array();
  for (const MovingBody& body : moving)
    bodies.push_back(
        {{"body", body.index}, {"p", vectorOf(*body.table, "p_WB", rows)}, {"q", orientationsOf(*body.table, rows)}});
  for (std::size_t f = 0; f < samples.fingers.size(); ++f) {
    const RecordedTable& finger = samples.fingers[f];
    const bool known = f < world.scene.devices.size();
    fingers.push_back({{"role", finger.name},
                       {"radius", known ? world.scene.devices[f].fingertip_radius : 0.0},
                       {"hip", vectorOf(finger, "p_WH", rows)},
                       {"proxy", vectorOf(finger, "p_WP", rows)},
                       {"contact", contactsOf(finger, rows, world, tables)},
                       {"normal", vectorOf(finger, "nhat_W", rows)},
                       {"force", vectorOf(finger, "f_rendered_W", rows)},
                       {"valid", channel(finger.values("valid"), rows)},
                       {"mode", channel(finger.values("mode"), rows)},
                       {"body", channel(finger.values("body"), rows)}});
    for (const RecordedTable& tool : samples.tools) {
      if (tool.name == finger.name) fingers.back()["tool"] = orientationsOf(tool, rows, "q_WT");
    }
  }
  for (const PageFigure& figure : figures) fingers[figure.finger]["device"] = true;
  return {{"count", raster.count},
          {"period", raster.period},
          {"moving", bodies},
          {"fingers", fingers},
          {"parts", partsOf(figures, samples, rows)}};
}

}  // namespace presa::replay_page
