#include "apps/studies/lectures/lectures_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/studies/lectures/report.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

struct Arguments {
  std::string name, out;
};

int runLecture(const Arguments& a) {
  const std::string folder = a.out.empty() ? "lectures_" + a.name : a.out;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) refuse(618, "--out " + folder, "nothing can be written there", failed.message());
  const lectures::Lecture lecture = lectures::run(a.name);
  writeFileAtomically(folder + "/plot.svg", lectures::picture(lecture));
  writeFileAtomically(folder + "/figures.csv", lectures::toCsv(lecture));
  writeFileAtomically(folder + "/report.html", lectures::reportHtml(lecture, "presa lectures " + a.name));
  for (const std::string& sentence : lecture.sentences) std::printf("%s\n", sentence.c_str());
  std::printf("%s/report.html\n", folder.c_str());
  return lecture.holds() ? kExitOk : kExitFault;
}

}  // namespace

void addLectures(Command app, int& status) {
  auto a = std::make_shared<Arguments>();
  Command command = app.command(
      "lectures", "Run an experiment of the haptics lectures and hold its figures against their closed form");
  command
      .option("EXPERIMENT", a->name,
              "buzzing: the held force of waves of 80 Hz; tracing: the damping that a hard plane needs;\n"
              "jitter: the energy that late ticks give; latency: the stiffness that a delay allows")
      .oneOf(lectures::names())
      .required();
  command.option("--out", a->out, "folder for report.html, plot.svg and figures.csv (default: lectures_EXPERIMENT)");
  command.footer(
      "Exit status: 0 every figure is within its tolerance, 1 some are not, 2 bad input.\n"
      "Example:  presa lectures latency --out out/latency");
  command.action([a, &status] { status = runLecture(*a); });
}

}  // namespace presa
