#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The methods that choose the next stimulus of an experiment from the answers so far.
/// Levels are positions on the method's own axis (axis.h turns them into what the scene takes). Thread: any, one at a
/// time. No I/O; randomness comes only from the RandomStream that a method is given.
namespace presa::psychophysics {

enum class TrialKind {
  kTest,
  kCatch,       ///< a check of attention: moves no staircase, counts in no fit
  kAdjustment,  ///< `level` is where the participant starts; the answer is where he stops
};

/// One presentation, as the method asks for it.
struct Stimulus {
  double level = 0;        ///< on the method's axis; below 0: below the standard
  std::size_t trial = 0;   ///< presentations before this one, discarded ones too
  std::size_t track = 0;   ///< which staircase, or which constant level; catch trials: the one after the last
  int standard_place = 0;  ///< interval or side of the standard, 1 or 2; 0: the task has none
  TrialKind kind = TrialKind::kTest;
  bool operator==(const Stimulus&) const = default;
};

/// One answer. Each task reads one field; the others stay as they are.
struct Response {
  bool positive = false;  ///< "yes", "correct" or "greater", as the method's coding says (forced choice works it out)
  int chosen = 0;         ///< forced choice: 1 first, left, yes; 2 second, right, no
  double value = 0;       ///< adjustment: the level that was set
  bool operator==(const Response&) const = default;
};

/// One line of the log, which is all of a method's memory.
struct Trial {
  Stimulus stimulus;
  std::optional<Response> response;  ///< none: discarded (interrupted, spoilt), to be presented again
  bool operator==(const Trial&) const = default;
};

/// What positive answers mean.
enum class Coding {
  kCorrect,  ///< the function rises with the distance from the standard, |level|
  kGreater,  ///< "the comparison is greater": the function rises with the level itself
};

/// Contract: the state is a function of the definition, the stream and the log of trials, so that a method is rebuilt
/// to the bit by `replay`. `next` has no effect: asked twice, it says the same.
class Method {
 public:
  virtual ~Method() = default;

  /// The trial to present now; none when the method has finished.
  const std::optional<Stimulus>& next() const noexcept { return next_; }
  bool finished() const noexcept { return !next_; }
  /// Answers `next()`. Throws std::logic_error when finished, std::invalid_argument when the answer is none.
  void respond(const Response& response);
  /// `next()` gave no answer and is to come again: now, or later where the method has an order to spare.
  void discard();
  /// Everything presented so far, in order.
  const std::vector<Trial>& trials() const noexcept { return trials_; }

  /// The answer to `next()` that counts as positive or not: what a simulated observer gives. Not finished.
  virtual Response responseFor(bool positive) const { return {.positive = positive}; }

 protected:
  Method() = default;
  Method(const Method&) = default;
  Method(Method&&) = default;
  Method& operator=(const Method&) = default;
  Method& operator=(Method&&) = default;

  /// Last statement of each constructor.
  void start() { offer(choose()); }

 private:
  /// Fills in `trial.response->positive` where it follows from the rest.
  virtual void update(Trial& trial) = 0;
  /// The next stimulus but for its number; none: finished.
  virtual std::optional<Stimulus> choose() = 0;
  /// What follows a discarded trial; may draw.
  virtual Stimulus again(const Stimulus& discarded) { return discarded; }

  void offer(std::optional<Stimulus> stimulus);

  std::optional<Stimulus> next_;
  std::vector<Trial> trials_;
};

/// Rebuilds a fresh method from its log. Throws std::runtime_error at the first trial that the method would not have
/// presented: the log then belongs to another definition or seed. (A text log keeps a double with 17 digits.)
void replay(Method& method, std::span<const Trial> log);

/// Throws std::invalid_argument that names every mistake; nothing when there is none.
void requireNone(const std::vector<std::string>& mistakes);

}  // namespace presa::psychophysics
