#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/common/terminal/job_progress.h"
#include "apps/experiment/commands/experiment_commands.h"
#include "apps/experiment/export/csv.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

using namespace experiment;

struct ExportArguments {
  std::string data, bids, csv;
  double rate = 0;
  BidsOptions options;
};

std::size_t recordingsOf(const std::vector<SourceSession>& sessions) {
  std::size_t recordings = 0;
  for (const SourceSession& session : sessions) {
    for (const LoggedRun& run : session.log.runs) recordings += session.recordings(run).size();
  }
  return recordings;
}

/// Prints the caveats that a reader of the numbers must know.
void printCaveats(const std::vector<SourceSession>& sessions, const std::string& out) {
  std::printf("%zu sessions: %s\n", sessions.size(), out.c_str());
  for (const SourceSession& session : sessions) {
    if (!session.log.complete) std::printf("  %s is not finished\n", session.folder.path.c_str());
    if (!session.model().empty()) std::printf("  %s: %s\n", session.prefix().c_str(), session.model().c_str());
    std::printf("  %s: seal %s\n", session.prefix().c_str(), session.seal.c_str());
  }
}

int exportDataset(const ExportArguments& a) {
  if (a.bids.empty() && a.csv.empty()) refuse(934, "export", "no output is named", "add --bids OUT, --csv OUT or both");
  for (const std::string& out : {a.bids, a.csv}) {
    if (!out.empty() && std::filesystem::exists(out)) refuse(933, out, "exists already: nothing is ever overwritten");
  }
  const std::vector<SourceSession> sessions = sourceSessions(a.data);
  const std::size_t kinds = (a.bids.empty() ? 0U : 1U) + (a.csv.empty() ? 0U : 1U);
  terminal::JobProgress progress(kinds * recordingsOf(sessions));
  const Continue more = [&](const std::string& what) {
    progress.done(what);
    return !terminal::JobProgress::interrupted();
  };
  bool whole = a.bids.empty() || exportBids(sessions, a.bids, a.options, more);
  if (whole && !a.bids.empty()) printCaveats(sessions, a.bids);
  whole = whole && (a.csv.empty() || exportCsv(sessions, a.csv, a.rate, more));
  progress.finish();
  if (whole && !a.csv.empty()) printCaveats(sessions, a.csv);
  if (!whole) std::fputs("stopped: the unfinished export was removed\n", stderr);
  return whole ? kExitOk : kExitInterrupted;
}

}  // namespace

void addExport(Command app, int& status) {
  auto a = std::make_shared<ExportArguments>();
  Command command = app.command("export", "Write a dataset for others: BIDS, CSV");
  command.option("DIR", a->data, "folder of a dataset, or of one session in it").required().existingFolder();
  command.option("--bids", a->bids, "new folder for a BIDS dataset (beh, motion)");
  command.option("--csv", a->csv, "new folder for trials.csv and a time series for each recording");
  command
      .option("--rate", a->rate, "rows per second of the time series in CSV (default: 1000, at most the haptic rate)")
      .positive();
  command.option("--license", a->options.license, "of the BIDS dataset, for example CC0");
  command.option("--author", a->options.authors, "of the BIDS dataset; one --author for each");
  command.footer(
      "Every file is checked against the log first: nothing that was altered is exported.\n"
      "Exit status: 0 exported, 1 disk failed, 2 bad input (nothing was written), 130 Ctrl-C.\n"
      "Example:  presa experiment export data --bids data_bids --csv data_csv --rate 100");
  command.action([a, &status] { status = exportDataset(*a); });
}

}  // namespace presa
