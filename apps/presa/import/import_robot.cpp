#include "apps/presa/import/import_robot.h"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "apps/common/atomic_file.h"
#include "apps/common/scene_name.h"
#include "apps/common/scratch_folder.h"
#include "apps/presa/import/codes.h"

namespace presa::robot {
namespace {

namespace fs = std::filesystem;

/// MuJoCo's words about the scratch file, as an error at the place of the user's file.
void report(const Source& source, std::string words, Diagnostics& diagnostics) {
  std::ranges::replace(words, '\n', ' ');
  static const std::regex kLine(",? *\\(?line[ =]+(\\d+)(, column [ =-]*\\d+)?\\)?");
  std::smatch line;
  const bool placed = std::regex_search(words, line, kLine);
  const SourceLocation where = placed ? whereOf(source, std::stoi(line[1])) : source.document->root().where();
  words = std::regex_replace(words, kLine, "");
  words.erase(words.find_last_not_of(' ') + 1);
  diagnostics.error(kUnreadable, where, "MuJoCo cannot read the model: " + words,
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
  imported.files = sceneOf(
      robot,
      {imported.name, fs::path(wanted.file).filename().string(), source->root, source->carried, wanted.stiffness},
      diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  return imported;
}

std::string write(const Wanted& wanted, const Imported& imported) {
  const fs::path folder = wanted.folder;
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
    text += "  " + left.what + (left.count > 1 ? ", " + std::to_string(left.count) + " times, the first" : "") +
            " at " + left.where.file + ":" + std::to_string(left.where.line) + "\n";
  }
  for (const std::string& note : imported.files.notes) text += "  " + note + "\n";
  return text;
}

}  // namespace presa::robot
