#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "framework/bus/state_bus.h"
#include "framework/core/math/random.h"

namespace presa::bus {

/// TroubledReader's counterpart for commands: commands are lost, duplicated and delayed past later ones; answers are
/// lost.
class TroubledPost final : public CommandPost {
 public:
  struct Counts {
    int lost = 0, doubled = 0, held_back = 0, answers_lost = 0;
  };
  TroubledPost(std::unique_ptr<CommandPost> post, double share, std::uint64_t seed, Counts& counts)
      : post_(std::move(post)), share_(share), random_(seed, "bad network"), counts_(counts) {}
  void show(const OpenParameter& parameter) noexcept override { post_->show(parameter); }
  std::vector<Command> take() override {
    std::vector<Command> out, late;
    for (const Command& command : post_->take()) {
      if (hit(counts_.lost)) continue;
      (hit(counts_.held_back) ? late : out).push_back(command);
      if (hit(counts_.doubled)) out.push_back(command);
    }
    if (random_.uniform() < 0.2) {  // deliver the delayed commands, much later
      out.insert(out.end(), held_.begin(), held_.end());
      held_.clear();
    }
    held_.insert(held_.end(), late.begin(), late.end());
    return out;
  }
  void answer(const Answer& answer) noexcept override {
    if (!hit(counts_.answers_lost)) post_->answer(answer);
  }

 private:
  bool hit(int& count) {
    const bool hit = random_.uniform() < share_;
    count += hit;
    return hit;
  }
  std::unique_ptr<CommandPost> post_;
  double share_;
  RandomStream random_;
  Counts& counts_;
  std::vector<Command> held_;
};

}  // namespace presa::bus
