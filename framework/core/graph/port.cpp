#include "framework/core/graph/port.h"

namespace presa {

OutPortBase::OutPortBase(Module& owner, std::string name, std::type_index type)
    : owner_(owner), name_(std::move(name)), type_(type) {
  owner.outputs_.push_back(this);
}

InPortBase::InPortBase(Module& owner, std::string name, std::type_index type, bool optional, WhenOld when_old,
                       double old_after)
    : owner_(owner),
      name_(std::move(name)),
      type_(type),
      optional_(optional),
      when_old_(when_old),
      old_after_(old_after) {
  owner.inputs_.push_back(this);
}

const char* toString(RateGroup group) noexcept {
  switch (group) {
    case RateGroup::kHaptic:
      return "haptic";
    case RateGroup::kCollision:
      return "collision";
    case RateGroup::kDynamics:
      return "dynamics";
    case RateGroup::kView:
      return "view";
    case RateGroup::kBus:
      return "bus";
  }
  return "?";
}

}  // namespace presa
