#include "apps/presa/model/model_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/common/exit_status.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/presa/model/model_files.h"

namespace presa {
namespace {

constexpr std::size_t kPercent = 100;

int makeModel(const model::Wanted& wanted) {
  Diagnostics diagnostics;
  model::checkTarget(wanted, diagnostics);
  std::optional<model::Made> made;
  {
    terminal::JobProgress progress(kPercent);
    std::size_t told = 0;
    const auto go_on = [&](double share) {
      for (; told < static_cast<std::size_t>(share * kPercent); ++told) progress.done("simplifying");
      progress.show();
      return !terminal::JobProgress::interrupted();
    };
    if (!diagnostics.hasErrors()) made = model::make(wanted, diagnostics, go_on);
    if (terminal::JobProgress::interrupted()) return kExitInterrupted;
  }
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!made) return kExitBadInput;
  const std::string body = model::write(wanted, *made);
  std::fputs(model::figuresText(*made).c_str(), stdout);
  std::printf("\n%s, for a scene in %s:\n%s", body.c_str(),
              std::filesystem::proximate(model::sceneFolder(wanted)).c_str(), model::bodyText(wanted, *made).c_str());
  if (model::liesOutside(wanted))
    std::printf("%s lies elsewhere: copy it there, or run the scene with --allow-folder and its folder\n",
                wanted.file.c_str());
  return kExitOk;
}

}  // namespace

void addModel(Command app, int& status) {
  struct Arguments {
    model::Wanted wanted;
    double haptic_error_mm = 0.1;
  };
  auto a = std::make_shared<Arguments>();
  Command command = app.command(
      "model", "Make haptic and physics geometry from a photographed model, and tell how far they are from it");
  command.option("FILE", a->wanted.file, "mesh: obj, ply, gltf, glb, stl or dae; closed").required().existingFile();
  command.option("--out", a->wanted.folder, "folder for NAME_haptic.obj, NAME_piece_N.obj and NAME_body.xml")
      .required();
  command.option("--haptic-error", a->haptic_error_mm, "max Hausdorff distance of the haptic mesh from the model [mm]")
      .positive()
      .showDefault();
  command.option("--pieces", a->wanted.pieces, "max number of convex pieces for the dynamics")
      .withinCount(1, 256)
      .showDefault();
  command.option("--scale", a->wanted.scale, "metres for each unit of the file, e.g. 0.001 for millimetres")
      .positive()
      .showDefault();
  command.option("--density", a->wanted.density, "of the body [kg/m³]").positive().showDefault();
  command.flag("--overwrite", a->wanted.overwrite, "replace files of before");
  command.footer(
      "The body is drawn as the model, with its colours and textures; fingers feel the haptic mesh, other bodies the "
      "pieces.\n"
      "config/MODELS.md says how models are drawn. The output lies best beside the model or below it, where a scene "
      "beside "
      "the\nmodel may name all files.\n"
      "Exit status: 0 done, 2 bad input (nothing written), 130 Ctrl-C (likewise).\n"
      "Example:  presa model drum.glb --out drum --haptic-error 0.2 --pieces 8");
  command.action([a, &status] {
    a->wanted.haptic_error = 1e-3 * a->haptic_error_mm;
    status = makeModel(a->wanted);
  });
}

}  // namespace presa
