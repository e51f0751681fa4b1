#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/definition/analysis.h"
#include "experiments/runner/definition/procedure.h"
#include "experiments/runner/definition/reaction.h"

/// An experiment as its file states it: what varies, in which order, what a trial consists of, what is measured. Immutable
/// after reading; SI units. Thread: any.
namespace presa::experiment {

/// "mass [kg]": how a table heads a column; a plain number has no unit.
std::string headingOf(const std::string& name, const std::string& unit);

/// What is varied on purpose. Its columns change together: static with dynamic friction.
struct Factor {
  std::string name;
  bool between = false;  ///< one level per subject instead of all
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> levels;  ///< a value for each column
};

/// One level of every factor, by index; also the row of a trial.
using Condition = std::vector<std::size_t>;

struct Design {
  enum class Order {
    kListed,         ///< as written: the last factor changes fastest
    kRandom,         ///< all trials of a block shuffled
    kRandomRepeats,  ///< each repeat holds every condition once, shuffled
    kLatinSquare,    ///< the subject's row of a cyclic square over the conditions
    kBalancedSquare  ///< the same, each condition after each other one equally often [Williams 1949]
  };
  Order order = Order::kRandomRepeats;
  int repeats = 1;
  std::string block_by{};  ///< factor whose levels are run one after another; their order follows `order` too
  bool no_immediate_repeat = false;
  int practice = 0;  ///< trials before the first, drawn from all conditions
};

/// One state of a trial. It ends when `until` has held for `hold` seconds; is aborted when `abort` holds.
struct Phase {
  enum class OnTimeout { kAbort, kNext };
  std::string name;
  std::optional<Expression> until, abort;
  double hold = 0;     ///< [s]
  double seconds = 0;  ///< longest [s], with kNext its duration
  OnTimeout on_timeout = OnTimeout::kAbort;
  std::string abort_reason{};
  bool changes_friction = false;           ///< when it begins, surfaces take on their changed friction; once in a trial
  std::optional<Expression> event_when{};  ///< over the same names as `until`; without it: always
};

/// What to do with a trial that was aborted.
struct Retry {
  enum class Place { kNext, kEndOfBlock };
  int attempts = 3;  ///< in all
  Place place = Place::kEndOfBlock;
};

struct Rest {
  int every = 0;       ///< trials; 0: none
  double seconds = 0;  ///< at least [s]
};

struct Text {
  std::string when;  ///< "start", "rest", "end" or the name of a phase
  std::string language, text;
};

/// One number per trial, from its samples, its condition and the measures above it; or the time of a reaction.
struct Measure {
  std::string name, unit, description;
  std::optional<Expression> value;  ///< none: a reaction
  std::vector<Aggregate> aggregates;
  std::size_t names = 0;  ///< how many of Experiment::names it may see; its aggregates take the slots after them
  std::optional<Reaction> reaction{};
};

/// The number that the operator watches while a trial goes on.
struct Watch {
  std::string name, unit;
  Expression value;                ///< over samples
  std::optional<Expression> line;  ///< over the columns: what the value is to be compared with
  double most = 1;                 ///< end of the scale
};

/// A rule written before the run: a trial for which it holds does not count.
struct Exclusion {
  std::optional<Expression> when;  ///< over Experiment::names
  std::string reason;
};

struct Experiment {
  std::string file, name, title, description;
  std::string scene, rig;  ///< files
  std::string level{};     ///< of the simulated subject, where it was asked for one; empty: as the rig says
  std::string model{};     ///< what holds the rig's devices, if no person does: see Device::model
  std::vector<std::string> sets{};
  std::uint64_t seed = 1;
  std::vector<Factor> factors;
  std::vector<Vary> varied{};
  std::optional<Procedure> procedure{};  ///< a method that chooses the stimuli; none: the factors alone
  Design design;
  Retry retry;
  Rest rest;
  std::vector<Phase> phases;
  std::vector<Text> texts;
  std::vector<Measure> measures;
  std::vector<Exclusion> exclusions;
  std::optional<Watch> watch{};
  Analysis analysis;
  bool surfaces_change = false;  ///< the scene has friction to change to
  Names samples;                 ///< what a phase can ask at haptic rate: see sample_names.h
  Names names;  ///< of a presentation: columns (factors, varied, stimulus), quality figures, measures in order
  std::string resolved_xml, scene_xml,
      rig_xml;  ///< the three documents with every default, scene and rig before any level

  /// Columns of a presentation, in the order of `names`.
  std::vector<Column> columns() const;
  /// By slot of `samples`: what guards and measures ask for.
  std::vector<bool> askedSamples() const;
  /// A phase changes the friction of surfaces.
  bool changesFriction() const;
  /// Names of all phases, in order.
  std::vector<std::string> phaseNames() const;
  /// The value of a column in a condition; empty when there is no such column.
  std::string valueOf(const std::string& column, const Condition& condition) const;
  /// PATH=VALUE for the scene of a condition.
  std::vector<std::string> setsOf(const Condition& condition) const;
  /// The text in `language`, else in the first language there is.
  std::string textFor(const std::string& when, const std::string& language) const;
};

}  // namespace presa::experiment
