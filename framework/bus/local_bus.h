#pragma once
#include <cstddef>
#include <memory>

#include "framework/bus/guide_link.h"
#include "framework/bus/state_bus.h"

namespace presa::bus {

/// A bus within this process, for tests and for programs with their own network. Writers and readers may be on any
/// threads but the haptic one, because they share a lock. Each reader gets copies from its own queue.
class LocalBus {
 public:
  /// `capacity`: unread samples per reader; beyond it new samples are discarded and counted (Reader::overrun).
  explicit LocalBus(std::size_t capacity = 65536);
  ~LocalBus();
  std::unique_ptr<Writer> writer();
  std::unique_ptr<Reader> reader();
  std::unique_ptr<CommandPost> post();
  std::unique_ptr<Commander> commander();
  std::unique_ptr<OrderPost> orderPost();
  std::unique_ptr<OrderSender> orderSender();

 private:
  struct Hub;
  class LocalWriter;
  class LocalReader;
  class LocalPost;
  class LocalCommander;
  class LocalOrderPost;
  class LocalOrderSender;
  std::shared_ptr<Hub> hub_;
};

}  // namespace presa::bus
