#include <algorithm>

#include "framework/core/schedule/clock.h"
#include "modules/bus_dds/convert.h"
#include "modules/bus_dds/dds_bus.h"
#include "modules/bus_dds/participant.h"

namespace presa::bus_dds {
namespace {

constexpr dds_duration_t kPatience = DDS_MSECS(500);  // maximum wait for confirmations at the end

/// Writes each publication as a batch, so that it takes as few packets as possible.
class DdsWriter final : public bus::Writer {
 public:
  explicit DdsWriter(const BusSettings& settings) : joined_(join(settings)) {
    dds_write_set_batch(true);
    objects_ = writer(joined_->objects, stateQos());
    fingers_ = writer(joined_->fingers, stateQos());
    heartbeats_ = writer(joined_->heartbeats, stateQos());
    events_ = writer(joined_->events, stateQos());
    scenes_ = writer(joined_->scenes, sceneQos());
  }

  void announce(const bus::RunInfo& run) override {
    if (!run.frames.empty() && frames_ == 0) {
      frames_topic_ = framesTopic(*joined_);
      frames_ = writer(frames_topic_, stateQos());
    }
    const SceneInfoTopic info(run);
    dds_write(scenes_, &info.topic);
    dds_write_flush(scenes_);
  }

  std::uint64_t publish(const bus::Snapshot& snapshot) noexcept override {
    std::uint64_t refused = 0;
    for (const bus::ObjectSample& sample : snapshot.objects) refused += write(objects_, toTopic(sample));
    dds_write_flush(objects_);
    for (const bus::FingerSample& sample : snapshot.fingers) refused += write(fingers_, toTopic(sample));
    dds_write_flush(fingers_);
    for (const bus::FrameSample& sample : snapshot.frames) refused += write(frames_, toTopic(sample));
    if (frames_ != 0) dds_write_flush(frames_);
    refused += write(heartbeats_, toTopic(snapshot.heartbeat));
    dds_write_flush(heartbeats_);
    return refused;
  }

  void publish(const bus::Event& event) noexcept override {
    write(events_, toTopic(event));
    dds_write_flush(events_);
  }

  void finish() noexcept override {
    const dds_time_t end = monotonicNs() + kPatience;
    for (const Entity* writer : {&objects_, &fingers_, &frames_, &heartbeats_, &events_})
      if (*writer != 0) dds_wait_for_acks(*writer, std::max<dds_duration_t>(0, end - monotonicNs()));
  }

 private:
  Entity writer(const Entity& topic, const Qos& qos) const {
    return checked(dds_create_writer(joined_->participant, topic, qos.get(), nullptr), "a writer");
  }
  template <class Topic>
  static std::uint64_t write(const Entity& writer, const Topic& sample) noexcept {
    return dds_write(writer, &sample) == DDS_RETCODE_OK ? 0 : 1;
  }

  std::shared_ptr<Participant> joined_;
  Entity objects_, fingers_, heartbeats_, events_, scenes_;
  Entity frames_topic_, frames_;  // only of a run whose rig has frames
};

}  // namespace

std::unique_ptr<bus::Writer> makeWriter(const BusSettings& settings) { return std::make_unique<DdsWriter>(settings); }

}  // namespace presa::bus_dds
