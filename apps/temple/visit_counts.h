#pragma once
#include <optional>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::temple {

/// Counts visits in a file, for whoever looks after an exhibit: a line "day,task,what,seconds" when somebody begins, and
/// another when the task is finished or left. Nothing about the person. Each line is appended by one write to a file
/// opened for appending and is then on the disk: what has been written survives the end of the process at any moment,
/// and a visit that was cut off has begun and no end. Several programs may append to one file. Thread: main.
class VisitCounts {
 public:
  /// `file`: empty: nothing is counted. Creates its folder and, in a new file, a line with the names of the columns.
  /// Throws std::system_error.
  VisitCounts(std::string file, std::string task);
  /// Somebody touches at a time of the visit's clock [s]; begins a visit unless one is under way.
  void touch(double time);
  /// The task is complete, or nobody is there any more: ends the visit that is under way.
  void finish(double time) { end("finished", time); }
  void leave(double time) { end("left", time); }

 private:
  void end(const char* what, double time);
  void append(const char* what, double seconds) const;

  std::string file_, task_;
  std::optional<double> since_;  // [s]
};

/// $XDG_DATA_HOME/presa/temple/visits.csv, or below ~/.local/share.
std::string defaultCountsFile();
/// A table of a file's days and tasks: begun, finished, left, and the median time of those finished. Lines that are not
/// understood are counted. E964: the file cannot be read.
std::string countsTable(const std::string& file, Diagnostics& diagnostics);

}  // namespace presa::temple
