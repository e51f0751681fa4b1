#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/experiment/export/source.h"

namespace presa::experiment {

/// The version of the BIDS specification that the layout follows: https://bids-specification.readthedocs.io
inline constexpr const char* kBidsVersion = "1.10.0";

struct BidsOptions {
  std::string license;               ///< empty: no licence given; the dataset says so
  std::vector<std::string> authors;  ///< may be empty
};

/// Called after each recording with its name; false ends the export.
using Continue = std::function<bool(const std::string&)>;

/// Writes the sessions as a raw BIDS dataset into a new folder:
///   dataset_description.json README participants.tsv .json
///   sub-S01/sub-S01_sessions.tsv .json
///   sub-S01/ses-1/sub-S01_ses-1_scans.tsv .json
///   sub-S01/ses-1/beh/…_task-NAME_beh.tsv .json                          one row for each trial run that ended
///   sub-S01/ses-1/motion/…_task-NAME_tracksys-presa_run-001_motion.tsv   one for each recording, with its .json,
///                        …_run-001_channels.tsv, …_run-001_events.tsv      its channels and phases
///   sourcedata/sub-S01/ses-1/experiment.xml scene.xml rig.xml            the versions at the start of the session
/// Returns false when `more` ended the export; no files are left then. Throws InputError E931 (a file was altered) and
/// E933 (`out` exists), the exceptions of RecordPlugin::samples, and std::system_error (disk full).
bool exportBids(const std::vector<SourceSession>& sessions, const std::string& out, const BidsOptions& options,
                const Continue& more);

}  // namespace presa::experiment
