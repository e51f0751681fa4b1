#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/definition/analysis.h"
#include "experiments/runner/definition/procedure.h"
#include "experiments/runner/definition/reaction.h"

/// An experiment as its file states it: factors, order of the trials, phases of a trial, measures. Immutable after
/// reading; SI units. Thread: any.
namespace presa::experiment {

/// Table heading of a column, "mass [kg]"; a dimensionless column shows its name only.
std::string headingOf(const std::string& name, const std::string& unit);

/// An independent variable. All of its columns change together, for example static and dynamic friction.
struct Factor {
  std::string name;
  bool between = false;  ///< between-subject: one level per subject instead of all
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> levels;  ///< for each level, one value per column
};

/// One level index per factor.
using Condition = std::vector<std::size_t>;

struct Design {
  enum class Order {
    kListed,         ///< as written: the last factor changes fastest
    kRandom,         ///< all trials of a block shuffled
    kRandomRepeats,  ///< each repeat holds every condition once, shuffled
    kLatinSquare,    ///< the subject's row of a cyclic Latin square over the conditions
    kBalancedSquare  ///< balanced Latin square: each condition follows each other one equally often [Williams 1949]
  };
  Order order = Order::kRandomRepeats;
  int repeats = 1;
  std::string block_by{};  ///< factor whose levels form blocks, one after another; the blocks follow `order` too
  bool no_immediate_repeat = false;
  int practice = 0;  ///< practice trials before trial 1, drawn from all conditions
};

/// What the participant sees in a window. Nothing that is measured, unless the experiment says so.
struct Sight {
  bool bodies = true, fingertips = true, instruction = true, question = true;
  bool answers = true;    ///< the keys that answer; they act in the window, too
  bool measured = false;  ///< forces, contact states, penetration: what an operator sees
  bool fixation = false;  ///< a cross in the middle
};

/// One state of a trial. It ends when `until` has held for `hold` seconds; the trial is aborted when `abort` holds.
struct Phase {
  enum class OnTimeout { kAbort, kNext };
  std::string name;
  std::optional<Expression> until, abort;
  double hold = 0;     ///< [s]
  double seconds = 0;  ///< longest duration [s]; with kNext the exact duration unless `until` is met earlier
  OnTimeout on_timeout = OnTimeout::kAbort;
  std::string abort_reason{};
  bool changes_friction = false;  ///< at its start, surfaces switch to their changed friction (once per trial)
  Sight sees{};
  std::optional<Expression> event_when{};  ///< condition of that switch, over the same names as `until`; none: always
};

/// Policy for a trial that was aborted.
struct Retry {
  enum class Place { kNext, kEndOfBlock };
  int attempts = 3;  ///< including the first
  Place place = Place::kEndOfBlock;
};

struct Rest {
  int every = 0;       ///< trials between two rests; 0: no rest
  double seconds = 0;  ///< shortest duration of a rest [s]
};

struct Text {
  std::string when;  ///< "start", "rest", "end" or the name of a phase
  std::string language, text;
};

/// One number per trial: an expression over its samples, its condition and earlier measures, or a reaction time.
struct Measure {
  std::string name, unit, description;
  std::optional<Expression> value;  ///< none: a reaction time
  std::vector<Aggregate> aggregates;
  std::size_t names = 0;  ///< names (of Experiment::names) it may use; its aggregates take the slots after them
  std::optional<Reaction> reaction{};
};

/// A number shown live to the operator during a trial.
struct Watch {
  std::string name, unit;
  Expression value;                ///< over samples
  std::optional<Expression> line;  ///< reference value to compare with, over the columns
  double max = 1;                  ///< upper end of the scale
};

/// An exclusion rule, stated before the run: a trial for which it holds is not valid.
struct Exclusion {
  std::optional<Expression> when;  ///< over Experiment::names
  std::string reason;
};

struct Experiment {
  std::string file, name, title, description;
  std::string scene, rig;  ///< file names
  std::string level{};     ///< level of the simulated subject, if one was requested; empty: as in the rig
  std::string model{};     ///< what moves the devices in place of a person; empty: a person. See Device::model
  std::vector<std::string> sets{};
  std::uint64_t seed = 1;
  std::vector<Factor> factors;
  std::vector<Vary> varied{};
  std::optional<Procedure> procedure{};  ///< psychophysical method that chooses the stimuli; none: factors only
  Design design;
  Retry retry;
  Rest rest;
  Sight sees{};  ///< of the phases that do not say otherwise, and between them
  std::vector<Phase> phases;
  std::vector<Text> texts;
  std::vector<Measure> measures;
  std::vector<Exclusion> exclusions;
  std::optional<Watch> watch{};
  Analysis analysis;
  bool surfaces_change = false;  ///< the scene has a material with changed friction
  SymbolTable samples;           ///< names that guards and aggregates may use at haptic rate: see sample_names.h
  SymbolTable names;  ///< per presentation: columns (factors, varied, stimulus), quality figures, measures in order
  std::string resolved_xml, scene_xml,
      rig_xml;  ///< the three documents with every default; scene and rig before any level is applied

  /// Columns of a presentation, in the order of `names`.
  std::vector<Column> columns() const;
  /// By slot of `samples`: true where a guard or measure uses it.
  std::vector<bool> askedSamples() const;
  /// True when some phase changes the friction of surfaces.
  bool changesFriction() const;
  /// Names of all phases, in order.
  std::vector<std::string> phaseNames() const;
  /// The value of a column in a condition; empty when there is no such column.
  std::string valueOf(const std::string& column, const Condition& condition) const;
  /// The scene overrides of a condition, each PATH=VALUE.
  std::vector<std::string> setsOf(const Condition& condition) const;
  /// The text in `language`; without one, the text in the first language given.
  std::string textFor(const std::string& when, const std::string& language) const;
};

}  // namespace presa::experiment
