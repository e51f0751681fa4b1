#include "apps/temple/written_scene.h"

#include <filesystem>

#include "apps/common/atomic_file.h"

namespace presa::temple {

void checkTarget(const std::string& folder, bool overwrite, Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return;
  if (!std::filesystem::is_directory(folder, error))
    diagnostics.error(978, {folder, 0, 0}, "is a file, and a folder is wanted", "name another folder");
  else if (!overwrite && !std::filesystem::is_empty(folder, error))
    diagnostics.error(978, {folder, 0, 0}, "the folder holds files already",
                      "name another folder, or add --overwrite to replace scene.xml and meshes in it");
}

std::string writeScene(const Building& building, const SceneSpec& spec, const std::string& folder) {
  const std::filesystem::path root(folder);
  std::filesystem::create_directories(root / "meshes");
  for (const SceneFile& file : meshFiles(building, false)) writeFileAtomically((root / file.path).string(), file.text);
  // written last: when scene.xml exists, all files that it names exist
  const std::string scene = (root / "scene.xml").string();
  writeFileAtomically(scene, sceneText(building, spec));
  return scene;
}

}  // namespace presa::temple
