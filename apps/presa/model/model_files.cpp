#include "apps/presa/model/model_files.h"

#include <algorithm>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/common/scene_name.h"
#include "apps/common/terminal/text.h"
#include "framework/geometry/obj_text.h"
#include "framework/scene/xml/escaped.h"

namespace presa::model {
namespace {

namespace fs = std::filesystem;

enum ModelCode { kTarget = 128 };

constexpr double kHapticShare = 0.6;  // of the work that `go_on` is told about

std::string nameOf(const std::string& file) { return sceneName(fs::path(file).stem().string()); }

std::string hapticFile(const std::string& name) { return name + "_haptic.obj"; }
std::string pieceFile(const std::string& name, std::size_t i) {
  return name + "_piece_" + std::to_string(i + 1) + ".obj";
}
std::string bodyFile(const std::string& name) { return name + "_body.xml"; }

bool isWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

std::string millimetres(double length) { return terminal::format("%.3g mm", 1e3 * length); }

}  // namespace

void checkTarget(const Wanted& wanted, Diagnostics& diagnostics) {
  std::error_code error;
  if (fs::exists(wanted.folder, error) && !fs::is_directory(wanted.folder, error)) {
    diagnostics.error(kTarget, {wanted.folder, 0, 0}, "is a file, and a folder is wanted", "name another folder");
    return;
  }
  const std::string name = nameOf(wanted.file);
  for (const std::string& file : {hapticFile(name), pieceFile(name, 0), bodyFile(name)}) {
    const fs::path path = fs::path(wanted.folder) / file;
    if (wanted.overwrite || !fs::exists(path, error)) continue;
    diagnostics.error(kTarget, {path.string(), 0, 0}, "exists already",
                      "name another folder, or add --overwrite to replace it");
  }
}

std::optional<Made> make(const Wanted& wanted, Diagnostics& diagnostics, const GoOn& go_on) {
  ImportOptions options;
  options.scale = Vec3::Constant(wanted.scale);
  const TriMesh mesh = importMesh(wanted.file, options, {wanted.file, 0, 0}, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  Made made{nameOf(wanted.file), mesh.triangles.size(), {}, {}};
  made.haptic = touchMesh(mesh, wanted.haptic_error, [&](double share) { return go_on(kHapticShare * share); });
  if (made.haptic.mesh.triangles.empty()) return std::nullopt;
  made.physics = touchPieces(mesh, static_cast<std::size_t>(wanted.pieces), wanted.haptic_error,
                             [&](double share) { return go_on(kHapticShare + (1 - kHapticShare) * share); });
  if (made.physics.pieces.empty()) return std::nullopt;
  return made;
}

std::string sceneFolder(const Wanted& wanted) {
  const fs::path model = fs::weakly_canonical(wanted.file).parent_path(), out = fs::weakly_canonical(wanted.folder);
  return isWithin(out, model) ? model.string() : out.string();
}

bool liesOutside(const Wanted& wanted) { return !isWithin(fs::weakly_canonical(wanted.file), sceneFolder(wanted)); }

std::string bodyText(const Wanted& wanted, const Made& made) {
  const fs::path home = sceneFolder(wanted);
  const std::string visual = fs::weakly_canonical(wanted.file).lexically_proximate(home).generic_string();
  const auto mesh = [&](const std::string& file) {
    const fs::path path = fs::weakly_canonical(wanted.folder) / file;
    return "<mesh file=\"" + xml::escaped(path.lexically_proximate(home).generic_string()) + "\"/>";
  };
  const std::string scale =
      wanted.scale == 1 ? "" : terminal::format(" scale=\"%.9g %.9g %.9g\"", wanted.scale, wanted.scale, wanted.scale);
  std::string text = "<body name=\"" + made.name + "\">\n  <visual><mesh file=\"" + xml::escaped(visual) + "\"" +
                     scale + "/></visual>\n  <haptic>" + mesh(hapticFile(made.name)) + "</haptic>\n" +
                     terminal::format("  <physics density=\"%.9g\">\n", wanted.density);
  for (std::size_t i = 0; i < made.physics.pieces.size(); ++i) text += "    " + mesh(pieceFile(made.name, i)) + "\n";
  return text + "  </physics>\n</body>\n";
}

std::string write(const Wanted& wanted, const Made& made) {
  fs::create_directories(wanted.folder);
  const auto put = [&](const std::string& file, const std::string& text) {
    const std::string path = (fs::path(wanted.folder) / file).string();
    writeFileAtomically(path, text);
    return path;
  };
  put(hapticFile(made.name), objText(made.haptic.mesh));
  for (std::size_t i = 0; i < made.physics.pieces.size(); ++i)
    put(pieceFile(made.name, i), objText(made.physics.pieces[i], 9));
  // a run before may have made more of them
  std::size_t stale = made.physics.pieces.size();
  while (fs::remove(fs::path(wanted.folder) / pieceFile(made.name, stale))) ++stale;
  return put(bodyFile(made.name), bodyText(wanted, made));
}

std::string figuresText(const Made& made) {
  const auto between = [](double low, double high) { return millimetres(low) + " to " + millimetres(high); };
  const TouchMesh& haptic = made.haptic;
  return terminal::format("model: %zu triangles\nhaptic mesh: %zu triangles\n", made.triangles,
                          haptic.mesh.triangles.size()) +
         "  model to haptic mesh: " + between(haptic.forth.low, haptic.forth.high) +
         "\n  haptic mesh to model: " + between(haptic.back.low, haptic.back.high) +
         " (Hausdorff distances one way, proven bounds)\n" +
         terminal::format("physics: %zu convex piece%s\n", made.physics.pieces.size(),
                          made.physics.pieces.size() == 1 ? "" : "s") +
         "  model to pieces: " + between(made.physics.forth.low, made.physics.forth.high) +
         "\n  pieces to model: " + between(made.physics.back.low, made.physics.back.high) + " (as solids, likewise)\n";
}

}  // namespace presa::model
