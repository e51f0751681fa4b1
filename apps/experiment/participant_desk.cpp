#include "apps/experiment/participant_desk.h"

#include "apps/experiment/participant.h"

namespace presa::experiment {

void ParticipantDesk::show(const ParticipantScreen& screen) {
  if (!window_) return;
  if (page_ && page_->closed()) page_.reset();
  if (!page_) page_ = openParticipantPage();
  page_->show(screen);
}

void ParticipantDesk::tell(const std::string& moment) {
  asked_ = false;
  show(screenWith(experiment_.textFor(moment, language_)));
}

void ParticipantDesk::ask() {
  asked_ = experiment_.sees.answers;
  show(screenAfter(experiment_, language_, true));
}

char ParticipantDesk::key() {
  const char pressed = page_ ? page_->key() : 0;
  return asked_ ? pressed : 0;
}

void ParticipantDesk::leave() {
  asked_ = false;
  page_.reset();
}

}  // namespace presa::experiment
