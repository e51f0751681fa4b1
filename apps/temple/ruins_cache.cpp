#include "apps/temple/ruins_cache.h"

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/common/atomic_file.h"
#include "apps/common/version.h"
#include "apps/temple/building/scene_text.h"
#include "apps/temple/building/shipped.h"
#include "apps/temple/kept_session.h"
#include "framework/core/math/fnv.h"
#include "framework/input/cache.h"

namespace presa::temple {

std::optional<std::vector<Pose>> shippedRuins(const std::string& size, std::uint64_t seed) {
  const char* text = size == "column" ? shipped::ruins_column : size == "facade" ? shipped::ruins_facade : nullptr;
  if (text == nullptr) return std::nullopt;
  KeptSession kept = keptOf(text);
  if (kept.seed != seed) return std::nullopt;
  return std::move(kept.X_WB);
}

std::string ruinsCacheFile(const Building& building, std::uint64_t seed) {
  const std::string folder = input::cacheFolder("ruins");
  const std::string_view commit = kCommit;
  if (folder.empty() || commit.empty() || commit.ends_with("-dirty")) return {};
  Fnv1a hash;
  hash.add(versionText());
  hash.addWord(seed);
  SceneSpec spec = assembled(building);
  spec.physics_only = true;  // ruins do not depend on what is drawn
  hash.add(sceneText(building, spec));
  for (const SceneFile& file : meshFiles(building, true)) hash.add(file.text);
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.json", static_cast<unsigned long long>(hash.value()));
  return (std::filesystem::path(folder) / name).string();
}

std::optional<std::vector<Pose>> readRuins(const std::string& file, const Building& building) {
  if (file.empty() || !std::filesystem::exists(file)) return std::nullopt;
  Diagnostics unused;
  const std::optional<KeptSession> kept = readKept(file, unused);
  if (!kept || kept->X_WB.size() != building.blocks.size()) return std::nullopt;
  return kept->X_WB;
}

std::string ruinsText(const Building& building, std::uint64_t seed, const std::vector<Pose>& X_WB) {
  KeptSession kept;
  kept.size = building.name;
  kept.seed = seed;
  kept.X_WB = X_WB;
  return keptText(kept);
}

void keepRuins(const std::string& file, const Building& building, std::uint64_t seed, const std::vector<Pose>& X_WB) {
  if (file.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), failure);
  try {
    writeFileAtomically(file, ruinsText(building, seed, X_WB));
  } catch (const std::system_error&) {
    // the next start strews them again
  }
}

}  // namespace presa::temple
