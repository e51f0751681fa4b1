#include "apps/studies/printed/printed_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/studies/printed/page.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

struct Arguments {
  std::string scene, out;
};

int runPrinted(const Arguments& a) {
  const std::string folder = a.out.empty() ? "printed_" + std::filesystem::path(a.scene).stem().string() : a.out;
  const printed::Comparison comparison = printed::compare(a.scene);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) refuse(620, "--out " + folder, "nothing can be written there", failed.message());
  writeFileAtomically(folder + "/grid.csv", printed::toCsv(comparison));
  writeFileAtomically(folder + "/report.html", printed::reportHtml(comparison, "presa printed " + a.scene));
  std::string text = printed::terminalText(comparison) + "\n";
  for (const std::string& sentence : comparison.sentences()) text += sentence + "\n";
  std::fputs(printableLines(text + folder + "/report.html\n").c_str(), stdout);
  return comparison.holds() ? kExitOk : kExitFault;
}

}  // namespace

void addPrinted(Command app, int& status) {
  auto a = std::make_shared<Arguments>();
  Command command =
      app.command("printed", "Hold the system of a paper, as printed, beside today's methods and its figures");
  command.option("SCENE", a->scene, "scene with a file of printed figures: config/scenes/percro_2006.xml").required();
  command.option("--out", a->out, "folder for report.html and grid.csv (default: printed_SCENE)");
  command.footer(
      "Exit status: 0 today's methods hold every grasp of the grid, 1 they lose some, 2 bad input, 130 Ctrl-C.\n"
      "Example:  presa printed config/scenes/percro_2006.xml --out out/percro_2006");
  command.action([a, &status] {
    try {
      status = runPrinted(*a);
    } catch (const printed::Stopped&) {
      std::fputs("stopped; nothing was written\n", stderr);
      status = kExitInterrupted;
    }
  });
}

}  // namespace presa
