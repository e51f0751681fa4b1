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
  static constexpr const char* kNames[kRateGroupCount] = {"haptic", "collision", "dynamics", "view", "bus"};
  const auto index = static_cast<std::size_t>(group);
  return index < kRateGroupCount ? kNames[index] : "?";
}

}  // namespace presa
