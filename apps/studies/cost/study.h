#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "framework/session/load_world.h"

/// A study of accuracy against computing time: one scene, many settings, each compared with a much finer reference.
namespace presa::cost {

/// A decimated mesh, to be written before the first run.
struct Decimation {
  std::string body, source, file;
  double part = 1;  ///< fraction of the source's triangles
};

/// One value of a factor: its name and the overrides that it sets.
struct FactorValue {
  std::string name;
  std::vector<std::string> sets;  ///< PATH=VALUE
  std::vector<Decimation> meshes{};
};

/// Which values of a number are more accurate: none are known to be, the larger ones, the smaller ones.
enum class Direction { kNone, kUp, kDown };

struct Factor {
  std::string name;
  std::vector<FactorValue> values;
  Direction finer = Direction::kNone;
};

/// One combination of factor values for the scene.
struct Setting {
  std::string name;                                          ///< "dynamics_rate 500, coupling explicit", or "default"
  std::vector<std::pair<std::string, std::string>> choices;  ///< value of every factor, in the study's order
  std::vector<std::string> sets;                             ///< overrides in addition to those of Study::inputs
  std::string impossible;                                    ///< why the scene rejects this setting; empty: it does not
  std::uint64_t scene_hash = 0;                              ///< hash of the scene with these sets and all defaults
};

/// Rule for a sentence at the end of the report, made from its numbers.
struct SentenceRule {
  enum class Kind { kBelow, kHalving, kCompare, kCheapest, kFront, kOrder, kFailures };
  Kind kind = Kind::kBelow;
  std::string metric{};  ///< name; empty for kFailures
  std::string factor{};  ///< for kHalving, kCompare and kOrder
  std::string a{}, b{};  ///< for kCompare: values of the factor
  double limit = 0;      ///< for kBelow and kCheapest, in the metric's unit; 0: the just-noticeable difference
};

/// Time window of a run. Each bound is a time [s], or the intent or the name of a scripted phase, whose start is meant.
/// Empty, or a phase that the motion lacks: unbounded.
struct Window {
  std::string from, to;
};

struct Study {
  std::string name, title, description;
  std::string file;    ///< the study file; empty: a sweep of a scene
  std::string folder;  ///< folder for results, absolute path
  Inputs inputs;
  double duration = 0;    ///< simulated [s]; 0: to the end of the script
  double disk_bytes = 0;  ///< that its runs will take in the folder, about
  std::uint64_t seed = 1;
  int repeats = 5;  ///< timed runs of each setting
  Window compared{"", "release"};
  Window steady{"hold", "release"};
  /// The reference of the errors. kRefined: a sequence of finer runs; kAnalytic: the analytic motion of free bodies
  /// without contact; kNone: only metrics that are zero in a perfect run (a pile is chaotic: no run can be its
  /// reference).
  enum class Reference { kRefined, kAnalytic, kNone };
  Reference reference_kind = Reference::kRefined;
  std::vector<std::vector<std::string>> reference;  ///< for kRefined: sets of each level, coarse to fine; at least two
  /// For each knob of the renderers that the levels refine: its sets, coarse to fine. The last ones belong to the levels
  /// in turn; those before are the study's own values, for a level that cannot be run, for want of memory.
  std::vector<std::vector<std::string>> finer;
  std::vector<Factor> factors;       ///< all factors that vary
  std::vector<Setting> settings;     ///< the first is the unmodified scene
  std::vector<std::string> metrics;  ///< names, see metrics.h
  std::vector<SentenceRule> sentences;
};

}  // namespace presa::cost
