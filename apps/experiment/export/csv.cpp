#include "apps/experiment/export/csv.h"

#include <algorithm>
#include <filesystem>

#include "apps/common/delimited.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/export/cells.h"
#include "apps/experiment/export/motion.h"
#include "apps/experiment/export/staging.h"
#include "experiments/runner/definition/definition.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/record/record_plugin.h"

namespace presa::experiment {
namespace {

std::string lineOf(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + quotedCell(cells[i], ',');
  return line + "\n";
}

std::string headingOf(const SourceColumn& column) { return experiment::headingOf(column.name, column.unit); }

/// Columns of all sessions in the order of first appearance: experiments may differ in their columns.
std::vector<SourceColumn> allColumns(const std::vector<SourceSession>& sessions) {
  std::vector<SourceColumn> all;
  for (const SourceSession& session : sessions) {
    for (const SourceColumn& column : session.columns) {
      const auto same = [&](const SourceColumn& one) { return headingOf(one) == headingOf(column); };
      if (std::none_of(all.begin(), all.end(), same)) all.push_back(column);
    }
  }
  return all;
}

std::string seriesOf(const SourceSession& session, const std::string& recording) {
  return "timeseries/" + session.prefix() + "_" + std::filesystem::path(recording).stem().string() + ".csv";
}

std::vector<std::string> cellsOf(const SourceSession& session, std::size_t run,
                                 const std::vector<SourceColumn>& columns) {
  std::vector<std::string> cells(columns.size(), kNothing);
  for (std::size_t c = 0; c < session.columns.size() && c < session.rows[run].size(); ++c) {
    const auto at = std::find_if(columns.begin(), columns.end(), [&](const SourceColumn& one) {
      return headingOf(one) == headingOf(session.columns[c]);
    });
    const auto files = session.recordings(session.log.runs[run]);
    const bool is_file = session.columns[c].name == "file";
    cells[static_cast<std::size_t>(at - columns.begin())] = !is_file        ? session.rows[run][c]
                                                            : files.empty() ? kNothing
                                                                            : seriesOf(session, files.front());
  }
  return cells;
}

std::string trialsCsv(const std::vector<SourceSession>& sessions, const std::vector<SourceColumn>& columns) {
  std::vector<std::string> header;
  for (const SourceColumn& column : columns) header.push_back(headingOf(column));
  std::string text = lineOf(header);
  for (const SourceSession& session : sessions) {
    for (std::size_t run = 0; run < session.rows.size(); ++run) text += lineOf(cellsOf(session, run, columns));
  }
  return text;
}

std::string columnsJson(const std::vector<SourceColumn>& columns) {
  Json json = Json::object();
  for (const SourceColumn& column : columns) {
    json[headingOf(column)] = {{"Description", column.description}};
    if (!column.unit.empty()) json[headingOf(column)]["Units"] = column.unit;
  }
  return json.dump(2) + "\n";
}

/// Rate of a time series [Hz]; `asked` = 0: 1000, or the haptic rate if that is lower.
double rateOf(const Motion& motion, double asked) {
  constexpr double kUsual = 1000;
  if (asked > motion.nominalRate() * (1 + 1e-9))
    refuse(935, "--rate",
           terminal::format("%g rows a second were not recorded: there are %g", asked, motion.nominalRate()));
  return asked > 0 ? asked : std::min(kUsual, motion.nominalRate());
}

std::string seriesCsv(const std::string& file, double rate) {
  const RecordedSamples samples = recordPlugin().samples(file);
  const Motion motion(samples);
  std::vector<std::string> header;
  for (const Channel& channel : motion.channels())
    header.push_back(experiment::headingOf(channel.name, channel.units == kNothing ? "" : channel.units));
  header.front() = "time [s]";
  return lineOf(header) + motion.rows(',', motion.ticksAt(rateOf(motion, rate)));
}

}  // namespace

bool exportCsv(const std::vector<SourceSession>& sessions, const std::string& out, double rate, const Continue& more) {
  StagedFolder folder(out);
  const std::vector<SourceColumn> columns = allColumns(sessions);
  folder.write("trials.csv", trialsCsv(sessions, columns));
  folder.write("trials.json", columnsJson(columns));
  for (const SourceSession& session : sessions) {
    for (const LoggedRun& run : session.log.runs) {
      for (const std::string& name : session.recordings(run)) {
        checkUnaltered(session.folder, name, run.end.at("sha256").at(name));
        folder.write(seriesOf(session, name), seriesCsv(session.folder.file(name), rate));
        if (!more(session.prefix() + " " + name)) return false;
      }
    }
  }
  folder.publish();
  return true;
}

}  // namespace presa::experiment
