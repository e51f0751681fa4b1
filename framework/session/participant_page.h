#pragma once
#include <memory>

#include "framework/scene/participant_screen.h"

namespace presa {

/// The window of an experiment's participant while nothing runs: black, with a text. The runs of this process draw into
/// the same window (RunOptions::participant), so a page must be gone before a run starts; the window stays open. Thread:
/// the one that opened it.
class ParticipantPage {
 public:
  virtual ~ParticipantPage() = default;
  /// Bodies and fingertips are not drawn: nothing runs. Keys pressed before are dropped.
  virtual void show(const ParticipantScreen& screen) = 0;
  /// The next key pressed, as a terminal would send it; 0: none. Call it often: it also answers the window system.
  virtual char key() = 0;
  /// Whether the participant has closed the window.
  virtual bool closed() const = 0;
};

/// Throws InputError: E590 no view in this installation, E703 no display.
std::unique_ptr<ParticipantPage> openParticipantPage();

}  // namespace presa
