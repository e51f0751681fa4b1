#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>
#include <sstream>

#include "framework/geometry/mesh_attributes.h"
#include "framework/geometry/mesh_import_abi.h"
#include "framework/geometry/model.h"
#include "framework/geometry/texture_check.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/geometry/weld.h"
#include "framework/input/input.h"
#include "framework/plugin/plugin_loader.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

/// Vertices nearer than this fraction of the bounding-box diagonal are merged [-]: above the single-precision rounding
/// of the files (6e-8), below any detail that can be felt (0.1 um on a 10 cm object).
constexpr double kWeldTolerance = 1e-6;
enum ModelCode { kNoCoordinates = 263, kNoLibrary = 264 };

/// With this many degenerate triangles a mesh is refused; fewer are dropped with a warning.
constexpr std::size_t kTooManyDegenerate = 10;

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string text(const Vec3& p) {
  std::ostringstream stream;
  stream << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return stream.str();
}

void turnInsideOut(MeshAttributes& attributes) {  // as the triangles of a TriMesh
  for (std::array<float, 3>& grey : attributes.corner_grey) std::swap(grey[1], grey[2]);
}

/// Those of the kept triangles, whose former indices ascend.
void keep(const std::vector<std::int32_t>& kept, MeshAttributes& attributes) {
  for (std::size_t t = 0; t < kept.size(); ++t) {
    const auto from = static_cast<std::size_t>(kept[t]);
    attributes.part_of[t] = attributes.part_of[from];
    if (!attributes.corner_grey.empty()) attributes.corner_grey[t] = attributes.corner_grey[from];
  }
  attributes.part_of.resize(kept.size());
  if (!attributes.corner_grey.empty()) attributes.corner_grey.resize(kept.size());
}

/// Reads, checks and repairs one file; stops at the first error.
class Import {
 public:
  /// `model`, `attributes`: one of them is filled in; null: not asked for.
  Import(const std::string& file, const ImportOptions& options, const SourceLocation& where, Diagnostics& diagnostics,
         std::shared_ptr<Model> model, MeshAttributes* attributes = nullptr)
      : file_(file),
        options_(options),
        where_(where),
        diagnostics_(diagnostics),
        model_(std::move(model)),
        attributes_(attributes) {}

  /// False: it is refused before it is read.
  bool prepare() { return checkScale() && checkFile(); }
  MeshFile file() const {
    return {file_.c_str(), extension_.c_str(),
            model_ != nullptr        ? MeshWanted::kModel
            : attributes_ != nullptr ? MeshWanted::kAttributes
                                     : MeshWanted::kTriangles};
  }
  /// The mesh of what was read; empty after an error.
  TriMesh finish(const ImportedMesh& imported) {
    const bool good = take(imported) && checkNumbers() && repair() && checkSurface();
    if (!good) return {};
    buildAdjacency(mesh_);
    return std::move(mesh_);
  }
  bool fail(int code, const std::string& what, const std::string& help) {
    diagnostics_.error(code, where_, "mesh " + file_ + ": " + what, help);
    return false;
  }

 private:
  void warn(int code, const std::string& what, const std::string& help) {
    diagnostics_.warning(code, where_, "mesh " + file_ + ": " + what, help);
  }

  bool checkScale();
  bool checkFile();
  bool take(const ImportedMesh& imported);
  bool takeModel(const ImportedModel& imported);
  bool takeAttributes(const ImportedAttributes& imported);
  void warnAbout(const ImportedModel& imported);
  bool checkNumbers();
  bool repair();
  bool checkSurface();
  bool checkClosed(const MeshReport& report);

  const std::string& file_;
  const ImportOptions& options_;
  const SourceLocation& where_;
  Diagnostics& diagnostics_;
  std::shared_ptr<Model> model_;
  MeshAttributes* const attributes_;
  std::string extension_;
  TriMesh mesh_;
};

bool Import::checkScale() {
  const bool usable = options_.scale.allFinite() && (options_.scale.array() != 0).all();
  return usable || fail(312, "scale " + text(options_.scale) + " makes the mesh vanish or is not finite",
                        "each factor must be finite and not zero");
}

bool Import::checkFile() {
  std::error_code ignored;
  const fs::path path(file_);
  if (!fs::exists(path, ignored)) return fail(301, "there is no such file", "paths are relative to the scene file");
  input::Refusal refusal;
  if (!input::open(file_, kMaxMeshBytes, refusal)) {
    refusal.report(301, where_, "mesh " + file_ + ": it ", diagnostics_);
    return false;
  }
  extension_ = path.extension().string();
  std::erase(extension_, '.');
  std::ranges::transform(extension_, extension_.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static constexpr std::array kFormats{"obj", "stl", "ply", "gltf", "glb", "dae"};
  if (std::ranges::find(kFormats, extension_) == kFormats.end()) {
    return fail(302, "unknown mesh format '" + extension_ + "'", "use obj, stl, ply, gltf, glb or dae");
  }
  return true;
}

bool Import::take(const ImportedMesh& imported) {
  if (imported.abi != kMeshImportAbi)
    return fail(300, "the mesh reader belongs to another version", "rebuild presa_mesh_import");
  if (imported.problem != nullptr && imported.code != 0)
    return fail(imported.code, imported.problem, imported.help != nullptr ? imported.help : "");
  if (imported.problem != nullptr) {
    return fail(303, std::string("it is not a mesh that can be read: ") + imported.problem,
                "open it in a mesh editor and export it again");
  }
  if (imported.triangle_count == 0) return fail(304, "it holds no triangles", "export a triangulated surface");
  mesh_.vertices.reserve(imported.vertex_count);
  for (std::size_t i = 0; i < imported.vertex_count; ++i) {
    const Vec3 vertex(imported.coordinates[3 * i], imported.coordinates[3 * i + 1], imported.coordinates[3 * i + 2]);
    mesh_.vertices.emplace_back(vertex.cwiseProduct(options_.scale));
  }
  mesh_.triangles.reserve(imported.triangle_count);
  for (std::size_t i = 0; i < imported.triangle_count; ++i) {
    mesh_.triangles.push_back({imported.indices[3 * i], imported.indices[3 * i + 1], imported.indices[3 * i + 2]});
  }
  if (attributes_ != nullptr && !takeAttributes(imported.attributes)) return false;
  if (options_.scale.prod() < 0) {
    turnInsideOut(mesh_);
    if (attributes_ != nullptr) turnInsideOut(*attributes_);
  }
  if (model_ == nullptr) return true;
  warnAbout(imported.model);
  return imported.model.part_count == 0 || takeModel(imported.model);
}

/// Normals of the file stay where they agree with the turned triangles.
void turnInsideOut(Model& model) {
  double agreement = 0;
  for (std::size_t c = 0; c + 2 < model.corners.size(); c += 3) {
    std::swap(model.corners[c], model.corners[c + 1]);
    std::array<Eigen::Vector3d, 3> p;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const ModelVertex& vertex = model.vertices[model.corners[c + i]];
      p[i] = Eigen::Map<const Eigen::Vector3f>(vertex.position.data()).cast<double>();
      normal += Eigen::Map<const Eigen::Vector3f>(vertex.normal.data()).cast<double>();
    }
    agreement += normal.dot((p[1] - p[0]).cross(p[2] - p[0]));
  }
  if (agreement >= 0) return;
  for (ModelVertex& vertex : model.vertices)
    for (float& n : vertex.normal) n = 0.0F - n;
}

ModelMaterial materialOf(const ImportedMaterial& from) {
  ModelMaterial material;
  material.color = Vec3(from.color[0], from.color[1], from.color[2]);
  material.roughness = from.roughness, material.metallic = from.metallic, material.relief = from.relief;
  material.color_map = from.color_map, material.normal_map = from.normal_map;
  material.roughness_map = from.roughness_map;
  return material;
}

bool Import::takeModel(const ImportedModel& imported) {
  model_->file = file_;
  const Eigen::Vector3f scale = options_.scale.cast<float>();
  model_->vertices.resize(imported.vertex_count);
  for (std::size_t v = 0; v < imported.vertex_count; ++v) {
    const float* const from = imported.vertices + ImportedModel::kFloats * v;
    ModelVertex& to = model_->vertices[v];
    const Eigen::Vector3f normal = Eigen::Map<const Eigen::Vector3f>(from + 3).cwiseQuotient(scale);
    Eigen::Map<Eigen::Vector3f>(to.position.data()) = Eigen::Map<const Eigen::Vector3f>(from).cwiseProduct(scale);
    Eigen::Map<Eigen::Vector3f>(to.normal.data()) = normal.isZero(0) ? normal : normal.normalized();
    to.at = {from[6], from[7]};
    std::copy_n(from + 8, 3, to.color.begin());
  }
  model_->corners.assign(imported.corners, imported.corners + imported.corner_count);
  if (options_.scale.prod() < 0) turnInsideOut(*model_);
  for (std::size_t i = 0; i < imported.part_count; ++i) {
    const ImportedPart& part = imported.parts[i];
    model_->parts.push_back({part.first_vertex, part.vertex_count, part.first_corner, part.corner_count,
                             materialOf(imported.materials[part.material])});
  }
  for (std::size_t i = 0; i < imported.texture_count; ++i) {
    const ImportedTexture& from = imported.textures[i];
    ModelTexture texture;
    texture.name.assign(imported.text + from.name, from.name_size);
    texture.bytes.assign(imported.text + from.bytes, from.bytes_size);
    model_->textures.push_back(std::move(texture));
  }
  const std::size_t before = diagnostics_.errorCount();
  checkTextures(*model_, where_, diagnostics_);
  return diagnostics_.errorCount() == before;
}

/// None of a file whose indices or coordinates are wrong, which is refused later.
bool Import::takeAttributes(const ImportedAttributes& imported) {
  attributes_->part_of.assign(mesh_.triangles.size(), -1);
  if (imported.part_count == 0) return true;
  if (imported.part_count != mesh_.triangles.size() ||
      (imported.grey_count != 0 && imported.grey_count != 3 * imported.part_count))
    return fail(303, "its attributes do not belong to its triangles", "open it in a mesh editor and export it again");
  for (std::size_t at = 0; at < imported.names_size; at += attributes_->parts.back().size() + 1)
    attributes_->parts.emplace_back(imported.names + at);
  attributes_->part_of.assign(imported.part_of, imported.part_of + imported.part_count);
  attributes_->corner_grey.resize(imported.grey_count / 3);
  for (std::size_t t = 0; t < attributes_->corner_grey.size(); ++t)
    std::copy_n(imported.grey + 3 * t, 3, attributes_->corner_grey[t].begin());
  return true;
}

void Import::warnAbout(const ImportedModel& imported) {
  const auto unmapped = [&](const ImportedPart& part) { return imported.materials[part.material].unmapped != 0; };
  if (std::any_of(imported.parts, imported.parts + imported.part_count, unmapped))
    warn(kNoCoordinates, "a part of it has a texture and no texture coordinates", "it is drawn without that texture");
  if (imported.missing_library != nullptr)
    warn(kNoLibrary, std::string("its materials are missing: there is no file ") + imported.missing_library,
         "it is drawn without them; copy that file to its place");
}

bool Import::checkNumbers() {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t index = mesh_.triangles[t][i];
      const auto corner = [&] { return "corner " + std::to_string(i) + " of triangle " + std::to_string(t); };
      if (index < 0 || static_cast<std::size_t>(index) >= mesh_.vertices.size()) {
        return fail(306, corner() + " (counting from 0) names a vertex that does not exist", "export the mesh again");
      }
      const Vec3& vertex = mesh_.vertices[static_cast<std::size_t>(index)];
      if (!vertex.allFinite()) {
        return fail(305, corner() + " (counting from 0) is at " + text(vertex),
                    "every coordinate must be a finite number");
      }
    }
  }
  return true;
}

bool Import::repair() {
  dropUnused(mesh_);
  const AxisBox box = boundsOf(mesh_);
  const double diagonal = (box.high - box.low).norm();
  if (!(diagonal > 0) || !std::isfinite(diagonal)) {
    return fail(307, "all points coincide or are too far apart to measure", "check the scale and the export");
  }
  const std::size_t before = mesh_.triangles.size();
  std::vector<std::int32_t> kept;
  weld(mesh_, kWeldTolerance * diagonal, attributes_ != nullptr ? &kept : nullptr);
  if (attributes_ != nullptr) keep(kept, *attributes_);
  dropUnused(mesh_);
  const std::size_t vanished = before - mesh_.triangles.size();
  const std::size_t degenerate = vanished + degenerateTriangles(mesh_);
  if (mesh_.triangles.empty()) {
    return fail(307, "all its " + std::to_string(before) + " triangles are degenerate (no area)",
                "check the scale and the export");
  }
  if (options_.display_only || degenerate == 0) return true;
  if (degenerate >= kTooManyDegenerate || degenerate > vanished) {
    return fail(307, counted(degenerate, "triangle is", "triangles are") + " degenerate (no area)",
                "merge coincident vertices and dissolve flat triangles in a mesh editor");
  }
  warn(307, counted(vanished, "degenerate triangle was", "degenerate triangles were") + " dropped", "");
  return true;
}

bool Import::checkSurface() {
  if (options_.display_only) return true;
  const MeshReport report = checkMesh(mesh_);
  if (report.non_manifold > 0) {
    return fail(308, counted(report.non_manifold, "edge belongs", "edges belong") + " to more than two triangles",
                "remove inner faces and doubled triangles: a surface has two triangles at each edge");
  }
  if (report.flipped_edges > 0) {
    return fail(310,
                "at " + counted(report.flipped_edges, "edge", "edges") +
                    " the two triangles disagree about which side is outside",
                "recalculate the normals (make them consistent) in a mesh editor");
  }
  return checkClosed(report);
}

bool Import::checkClosed(const MeshReport& report) {
  if (!report.closed()) {
    const std::string what =
        "it is open: " + counted(report.open_edges, "edge has", "edges have") + " only one triangle";
    if (options_.must_be_closed)
      return fail(309, what, "fill the holes: the body of a free object must enclose its volume");
    warn(309, what, "fingers can get in through the holes");
    return true;
  }
  if (report.inverted) {
    turnInsideOut(mesh_);
    if (model_ != nullptr) turnInsideOut(*model_);
    if (attributes_ != nullptr) turnInsideOut(*attributes_);
    warn(311, "it is inside out and was turned", "flip the normals in the file to avoid this warning");
  }
  return true;
}

using Imported = std::unique_ptr<const ImportedMesh, ReleaseMeshFunction>;

/// What the plug-in reads from these files.
std::vector<Imported> readFiles(const std::vector<MeshFile>& files) {
  const auto read = reinterpret_cast<ImportMeshesFunction>(pluginSymbol("mesh_import", kMeshImportSymbol));
  const auto release = reinterpret_cast<ReleaseMeshFunction>(pluginSymbol("mesh_import", kMeshReleaseSymbol));
  std::vector<Imported> all;
  for (std::size_t i = 0; i < files.size(); ++i) all.emplace_back(nullptr, release);
  std::vector<const ImportedMesh*> found(files.size());
  read(files.data(), files.size(), found.data());
  for (std::size_t i = 0; i < files.size(); ++i) all[i].reset(found[i]);
  return all;
}

/// Reads the files of several imports at once; meshes[i] is that of imports[i], empty after an error.
std::vector<TriMesh> run(std::span<Import> imports) {
  std::vector<TriMesh> meshes(imports.size());
  std::vector<std::size_t> prepared;
  std::vector<MeshFile> files;
  for (std::size_t i = 0; i < imports.size(); ++i) {
    if (!imports[i].prepare()) continue;
    prepared.push_back(i);
    files.push_back(imports[i].file());
  }
  if (files.empty()) return meshes;
  std::size_t k = 0;
  const auto failRest = [&](int code, const std::string& what, const std::string& help) {
    for (std::size_t i = k; i < prepared.size(); ++i) imports[prepared[i]].fail(code, what, help);
  };
  try {
    std::vector<Imported> imported = readFiles(files);
    for (; k < prepared.size(); ++k) {
      meshes[prepared[k]] = imports[prepared[k]].finish(*imported[k]);
      imported[k].reset();
    }
  } catch (const InputError& error) {
    for (const Diagnostic& found : error.diagnostics().all()) failRest(300, found.message, found.help);
  } catch (const std::bad_alloc&) {
    failRest(303, "the mesh does not fit into memory", "simplify the mesh");
  }
  return meshes;
}

TriMesh run(Import import) { return std::move(run(std::span(&import, 1)).front()); }

DrawnMesh drawn(TriMesh mesh, std::shared_ptr<Model> model) {
  if (mesh.triangles.empty() || model == nullptr || model->parts.empty()) return {std::move(mesh), nullptr};
  return {std::move(mesh), std::move(model)};
}

}  // namespace

TriMesh importMesh(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                   Diagnostics& diagnostics) {
  return run(Import(file, options, where, diagnostics, nullptr));
}

AttributedMesh importAttributed(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                                Diagnostics& diagnostics) {
  AttributedMesh read;
  read.mesh = run(Import(file, options, where, diagnostics, nullptr, &read.attributes));
  if (read.mesh.triangles.empty()) read.attributes = {};
  return read;
}

DrawnMesh importDrawn(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                      Diagnostics& diagnostics) {
  const auto model = std::make_shared<Model>();
  return drawn(run(Import(file, options, where, diagnostics, model)), model);
}

std::vector<DrawnMesh> importMeshes(std::span<const MeshOrder> orders, Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<Model>> models;
  std::vector<Import> imports;
  for (const MeshOrder& order : orders) {
    models.push_back(order.drawn ? std::make_shared<Model>() : nullptr);
    imports.emplace_back(order.file, order.options, order.where, diagnostics, models.back());
  }
  std::vector<DrawnMesh> all;
  constexpr std::size_t kTogether = 128;  // files whose content is in memory at once
  for (std::size_t begin = 0; begin < imports.size(); begin += kTogether) {
    const std::size_t count = std::min(kTogether, imports.size() - begin);
    std::vector<TriMesh> meshes = run(std::span(imports).subspan(begin, count));
    for (std::size_t k = 0; k < count; ++k) all.push_back(drawn(std::move(meshes[k]), models[begin + k]));
  }
  return all;
}

}  // namespace presa
