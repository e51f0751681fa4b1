#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::experiment {

/// Names of the variables of an expression: "thumb.fn", "cube.z", "mass". The index of a name is its slot.
class SymbolTable {
 public:
  SymbolTable() = default;
  explicit SymbolTable(std::vector<std::string> names);
  /// The slot of `name`; appends the name when it is new.
  std::size_t add(const std::string& name);
  std::optional<std::size_t> find(const std::string& name) const;
  const std::vector<std::string>& all() const noexcept { return names_; }
  std::size_t size() const noexcept { return names_.size(); }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> slots_;  // a scene with many bodies has tens of thousands of names
};

/// A statistic over the samples of one phase: mean(hold, thumb.fn), first(release, index.state == 2, index.fn), …
struct Aggregate;

/// An arithmetic or logical expression over named numbers, compiled once and evaluated without allocation. True is 1,
/// false is 0; any number but 0 counts as true. Operators by rising precedence: or; and; not; < <= > >= == != (also lt
/// le gt ge eq ne, which need no escaping in XML); + -; * /; sign. Functions: abs sqrt ln exp min max hypot. Thread:
/// any.
class Expression {
 public:
  /// Nullopt with a finding at `where` on errors: E901 (syntax, with the character position) or E902 (unknown name).
  /// With `aggregates`, calls such as mean(PHASE, …) are allowed; each takes a slot after those of `names`, its
  /// arguments are over `samples`, and PHASE is one of `phases`.
  static std::optional<Expression> compile(const std::string& text, const SymbolTable& names,
                                           const SourceLocation& where, Diagnostics& diagnostics,
                                           std::vector<Aggregate>* aggregates = nullptr,
                                           const SymbolTable* samples = nullptr,
                                           const std::vector<std::string>* phases = nullptr);

  /// `values` by slot. A division by zero gives infinity or NaN. In holds() NaN is false.
  double evaluate(std::span<const double> values) const noexcept;
  bool holds(std::span<const double> values) const noexcept {
    const double value = evaluate(values);
    return value == value && value != 0;
  }

  /// Sets the entries of `slots` that this expression reads.
  void markSlots(std::vector<bool>& slots) const;

  static constexpr std::size_t kMaxDepth = 32;

 private:
  friend class ExpressionParser;
  enum class Code : std::uint8_t {
    kNumber,
    kSlot,
    kOr,
    kAnd,
    kNot,
    kLess,
    kLessEqual,
    kGreater,
    kGreaterEqual,
    kEqual,
    kNotEqual,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kNegate,
    kAbs,
    kSqrt,
    kLn,
    kExp,
    kMin,
    kMax,
    kHypot
  };
  struct Instruction {
    Code code;
    double number = 0;     // kNumber
    std::size_t slot = 0;  // kSlot
  };
  std::vector<Instruction> program_;
};

struct Aggregate {
  enum class Kind { kMean, kSd, kMin, kMax, kFirst, kLast, kSeconds, kStart };
  Kind kind = Kind::kMean;
  std::size_t phase = 0;                ///< index of the phase whose samples are used
  std::optional<Expression> condition;  ///< for kFirst, kLast and kSeconds: only samples for which it holds; none: all
  std::optional<Expression> value;      ///< none for kSeconds and kStart
};

}  // namespace presa::experiment
