#pragma once
#include <cstddef>
#include <memory>

#include "framework/bus/state_bus.h"

namespace presa::bus {

/// A bus within this process, for tests and for whoever brings a network of his own. Writers and readers may be on any threads; they
/// share one lock, so none of them belongs on the haptic thread. Readers get copies, each from a queue of its own.
class LocalBus {
 public:
  /// `capacity`: samples that a reader may leave lying; beyond that the newest are thrown away and counted (Reader::overrun).
  explicit LocalBus(std::size_t capacity = 65536);
  ~LocalBus();
  std::unique_ptr<Writer> writer();
  std::unique_ptr<Reader> reader();
  std::unique_ptr<CommandPost> post();
  std::unique_ptr<Commander> commander();

 private:
  struct Hub;
  class LocalWriter;
  class LocalReader;
  class LocalPost;
  class LocalCommander;
  std::shared_ptr<Hub> hub_;
};

}  // namespace presa::bus
