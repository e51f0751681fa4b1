#pragma once
#include <string>

#include "apps/studies/cost/evidence.h"
#include "apps/studies/cost/study.h"

namespace presa::cost {

/// The runs of a study on disk, so that an interrupted one goes on. Every file appears whole or not at all; its name is
/// a hash of all that decides the run's result.
class RunStore {
 public:
  /// `common`: what all runs share (rig, motions, seed, duration, version).
  RunStore(std::string folder, std::uint64_t common) : folder_(std::move(folder)), common_(common) {}

  bool hasEvidence(std::uint64_t scene_hash) const;
  bool hasTiming(std::uint64_t scene_hash, int repeat) const;
  void save(std::uint64_t scene_hash, const Evidence& evidence) const;
  void save(std::uint64_t scene_hash, int repeat, const Timing& timing) const;
  Evidence evidence(std::uint64_t scene_hash, bool with_trace) const;
  Timing timing(std::uint64_t scene_hash, int repeat) const;
  void dropTraces() const;

 private:
  std::string base(std::uint64_t scene_hash) const;
  std::string folder_;
  std::uint64_t common_;
};

}  // namespace presa::cost
