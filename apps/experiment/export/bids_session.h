#pragma once
#include <ctime>

#include "apps/experiment/export/bids.h"
#include "apps/experiment/export/motion.h"
#include "apps/experiment/export/staging.h"

namespace presa::experiment {

/// A table of text cells in the format of BIDS: tab-separated, with a header, "n/a" for a missing value.
class Tsv {
 public:
  explicit Tsv(const std::vector<std::string>& header) { add(header); }
  void add(const std::vector<std::string>& cells);
  const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

/// Time of a log record [s since 1970]. Exports shift dates for privacy: the participant's first session falls into
/// 1900.
std::time_t instantOf(const std::string& utc);
std::string shifted(const std::string& utc, std::time_t zero);

/// Files of one session below sub-ID/ses-N and sourcedata.
class BidsSession {
 public:
  BidsSession(const SourceSession& source, std::time_t zero, const StagedFolder& out);
  /// Returns false when `more` ended the export.
  bool write(const Continue& more);
  /// The experiment's name as a BIDS label: letters and digits only.
  static std::string labelOf(const std::string& name);

 private:
  bool writeRun(std::size_t run, Tsv& beh, const Continue& more);
  void writeRecording(const LoggedRun& run, const std::string& file, std::size_t presentation);
  void writeMotion(const std::string& base, const Motion& motion, const LoggedRun& run) const;
  void writeEvents(const std::string& base, const Motion& motion, const LoggedRun& run, std::size_t presentation) const;
  void writeDictionaries() const;
  void writeSourceData() const;
  Json taskJson() const;
  std::vector<std::string> behaviourHeader() const;
  void scanned(const std::string& file, const std::string& utc);

  const SourceSession& source_;
  const std::time_t zero_;
  const StagedFolder& out_;
  const std::string folder_, prefix_;  // sub-S01/ses-1/, sub-S01_ses-1_task-NAME
  Tsv scans_{{"filename", "acq_time"}};
  int recordings_ = 0;
};

}  // namespace presa::experiment
