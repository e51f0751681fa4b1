#include "framework/bus/parameter_server.h"

#include <algorithm>
#include <cmath>

namespace presa::bus {

ParameterServer::ParameterServer(const Scene& scene, Open open) : open_(std::move(open)) {
  const std::vector<OpenSurface> surfaces = openSurfaces(scene);
  for (const OpenSurface& surface : surfaces)
    surface_values_.push_back(scene.materials[surface.material].*surface.value);
  for (std::size_t slot = 0; slot < surfaces.size(); ++slot) offerSurface(surfaces, slot);
}

// The coefficients of a material bound each other: static friction is never below dynamic friction.
void ParameterServer::offerSurface(const std::vector<OpenSurface>& open, std::size_t slot) {
  const OpenSurface& surface = open[slot];
  const auto slotOf = [&](double Material::*value) {
    const auto found = std::find_if(open.begin(), open.end(), [&](const OpenSurface& other) {
      return other.material == surface.material && other.value == value;
    });
    return static_cast<std::size_t>(found - open.begin());
  };
  Offer offer{.name = surface.name,
              .value = [this, slot] { return surface_values_[slot]; },
              .min = [min = surface.min] { return min; },
              .max = [max = surface.max] { return max; },
              .set =
                  [this, slot](double value) {
                    surface_values_[slot] = value;
                    surfaces_.slots[slot] = {++surfaces_.newest, value};
                  }};
  if (surface.value == &Material::friction_static) {
    if (const std::size_t other = slotOf(&Material::friction_dynamic); other < open.size())
      offer.min = [this, other] { return surface_values_[other]; };
  } else if (surface.value == &Material::friction_dynamic) {
    const std::size_t other = slotOf(&Material::friction_static);
    offer.max = [this, other, max = surface.max] { return std::min(max, surface_values_[other]); };
  }
  offers_.push_back(std::move(offer));
}

void ParameterServer::start(std::uint64_t run) {
  run_ = run;
  post_ = open_();
  shown_.clear();
  showChanged();
}

void ParameterServer::serve(double time) noexcept {
  if (!post_) return;
  const std::vector<Command> commands = post_->take();
  for (const Command& command : commands) {
    if (command.run == run_) post_->answer(judge(command, time));
  }
  showChanged();
}

Answer ParameterServer::judge(const Command& command, double time) {
  const auto known = std::find_if(judged_.begin(), judged_.end(), [&](const Judged& judged) {
    return judged.sender == command.sender && judged.parameter == command.parameter;
  });
  if (known != judged_.end() && command.number == known->answer.number) return known->answer;
  // a number far ahead of this sender's last one is forged or damaged: it has no effect, not even on the order of later
  // ones
  std::uint64_t reached = 0;
  for (const Judged& judged : judged_)
    if (judged.sender == command.sender) reached = std::max(reached, judged.answer.number);
  if (command.number > reached && command.number - reached > kFarthest) {
    Answer answer{command.run, command.sender, command.number, Answer::Verdict::kOutOfOrder};
    if (known != judged_.end()) answer.value = known->answer.value;
    return answer;
  }
  if (known != judged_.end() && command.number < known->answer.number) {
    Answer answer = known->answer;
    answer.number = command.number;
    answer.verdict = Answer::Verdict::kOvertaken;
    return answer;
  }
  const Answer answer = decide(command, time);
  if (answer.verdict == Answer::Verdict::kUnknown) return answer;  // not remembered: repeating it gives the same answer
  if (known != judged_.end())
    judged_.erase(known);
  else if (judged_.size() == kRemembered)
    judged_.erase(judged_.begin());
  judged_.push_back({command.sender, command.parameter, answer});
  return answer;
}

Answer ParameterServer::decide(const Command& command, double time) {
  Answer answer{command.run, command.sender, command.number};
  const auto offer =
      std::find_if(offers_.begin(), offers_.end(), [&](const Offer& open) { return open.name == command.parameter; });
  if (offer == offers_.end()) {
    answer.verdict = Answer::Verdict::kUnknown;
    return answer;
  }
  answer.min = offer->min();
  answer.max = offer->max();
  if (!std::isfinite(command.value)) {
    answer.verdict = Answer::Verdict::kNotANumber;
  } else if (command.value < answer.min || command.value > answer.max) {
    answer.verdict = Answer::Verdict::kOutOfRange;
  } else {
    offer->set(command.value);
    if (done_.size() < kKept) done_.push_back({time, command.parameter, command.value});
    ++done_count_;
  }
  answer.value = offer->value();
  return answer;
}

void ParameterServer::showChanged() {
  shown_.resize(offers_.size());
  for (std::size_t i = 0; i < offers_.size(); ++i) {
    const Offer& offer = offers_[i];
    OpenParameter now{run_,        offer.name,  offer.value(),
                      offer.min(), offer.max(), static_cast<std::int32_t>(offers_.size())};
    OpenParameter& shown = shown_[i];
    if (shown.run == run_ && shown.value == now.value && shown.min == now.min && shown.max == now.max) continue;
    post_->show(now);
    shown = std::move(now);
  }
}

}  // namespace presa::bus
