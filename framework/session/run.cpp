#include "framework/session/run.h"

#include <stdexcept>

namespace presa {

Run::Run(Loaded loaded, RunControl& control, Session::Options options) {
  if (loaded.options.realtime) haptic_processor_.emplace();
  session_ = std::make_unique<Session>(std::move(loaded), control, std::move(options));
  executor_ = makeExecutor(this->options().realtime, session_->graph(), RateTable(world().scene.rates), control);
  executor_->recordTo(session_->schedule());
  executor_->onThread([this](RateGroup group) {
    if (haptic_processor_ && group == RateGroup::kHaptic) haptic_processor_->bindCaller();
  });
}

void Run::execute() {
  executor_->run(options().duration);
  close();
}

void Run::finish() {
  lockstep().finish();
  close();
}

void Run::close() {
  poll_();
  if (Recorder* recorder = session_->recorder()) recorder->finish();
}

void Run::onPoll(std::function<void()> poll) {
  poll_ = std::move(poll);
  executor_->onPoll([this] { poll_(); });
}

LockstepExecutor& Run::lockstep() {
  if (auto* lockstep = dynamic_cast<LockstepExecutor*>(executor_.get())) return *lockstep;
  throw std::logic_error("the run is in real time");
}

std::vector<std::string> Run::recordingFaults() const {
  const Recorder* recorder = session_->recorder();
  if (recorder == nullptr || !recorder->status().failed) return {};
  return {"the recording could not be written: " + (options().record.empty() ? options().flight : options().record)};
}

}  // namespace presa
