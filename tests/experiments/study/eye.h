#pragma once
#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"

namespace presa::test {

/// Lets a test see the states of a session.
class Eye final : public Module {
 public:
  Eye() : Module("eye", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  In<ObjectState> objects{*this, "object_state"};
  In<ContactExchange> contact{*this, "contact_exchange"};
};

}  // namespace presa::test
