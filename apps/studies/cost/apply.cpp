#include "apps/studies/cost/apply.h"

#include <unistd.h>

#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/verdict.h"
#include "framework/scene/scene_copy.h"

namespace presa::cost {
namespace {

namespace fs = std::filesystem;

enum Code { kApply = 809 };

}  // namespace

void checkApply(const std::string& file, const Study& study, Diagnostics& diagnostics) {
  const SourceLocation where{"--apply " + file, 0, 0};
  std::error_code ignored;
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  if (fs::is_directory(file, ignored))
    diagnostics.error(kApply, where, "is a folder, not a file", "name the scene file to write, such as better.xml");
  else if (!fs::is_directory(folder, ignored))
    diagnostics.error(kApply, where, "there is no folder " + folder.string(), "make it first");
  else if (access(folder.c_str(), W_OK) != 0)
    diagnostics.error(kApply, where, "the folder " + folder.string() + " cannot be written to");
  else if (fs::equivalent(file, study.inputs.scene, ignored))
    diagnostics.error(kApply, where, "is the scene of the study itself", "give the new scene a name of its own");
}

std::string applyBetter(const Result& result, const std::string& file) {
  const Verdict verdict = verdictOf(result);
  if (!verdict.better) return verdict.headline + ": " + file + " is not written.";
  std::vector<std::string> sets = result.study.inputs.sets;
  const std::vector<std::string>& better = result.outcomes[*verdict.better].setting.sets;
  sets.insert(sets.end(), better.begin(), better.end());
  std::vector<Override> overrides;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  Diagnostics diagnostics;
  const std::string text = sceneCopy(result.study.inputs.scene, overrides, file, diagnostics);
  readCopy(text, file, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  writeFileAtomically(file, text);
  return file + " is " + result.study.inputs.scene + " with " + setOptions(sets) + ".";
}

}  // namespace presa::cost
