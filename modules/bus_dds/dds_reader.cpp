#include <array>

#include "framework/bus/inbox.h"
#include "framework/core/schedule/clock.h"
#include "modules/bus_dds/convert.h"
#include "modules/bus_dds/dds_bus.h"
#include "modules/bus_dds/participant.h"

namespace presa::bus_dds {
namespace {

constexpr std::size_t kRoom = 65536;  // capacity in unread samples: 2.7 s of 120 objects at 200 Hz
constexpr std::uint32_t kAtOnce = 256;

/// Moves arrived samples from the data reader to the inbox, on Cyclone's threads as soon as they arrive. This keeps
/// Cyclone's own cache empty, which would overwrite unread samples of a key without counting them.
template <class Topic>
void collect(dds_entity_t reader, void* inbox) {
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos;
  for (;;) {
    samples[0] = nullptr;  // ask Cyclone to lend its own memory
    const dds_return_t count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) return;
    const std::int64_t now = monotonicNs();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (!infos[i].valid_data) continue;
      static_cast<bus::Inbox*>(inbox)->put(fromTopic(*static_cast<const Topic*>(samples[i])), now);
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

class DdsReader final : public bus::Reader {
 public:
  explicit DdsReader(const BusSettings& settings) : joined_(join(settings)) {
    scenes_ = reader(joined_->scenes, sceneQos(), collect<presa_dds_SceneInfo>);
    objects_ = reader(joined_->objects, stateQos(), collect<presa_dds_ObjectState>);
    fingers_ = reader(joined_->fingers, stateQos(), collect<presa_dds_DeviceState>);
    heartbeats_ = reader(joined_->heartbeats, stateQos(), collect<presa_dds_Beat>);
    events_ = reader(joined_->events, stateQos(), collect<presa_dds_Event>);
  }

  void expectFrames() override {
    if (frames_ != 0) return;
    frames_topic_ = framesTopic(*joined_);
    frames_ = reader(frames_topic_, stateQos(), collect<presa_dds_FrameState>);
  }
  void take(bus::Listener& listener) override { inbox_.take(listener); }
  void wait(double seconds) override { inbox_.wait(seconds); }
  std::uint64_t overrun() const override { return inbox_.overrun(); }

 private:
  Entity reader(const Entity& topic, const Qos& qos, dds_on_data_available_fn arrived) {
    dds_listener_t* listener = dds_create_listener(&inbox_);
    dds_lset_data_available(listener, arrived);
    const dds_entity_t handle = dds_create_reader(joined_->participant, topic, qos.get(), listener);
    dds_delete_listener(listener);
    return checked(handle, "a reader");
  }

  std::shared_ptr<Participant> joined_;
  bus::Inbox inbox_{kRoom};  // declared before the readers, so it outlives their listeners
  Entity scenes_, objects_, fingers_, heartbeats_, events_;
  Entity frames_topic_, frames_;  // once frames are expected
};

}  // namespace

std::unique_ptr<bus::Reader> makeReader(const BusSettings& settings) { return std::make_unique<DdsReader>(settings); }

}  // namespace presa::bus_dds
