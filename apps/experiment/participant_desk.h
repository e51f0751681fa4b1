#pragma once
#include <memory>
#include <string>

#include "experiments/runner/definition/definition.h"
#include "framework/session/participant_page.h"

namespace presa::experiment {

/// The participant's window between the runs of a session: what they are told before the first trial and in a rest, and
/// what they are asked after a trial. Does nothing in a session without a window. Thread: main, while nothing runs.
class ParticipantDesk {
 public:
  /// `experiment` must outlive the desk.
  ParticipantDesk(const Experiment& experiment, std::string language, bool window)
      : experiment_(experiment), language_(std::move(language)), window_(window) {}

  /// Shows the experiment's text for "start" or "rest", if it has one.
  void tell(const std::string& moment);
  /// Shows question and answers.
  void ask();
  /// The next key that answers, if the experiment shows answers and has asked; 0: none. Call it often while people
  /// wait.
  char key();
  /// Gives the window to the run that comes next.
  void leave();

 private:
  void show(const ParticipantScreen& screen);

  const Experiment& experiment_;
  std::string language_;
  bool window_;
  bool asked_ = false;
  std::unique_ptr<ParticipantPage> page_;
};

}  // namespace presa::experiment
