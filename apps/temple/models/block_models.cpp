#include "apps/temple/models/block_models.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>

#include "apps/temple/building/words.h"
#include "apps/temple/models/felt_cache.h"
#include "framework/input/folders.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;

enum BlockModelCode { kNoModel = 270, kOtherProportions = 271 };

constexpr double kMaxStretch = 1.5;
constexpr double kFeltError = 0.00015;  // [m]

/// The model of a kind: its mesh in the file's unit, and what is felt of it.
struct KindModel {
  std::string file;
  AxisBox box;
  TriMesh felt;         ///< in the file's unit
  double distance = 0;  ///< of `felt` from the model, in the unit of the file
  std::size_t triangles = 0;
  double largest_scale = 0;
};

std::string fileOf(const std::string& folder, BlockKind kind) {
  std::error_code ignored;
  for (const char* ending : {".glb", ".gltf", ".obj", ".ply"}) {
    const fs::path file = fs::path(folder) / (elementName(kind) + std::string(ending));
    if (fs::is_regular_file(file, ignored)) return fs::absolute(file).lexically_normal().string();
  }
  return {};
}

Vec3 factors(const AxisBox& from, const AxisBox& to) { return (to.high - to.low).cwiseQuotient(from.high - from.low); }

/// The model's unit is unknown: only proportions can be compared.
std::string relative(const AxisBox& box) {
  const Vec3 size = box.high - box.low;
  std::array<char, 64> line{};
  std::snprintf(line.data(), line.size(), "%.3g x %.3g x 1", size.x() / size.z(), size.y() / size.z());
  return line.data();
}

/// Errors: E271, and those of the mesh.
bool fits(const KindModel& model, const Block& block, Diagnostics& diagnostics) {
  const AxisBox box = boundsOf(block.visual);
  const Vec3 scale = factors(model.box, box);
  if (scale.allFinite() && scale.maxCoeff() <= kMaxStretch * scale.minCoeff()) return true;
  diagnostics.error(kOtherProportions, {model.file, 0, 0},
                    "the model is " + relative(model.box) + " (x by y by z, in heights), block '" + block.name + "' " +
                        relative(box) + ": it would be stretched beyond a factor of 1.5",
                    "turn or crop the model; z is up (glTF: y), x along the front");
  return false;
}

bool read(KindModel& model, const Block& block, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const TriMesh mesh = importMesh(model.file, {}, {model.file, 0, 0}, diagnostics);
  if (diagnostics.errorCount() > before) return false;
  model.box = boundsOf(mesh);
  model.triangles = mesh.triangles.size();
  if (!fits(model, block, diagnostics)) return false;
  const double unit = factors(model.box, boundsOf(block.visual)).maxCoeff();
  const FeltMesh felt = feltMesh(mesh, kFeltError / unit);
  model.felt = felt.mesh, model.distance = felt.distance;
  return !model.felt.triangles.empty();
}

void use(KindModel& model, Block& block) {
  const AxisBox box = boundsOf(block.visual);
  const Vec3 scale = factors(model.box, box);
  block.model = BlockModel{model.file, scale, box.low - scale.cwiseProduct(model.box.low)};
  block.haptic = model.felt;
  for (Vec3& v : block.haptic.vertices) v = scale.cwiseProduct(v) + block.model->p_BM;
  model.largest_scale = std::max(model.largest_scale, scale.maxCoeff());
}

std::string told(BlockKind kind, const KindModel& model) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), "%s: %s, %zu triangles, %zu of them felt, within %.3f mm", elementName(kind),
                fs::path(model.file).filename().c_str(), model.triangles, model.felt.triangles.size(),
                1e3 * model.largest_scale * model.distance);
  return line.data();
}

}  // namespace

std::vector<std::string> useModels(Building& building, const std::string& folder, Diagnostics& diagnostics) {
  input::allowFolder(folder);
  std::map<BlockKind, KindModel> models;
  std::vector<std::string> lines;
  for (Block& block : building.blocks) {
    const auto [found, is_new] = models.try_emplace(block.kind);
    KindModel& model = found->second;
    if (is_new) {
      model.file = fileOf(folder, block.kind);
      if (!model.file.empty() && !read(model, block, diagnostics)) model.felt = {};
    }
    if (model.felt.triangles.empty() || !fits(model, block, diagnostics)) continue;
    use(model, block);
  }
  bool any = false;
  for (const auto& [kind, model] : models) {
    any = any || !model.file.empty();
    if (!model.felt.triangles.empty()) lines.push_back(told(kind, model));
  }
  if (!any)
    diagnostics.error(kNoModel, {folder, 0, 0}, "holds no model of any block of this building",
                      "name files after kinds of blocks: drum.glb, capital.obj, … (.glb, .gltf, .obj or .ply)");
  return lines;
}

}  // namespace presa::temple
