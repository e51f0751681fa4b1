#pragma once
#include <string>

#include "apps/common/run_result.h"

namespace presa {

/// The run in a few lines: verdict, contact points, rates, faults, paths of the files. `columns`: where sentences are
/// broken; 0: nowhere.
std::string closingText(const RunResult& result, const std::string& summary_file, const std::string& report_file,
                        bool color, std::size_t columns);

/// closingText to stdout, coloured when that is a terminal. File names may be empty.
void printClosing(const RunResult& result, const std::string& summary_file, const std::string& report_file);

}  // namespace presa
