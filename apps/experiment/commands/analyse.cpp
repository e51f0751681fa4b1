#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "apps/common/terminal/job_progress.h"
#include "apps/experiment/analysis/analyse.h"
#include "apps/experiment/commands/experiment_commands.h"
#include "apps/experiment/journal.h"

namespace presa {
namespace {

struct AnalyseArguments {
  experiment::analysis::Request request;
  std::string out;
};

/// Default output folder: inside a dataset, but beside a single session, whose folder must hold only files of its log.
std::string outOf(const AnalyseArguments& a) {
  if (!a.out.empty()) return a.out;
  std::filesystem::path data = std::filesystem::path(a.request.data).lexically_normal();
  if (!data.has_filename()) data = data.parent_path();
  if (std::filesystem::exists(data / experiment::kJournal)) return data.string() + "-analysis";
  return (data / "analysis").string();
}

int analyseAll(const AnalyseArguments& a) {
  namespace analysis = experiment::analysis;
  std::unique_ptr<terminal::JobProgress> line;
  const analysis::Result result =
      analysis::analyse(a.request, [&](std::size_t done, std::size_t all, const std::string& what) {
        if (!line) line = std::make_unique<terminal::JobProgress>(all);
        if (done > 0) line->done(what);
        if (terminal::JobProgress::interrupted()) return false;
        return true;
      });
  if (line) line->finish();
  if (result.interrupted) return kExitInterrupted;
  const std::string out = outOf(a);
  try {
    analysis::write(result, out);
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "presa: error: %s\n", error.what());
    return kExitFault;
  }
  if (!result.trials.model().empty()) std::printf("Not persons: %s\n", result.trials.model().c_str());
  for (const std::string& sentence : result.headlines()) std::printf("%s\n", sentence.c_str());
  for (const std::string& note : result.notes) std::printf("%s\n", note.c_str());
  std::printf("%zu trials of %zu subjects: %s/report.html\n", result.trials.size(), result.trials.subjects.size(),
              out.c_str());
  return kExitOk;
}

}  // namespace

void addAnalyse(Command app, int& status) {
  auto a = std::make_shared<AnalyseArguments>();
  Command command = app.command("analyse", "Statistics and figures of a dataset, as its experiment names them");
  command.option("DIR", a->request.data, "folder of a dataset, or of one session in it").required().existingFolder();
  command.option("--out", a->out, "folder of report.html, analysis.json and tables/*.csv (default: DIR/analysis)");
  command
      .option("--experiment", a->request.experiment,
              "experiment file whose <analysis> is wanted (default: the dataset's own copy)")
      .existingFile();
  command.footer(
      "Exit status: 0 done, 1 cannot be written, 2 bad input (nothing was written), 130 Ctrl-C.\n"
      "Example:  presa experiment analyse data");
  command.action([a, &status] { status = analyseAll(*a); });
}

}  // namespace presa
