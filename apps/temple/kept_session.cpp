#include "apps/temple/kept_session.h"

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/input/input.h"

namespace presa::temple {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 24U;  // a facade takes 10 kB

Json poseJson(const Pose& X) { return {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()}; }

Pose poseOf(const Json& json) {
  const auto v = json.get<std::vector<double>>();
  if (v.size() != 7) throw std::runtime_error("a pose has seven numbers, found " + std::to_string(v.size()));
  Pose X{{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
  if (!X.p.allFinite() || !(std::abs(X.q.norm() - 1) < 1e-3)) throw std::runtime_error("a pose that is none");
  return X;
}

}  // namespace

std::string defaultVisitFolder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path base = state != nullptr && *state != '\0' ? std::filesystem::path(state)
                                     : home != nullptr                  ? std::filesystem::path(home) / ".local/state"
                                                                        : std::filesystem::temp_directory_path();
  return (base / "presa" / "temple").string();
}

std::string sessionFile(const std::string& folder) { return (std::filesystem::path(folder) / "session.json").string(); }
std::string logFile(const std::string& folder) { return (std::filesystem::path(folder) / "log.jsonl").string(); }

std::string keptText(const KeptSession& kept) {
  Json blocks = Json::array();
  for (const Pose& X : kept.X_WB) blocks.push_back(poseJson(X));
  Json json{{"presa_temple", kFormat}, {"size", kept.size},       {"parameters", kept.parameters},
            {"seed", kept.seed},       {"spent_s", kept.elapsed}, {"placed", kept.placed},
            {"blocks", blocks}};
  if (kept.tenon) json["tenon"] = true;
  return json.dump(1) + "\n";
}

KeptSession keptOf(const std::string& text) {
  const Json json = Json::parse(text);
  if (json.at("presa_temple").get<int>() != kFormat)
    throw std::runtime_error("is written in another format than " + std::to_string(kFormat));
  KeptSession kept{json.at("size"), json.at("parameters"), json.at("seed"), json.at("spent_s"), json.at("placed"), {}};
  kept.tenon = json.value("tenon", false);
  for (const Json& block : json.at("blocks")) kept.X_WB.push_back(poseOf(block));
  return kept;
}

std::optional<KeptSession> readKept(const std::string& file, Diagnostics& diagnostics) {
  try {
    input::Refusal refusal;
    const auto text = input::read(file, kMaxBytes, refusal);
    if (!text) throw std::runtime_error(refusal.what);
    return keptOf(*text);
  } catch (const std::exception& error) {
    diagnostics.error(967, {file, 0, 0}, std::string("no session to continue: ") + error.what(),
                      "the session.json of a visit, or start anew without --continue");
    return std::nullopt;
  }
}

}  // namespace presa::temple
