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

/// Numbers that change in time, known to expressions by name: "thumb.fn", "cube.z", "mass". The index is the slot.
class Names {
 public:
  Names() = default;
  explicit Names(std::vector<std::string> names);
  /// The slot of `name`, taken anew when it is not known.
  std::size_t add(const std::string& name);
  std::optional<std::size_t> find(const std::string& name) const;
  const std::vector<std::string>& all() const noexcept { return names_; }
  std::size_t size() const noexcept { return names_.size(); }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> slots_;  // a crowd of bodies has tens of thousands of names
};

/// What a trial's samples come to: mean(hold, thumb.fn), first(release, index.state == 2, index.fn), …
struct Aggregate;

/// An arithmetic or logical expression over named numbers, compiled once, evaluated without allocation. True is 1, false 0; any
/// number but 0 is true. Operators by rising strength: or; and; not; < <= > >= == != (also lt le gt ge eq ne, which XML
/// need not escape); + -; * /; sign. Functions: abs sqrt ln exp min max hypot. Thread: any.
class Expression {
 public:
  /// Null with a finding at `where` (E901: column of the text, what stood there, what is allowed; E902: unknown name).
  /// With `aggregates`: calls such as mean(PHASE, …) are allowed too; each takes a slot after those of `names`.
  static std::optional<Expression> compile(const std::string& text, const Names& names, const SourceLocation& where,
                                           Diagnostics& diagnostics, std::vector<Aggregate>* aggregates = nullptr,
                                           const Names* samples = nullptr,
                                           const std::vector<std::string>* phases = nullptr);

  /// `values` by slot. A division by zero gives infinity or NaN; NaN and a comparison with it are false.
  double evaluate(std::span<const double> values) const noexcept;
  bool holds(std::span<const double> values) const noexcept {
    const double value = evaluate(values);
    return value == value && value != 0;
  }

  /// Sets those of `slots` that it reads.
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
  enum class Kind { kMean, kSd, kLeast, kMost, kFirst, kLast, kSeconds, kStart };
  Kind kind = Kind::kMean;
  std::size_t phase = 0;                ///< index of the phase whose samples count
  std::optional<Expression> condition;  ///< of kFirst, kLast and kSeconds: samples for which it holds; null: all
  std::optional<Expression> value;      ///< null for kSeconds and kStart
};

}  // namespace presa::experiment
