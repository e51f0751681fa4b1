#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "framework/session/load_world.h"

/// A study of what accuracy costs in time: one scene, many settings, each compared with a much finer reference.
namespace presa::cost {

/// A mesh with fewer triangles, to be made before the first run.
struct Decimation {
  std::string body, source, file;
  double part = 1;  ///< of the source's triangles
};

/// One value of a knob: its name and what it sets.
struct KnobValue {
  std::string name;
  std::vector<std::string> sets;  ///< PATH=VALUE
  std::vector<Decimation> meshes{};
};

struct Knob {
  std::string name;
  std::vector<KnobValue> values;
};

/// One way to run the scene.
struct Setting {
  std::string name;                                          ///< "dynamics_rate 500, coupling explicit" or "default"
  std::vector<std::pair<std::string, std::string>> choices;  ///< value of every knob of the study, in its order
  std::vector<std::string> sets;                             ///< beyond Study::inputs
  std::string impossible;                                    ///< why the scene cannot be run so; empty: it can
  std::uint64_t scene_hash = 0;                              ///< of the scene with these sets and every default
};

/// A sentence that a report ends with, written from its numbers.
struct SentenceRule {
  enum class Kind { kBelow, kHalving, kCompare, kCheapest, kFront, kFailures };
  Kind kind = Kind::kBelow;
  std::string metric{};  ///< name; empty for kFailures
  std::string knob{};    ///< of kHalving and kCompare
  std::string a{}, b{};  ///< values of the knob, of kCompare
  double limit = 0;      ///< of kBelow and kCheapest, in the metric's unit; 0: the just-noticeable difference
};

/// A stretch of a run; a time [s] or the name of a scripted phase at whose start it begins or ends. Empty: all of it.
struct Window {
  std::string from, to;
};

struct Study {
  std::string name, title, description;
  std::string file;    ///< of the study; empty: made from a scene
  std::string folder;  ///< for results, absolute
  Inputs inputs;
  double duration = 0;  ///< simulated [s]; 0: to the end of the script
  std::uint64_t seed = 1;
  int repeats = 5;  ///< timed runs of each setting
  Window compared{"", "loosen"};
  Window steady{"hold", "loosen"};
  /// What errors are measured from: finer and finer runs; the known answer of free bodies that touch nothing; or
  /// nothing, where every metric would be zero in a perfect run (a pile is chaotic: no run is its reference).
  enum class Reference { kRefined, kAnalytic, kNone };
  Reference reference_kind = Reference::kRefined;
  std::vector<std::vector<std::string>> reference;  ///< of kRefined: sets of each level, coarse to fine; at least two
  std::vector<Knob> knobs;                          ///< all that vary
  std::vector<Setting> settings;                    ///< the first is the scene as it stands
  std::vector<std::string> metrics;                 ///< names, see metrics.h
  std::vector<SentenceRule> sentences;
};

}  // namespace presa::cost
