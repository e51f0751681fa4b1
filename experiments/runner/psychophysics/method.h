#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

/// Psychophysical methods: they choose the next stimulus of an experiment from the answers so far. Levels are positions
/// on the method's own axis; axis.h converts them to scene values. No I/O; randomness comes only from the RandomStream
/// given to a method. Thread: any, one at a time.
namespace presa::psychophysics {

/// What a presentation is for.
enum class TrialKind {
  kTest,
  kCatch,       ///< attention check: moves no staircase, ignored by fits
  kAdjustment,  ///< `level` is the start; the answer is the level at which the participant stops
};

/// One presentation, as requested by the method.
struct Stimulus {
  double level = 0;                   ///< on the method's axis; negative: below the standard
  std::size_t trial = 0;              ///< number of presentations before this one, discarded ones included
  std::size_t track = 0;              ///< index of the staircase or constant level; catch trials: one past the last
  int standard_place = 0;             ///< interval or side of the standard, 1 or 2; 0: no standard in this task
  TrialKind kind = TrialKind::kTest;  ///< what the answer is used for
  bool operator==(const Stimulus&) const = default;  ///< exact
};

/// One answer. Each task uses one field and ignores the others.
struct Response {
  bool positive = false;  ///< "yes", "correct" or "greater", by the method's coding; ForcedChoice derives it
  int chosen = 0;         ///< forced choice: 1 first, left, yes; 2 second, right, no
  double value = 0;       ///< adjustment: the level that was set
  bool operator==(const Response&) const = default;  ///< exact
};

/// One entry of the log. The log is the only memory of a method.
struct Trial {
  Stimulus stimulus;                              ///< as it was presented
  std::optional<Response> response;               ///< none: discarded (interrupted or spoilt), to be presented again
  bool operator==(const Trial&) const = default;  ///< exact
};

/// Meaning of a positive answer.
enum class Coding {
  kCorrect,  ///< correct; the psychometric function rises with |level|, the distance from the standard
  kGreater,  ///< "the comparison is greater"; the psychometric function rises with the level
};

/// Contract: the state is a function of the definition, the stream and the log of trials, so `replay` restores a method
/// bit-exactly. `next` is const: repeated calls return the same stimulus.
class Method {
 public:
  virtual ~Method() = default;

  /// The trial to present now; none when the method has finished.
  const std::optional<Stimulus>& next() const noexcept { return next_; }
  bool finished() const noexcept { return !next_; }  ///< next() is none
  /// Answers `next()`. Throws std::logic_error when finished, std::invalid_argument for an invalid answer.
  void respond(const Response& response);
  /// Discards `next()` without an answer. It is presented again, at once or later in the method's order.
  void discard();
  /// Everything presented so far, in order.
  const std::vector<Trial>& trials() const noexcept { return trials_; }

  /// An answer to `next()` that counts as positive or negative, for simulated observers. Precondition: not finished.
  virtual Response responseFor(bool positive) const { return {.positive = positive}; }

 protected:
  Method() = default;                          ///< finished until start()
  Method(const Method&) = default;             ///< for derived classes alone
  Method(Method&&) = default;                  ///< for derived classes alone
  Method& operator=(const Method&) = default;  ///< for derived classes alone
  Method& operator=(Method&&) = default;       ///< for derived classes alone

  /// To be called last in each derived constructor.
  void start() { offer(choose()); }

 private:
  /// Processes an answered trial; may derive `trial.response->positive`.
  virtual void update(Trial& trial) = 0;
  /// The next stimulus, its number not yet set; nullopt: finished.
  virtual std::optional<Stimulus> choose() = 0;
  /// The stimulus after a discarded trial; may draw random numbers.
  virtual Stimulus again(const Stimulus& discarded) { return discarded; }

  void offer(std::optional<Stimulus> stimulus);

  std::optional<Stimulus> next_;
  std::vector<Trial> trials_;
};

// inline, so that a method outside the tree needs no library
inline void Method::respond(const Response& response) {
  if (!next_) throw std::logic_error("an answer to a method that has finished");
  Trial trial{*next_, response};
  update(trial);
  trials_.push_back(trial);
  offer(choose());
}

inline void Method::discard() {
  if (!next_) throw std::logic_error("nothing to discard: the method has finished");
  trials_.push_back({*next_, std::nullopt});
  offer(again(*next_));
}

inline void Method::offer(std::optional<Stimulus> stimulus) {
  if (stimulus) stimulus->trial = trials_.size();
  next_ = stimulus;
}

/// Rebuilds a fresh method from its log. Throws std::runtime_error at the first trial that differs from the method's
/// own stimulus: the log then belongs to another definition or seed. (A text log needs 17 digits per double.)
void replay(Method& method, std::span<const Trial> log);

/// Throws std::invalid_argument that lists the mistakes; no effect without any.
void requireNone(const std::vector<std::string>& mistakes);

}  // namespace presa::psychophysics
