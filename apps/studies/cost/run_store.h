#pragma once
#include <string>

#include "apps/studies/cost/evidence.h"
#include "apps/studies/cost/study.h"

namespace presa::cost {

/// Stores the runs of a study on disk, so that an interrupted study can continue. Files are written atomically and
/// named by a hash of everything that determines the run's result.
class RunStore {
 public:
  /// `common`: hash of the inputs shared by all runs (rig, motions, seed, duration, version).
  RunStore(std::string folder, std::uint64_t common) : folder_(std::move(folder)), common_(common) {}

  bool hasEvidence(std::uint64_t scene_hash) const;
  bool hasTiming(std::uint64_t scene_hash, int repeat) const;
  void save(std::uint64_t scene_hash, const Evidence& evidence) const;
  void save(std::uint64_t scene_hash, int repeat, const Timing& timing) const;
  Evidence evidence(std::uint64_t scene_hash, bool with_trace) const;
  Timing timing(std::uint64_t scene_hash, int repeat) const;
  void dropTraces(int workers) const;  ///< in processes of their own: a study of many settings has gigabytes

 private:
  std::string base(std::uint64_t scene_hash) const;
  std::string folder_;
  std::uint64_t common_;
};

}  // namespace presa::cost
