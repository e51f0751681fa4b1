#include "apps/presa/import/import_robot.h"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "apps/common/atomic_file.h"
#include "apps/common/scene_name.h"
#include "apps/common/scratch_folder.h"
#include "apps/presa/import/codes.h"
#include "framework/core/diagnostics/printable.h"

namespace presa::robot {
namespace {

namespace fs = std::filesystem;

/// MuJoCo's words about the scratch file, as an error at the place of the user's file. Its last "line N" is the place:
/// before it, names of the file may stand.
void report(const Source& source, std::string words, Diagnostics& diagnostics) {
  std::ranges::replace(words, '\n', ' ');
  static const std::regex kLine(",? *\\(?line[ =]+(\\d{1,8})(, column [ =-]*\\d+)?\\)?");
  SourceLocation where = source.document->root().where();
  const auto all = std::sregex_iterator(words.begin(), words.end(), kLine);
  if (all != std::sregex_iterator()) {
    std::smatch last;
    for (auto it = all; it != std::sregex_iterator(); ++it) last = *it;
    where = whereOf(source, std::stoi(last[1]));
    words.erase(static_cast<std::size_t>(last.position()), static_cast<std::size_t>(last.length()));
  }
  words.erase(words.find_last_not_of(' ') + 1);
  diagnostics.error(kUnreadable, where, "MuJoCo cannot read the model: " + printable(words),
                    "it knows URDF, and MJCF of version 2.2");
}

}  // namespace

void checkTarget(const Wanted& wanted, Diagnostics& diagnostics) {
  std::error_code error;
  if (fs::exists(wanted.folder, error) && !fs::is_directory(wanted.folder, error)) {
    diagnostics.error(kTarget, {wanted.folder, 0, 0}, "is a file, and a folder is wanted", "name another folder");
  } else if (fs::exists(wanted.folder, error) && !fs::is_empty(wanted.folder, error) && !wanted.overwrite) {
    diagnostics.error(kTarget, {wanted.folder, 0, 0}, "exists already and is not empty",
                      "name another folder, or add --overwrite to replace files in it");
  }
}

std::optional<Imported> importRobot(const Wanted& wanted, Diagnostics& diagnostics) {
  const ScratchFolder scratch;
  const auto source = prepare(wanted.file, scratch.file(""), {wanted.free_base}, diagnostics);
  if (!source) return std::nullopt;
  Robot robot;
  const auto& reader = pluginTable<ReaderPlugin>("robot_reader", kReaderSymbol);
  const std::string problem = reader.read(source->file.string(), robot);
  if (!problem.empty()) {
    report(*source, problem, diagnostics);
    return std::nullopt;
  }
  Imported imported{sceneName(source->name), {}, source->left_out.all()};
  SceneSettings settings;
  settings.name = imported.name;
  settings.source = fs::path(wanted.file).filename().string();
  settings.root = source->root;
  settings.carried = source->carried;
  settings.where = [&](const std::string& link) { return whereIsLink(*source, link); };
  settings.stiffness = wanted.stiffness;
  imported.files = sceneOf(robot, settings, diagnostics);
  std::error_code error;
  const fs::path scene = fs::path(wanted.folder) / (imported.name + ".xml");
  if (fs::exists(scene, error) && fs::equivalent(scene, wanted.file, error))
    diagnostics.error(kTarget, {scene.string(), 0, 0}, "is what is read, and the scene would replace it",
                      "name another folder");
  if (diagnostics.hasErrors()) return std::nullopt;
  return imported;
}

std::string write(const std::string& to, const Imported& imported) {
  const fs::path folder = to;
  for (const auto& [name, text] : imported.files.others) {
    fs::create_directories((folder / name).parent_path());
    writeFileAtomically((folder / name).string(), text);
  }
  const std::string scene = (folder / (imported.name + ".xml")).string();
  fs::create_directories(folder);
  writeFileAtomically(scene, imported.files.scene);
  return scene;
}

std::string leftOutText(const Imported& imported) {
  std::string text;
  for (const LeftOut& left : imported.left_out) {
    text += "  " + printable(left.what) +
            (left.count > 1 ? ", " + std::to_string(left.count) + " times, the first" : "") + " at " +
            printable(left.where.file) + ":" + std::to_string(left.where.line) + "\n";
  }
  for (const std::string& note : imported.files.notes) text += "  " + printable(note) + "\n";
  return text;
}

}  // namespace presa::robot
