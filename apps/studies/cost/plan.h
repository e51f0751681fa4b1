#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"
#include "apps/studies/cost/study.h"

namespace presa::cost {

using cluster::Shard;

/// The command line's request.
struct Request {
  std::string input{};  ///< a scene, or a study file
  std::string rig{};
  std::vector<std::string> sets{}, factors{}, metrics{};
  std::string out{};       ///< folder; empty: cost_NAME
  double duration = 0;     ///< simulated [s]; 0: the study's, or to the end of the script
  std::uint64_t seed = 0;  ///< 0: the study's, or 1
  bool quick = false;
  std::optional<Shard> shard{};  ///< none: the whole study
};

/// Plans and checks the requested study; all errors go to `diagnostics` at once, and the result is unusable if there
/// are any. Runs nothing.
Study planStudy(const Request& request, Diagnostics& diagnostics);

/// Sets Study::folder, the folder of the results, from the request, the study's name and the shard.
void chooseFolder(const Request& request, Study& study);

/// Reads a study file into `study`, except the settings, and returns its factor grids.
std::vector<std::vector<Factor>> readStudyFile(const std::string& file, const Request& request, Study& study,
                                               Diagnostics& diagnostics);

/// True when the file looks like a study file by its root element.
bool isStudyFile(const std::string& file);

}  // namespace presa::cost
