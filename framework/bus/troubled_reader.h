#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "framework/bus/state_bus.h"
#include "framework/core/math/random.h"

namespace presa::bus {

/// A reader that simulates a bad network, for tests: loses, duplicates and delays samples of objects, fingers and
/// heartbeats at random, because loopback itself is reliable.
class TroubledReader final : public Reader {
 public:
  /// Fractions of samples in [0, 1]; delayed samples are delivered by the next take().
  struct Trouble {
    double lose = 0, twice = 0, hold_back = 0;
  };
  TroubledReader(std::unique_ptr<Reader> reader, Trouble trouble, std::uint64_t seed);
  ~TroubledReader() override;
  void expectFrames() override { reader_->expectFrames(); }
  void take(Listener& listener) override;
  void wait(double seconds) override { reader_->wait(seconds); }
  std::uint64_t overrun() const override { return reader_->overrun(); }
  std::uint64_t lost() const noexcept { return lost_; }
  std::uint64_t doubled() const noexcept { return doubled_; }
  std::uint64_t heldBack() const noexcept { return held_back_; }
  void change(Trouble trouble) noexcept { trouble_ = trouble; }

 private:
  class Filter;
  std::unique_ptr<Reader> reader_;
  Trouble trouble_;
  RandomStream random_;
  std::vector<std::function<void(Listener&)>> held_;
  std::uint64_t lost_ = 0, doubled_ = 0, held_back_ = 0;
};

}  // namespace presa::bus
