#include "framework/bus/troubled_reader.h"

#include <utility>

namespace presa::bus {

class TroubledReader::Filter final : public Listener {
 public:
  Filter(TroubledReader& owner, Listener& listener) : owner_(owner), listener_(listener) {}
  void onRun(const RunInfo& run, std::int64_t at) override { listener_.onRun(run, at); }
  void onEvent(const Event& event, std::int64_t at) override { listener_.onEvent(event, at); }
  void onObject(const ObjectSample& sample, std::int64_t at) override {
    pass([=](Listener& to) { to.onObject(sample, at); });
  }
  void onFinger(const FingerSample& sample, std::int64_t at) override {
    pass([=](Listener& to) { to.onFinger(sample, at); });
  }
  void onFrame(const FrameSample& sample, std::int64_t at) override {
    pass([=](Listener& to) { to.onFrame(sample, at); });
  }
  void onHeartbeat(const Heartbeat& heartbeat, std::int64_t at) override {
    pass([=](Listener& to) { to.onHeartbeat(heartbeat, at); });
  }

 private:
  void pass(std::function<void(Listener&)> tell) {
    const Trouble& trouble = owner_.trouble_;
    if (owner_.random_.uniform() < trouble.lose) {
      ++owner_.lost_;
      return;
    }
    if (owner_.random_.uniform() < trouble.hold_back) {
      ++owner_.held_back_;
      owner_.held_.push_back(std::move(tell));
      return;
    }
    tell(listener_);
    if (owner_.random_.uniform() >= trouble.twice) return;
    ++owner_.doubled_;
    tell(listener_);
  }

  TroubledReader& owner_;
  Listener& listener_;
};

TroubledReader::TroubledReader(std::unique_ptr<Reader> reader, Trouble trouble, std::uint64_t seed)
    : reader_(std::move(reader)), trouble_(trouble), random_(seed, "bad network") {}
TroubledReader::~TroubledReader() = default;

void TroubledReader::take(Listener& listener) {
  const auto held = std::exchange(held_, {});
  Filter filter(*this, listener);
  reader_->take(filter);
  for (const auto& tell : held) tell(listener);  // delivered after later samples
}

}  // namespace presa::bus
