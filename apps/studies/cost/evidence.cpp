#include "apps/studies/cost/evidence.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/common/atomic_file.h"
#include "framework/input/input.h"

namespace presa::cost {
namespace {

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Reads a stored run, straight into the vectors: it has megabytes.
class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name), file_(opened(name)), left_(file_.size()) {}

  void take(void* to, std::size_t bytes) {
    if (bytes > left_) throw std::runtime_error("a stored run is cut short: " + name_);
    left_ -= bytes;
    for (char* at = static_cast<char*>(to); bytes > 0;) {
      const std::ptrdiff_t n = input::readSome(file_, at, bytes);
      if (n <= 0) throw std::runtime_error("a stored run cannot be read: " + name_);
      at += n;
      bytes -= static_cast<std::size_t>(n);
    }
  }
  template <class T>
  void take(std::vector<T>& values, std::size_t count) {
    if (count > left_ / sizeof(T)) throw std::runtime_error("a stored run is cut short: " + name_);
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }

 private:
  static input::File opened(const std::string& name) {
    constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30U;
    input::Refusal refusal;
    auto file = input::open(name, kMaxBytes, refusal);
    if (!file) throw std::runtime_error("a stored run cannot be read: " + name);
    return std::move(*file);
  }

  std::string name_;
  input::File file_;
  std::uint64_t left_;
};

void put(nlohmann::json& json, const char* key, const std::optional<double>& value) {
  if (value) json[key] = *value;
}
std::optional<double> optionalNumber(const nlohmann::json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? std::optional<double>(json[key].get<double>()) : std::nullopt;
}

}  // namespace

void Trace::save(const std::string& file) const {
  std::string bytes = kFormat;
  append(bytes, std::vector<std::uint64_t>{fingers, bodies, time_ns.size(), held_from_ns.size()});
  append(bytes, time_ns);
  append(bytes, stepped);
  append(bytes, finger);
  append(bytes, body);
  append(bytes, held_from_ns);
  append(bytes, held);
  writeFileAtomically(file, bytes);
}

Trace Trace::load(const std::string& file) {
  Reader reader(file);
  std::string mark(std::strlen(kFormat), ' ');
  reader.take(mark.data(), mark.size());
  if (mark != kFormat) throw std::runtime_error("no stored run: " + file);
  std::vector<std::uint64_t> counts;
  reader.take(counts, 4);
  Trace trace;
  trace.fingers = counts[0];
  trace.bodies = counts[1];
  reader.take(trace.time_ns, counts[2]);
  reader.take(trace.stepped, counts[2]);
  reader.take(trace.finger, counts[0] * counts[2]);
  reader.take(trace.body, counts[1] * counts[2]);
  reader.take(trace.held_from_ns, counts[3]);
  reader.take(trace.held, counts[0] * counts[3]);
  return trace;
}

nlohmann::json toJson(const Evidence& e) {
  nlohmann::json json{{"failure", e.failure},
                      {"compared_s", {e.compared_from, e.compared_to}},
                      {"steady_s", {e.steady_from, e.steady_to}},
                      {"hash", e.hash}};
  put(json, "slip_force_N", e.slip_force);
  put(json, "slip_time_s", e.slip_time);
  put(json, "energy_created_J", e.energy_created);
  put(json, "energy_drift_J", e.energy_drift);
  put(json, "force_step_N", e.force_step);
  put(json, "hum_N", e.hum);
  json["vibration_N"] = e.vibration;
  put(json, "penetration_m", e.penetration);
  put(json, "penetration_max_m", e.penetration_max);
  put(json, "rest_energy_J", e.rest_energy);
  put(json, "rest_drift_m", e.rest_drift);
  put(json, "joint_gap_m", e.joint_gap);
  put(json, "joint_tilt_rad", e.joint_tilt);
  json["seconds"] = e.seconds;
  return json;
}

Evidence evidenceFrom(const nlohmann::json& json) {
  Evidence e;
  e.failure = json.at("failure");
  e.compared_from = json.at("compared_s").at(0);
  e.compared_to = json.at("compared_s").at(1);
  e.steady_from = json.at("steady_s").at(0);
  e.steady_to = json.at("steady_s").at(1);
  e.hash = json.at("hash");
  e.slip_force = optionalNumber(json, "slip_force_N");
  e.slip_time = optionalNumber(json, "slip_time_s");
  e.energy_created = optionalNumber(json, "energy_created_J");
  e.energy_drift = optionalNumber(json, "energy_drift_J");
  e.force_step = optionalNumber(json, "force_step_N");
  e.hum = optionalNumber(json, "hum_N");
  e.vibration = json.at("vibration_N").get<std::vector<double>>();
  e.penetration = optionalNumber(json, "penetration_m");
  e.penetration_max = optionalNumber(json, "penetration_max_m");
  e.rest_energy = optionalNumber(json, "rest_energy_J");
  e.rest_drift = optionalNumber(json, "rest_drift_m");
  e.joint_gap = optionalNumber(json, "joint_gap_m");
  e.joint_tilt = optionalNumber(json, "joint_tilt_rad");
  e.seconds = json.at("seconds");
  return e;
}

nlohmann::json toJson(const Timing& timing) {
  nlohmann::json groups = nlohmann::json::array();
  for (const Timing::Group& group : timing.groups) {
    groups.push_back({{"name", group.name},
                      {"period_s", group.period},
                      {"ticks", group.ticks},
                      {"mean_s", group.mean},
                      {"median_s", group.median},
                      {"p999_s", group.p999}});
  }
  return {{"cpu_per_simulated_s", timing.per_second},
          {"engines", timing.engines},
          {"groups", groups},
          {"load_s", timing.load},
          {"memory_B", timing.memory},
          {"instructions_per_simulated_s", timing.instructions},
          {"hardware", timing.hardware}};
}

Timing timingFrom(const nlohmann::json& json) {
  Timing timing;
  timing.per_second = json.at("cpu_per_simulated_s");
  timing.engines = json.at("engines").get<std::vector<std::string>>();
  timing.load = json.at("load_s");
  timing.memory = json.at("memory_B");
  timing.instructions = json.at("instructions_per_simulated_s");
  for (const auto& g : json.at("groups")) {
    timing.groups.push_back(
        {g.at("name"), g.at("period_s"), g.at("ticks"), g.at("mean_s"), g.at("median_s"), g.at("p999_s")});
  }
  timing.hardware = json.value("hardware", "");
  return timing;
}

double Timing::busiestTick() const {
  double busiest = 0;
  for (const Group& group : groups) busiest = std::max(busiest, group.p999 / group.period);
  return busiest;
}

}  // namespace presa::cost
