#include "modules/bus_dds/dds_bus.h"
#include "modules/bus_dds/polled_topics.h"

namespace presa::bus_dds {
namespace {

class DdsWallLink final : public bus::WallLink {
 public:
  explicit DdsWallLink(const BusSettings& settings)
      : joined_(join(settings)),
        frames_(makeTopic(*joined_, presa_dds_WallFrame_desc, "presa_wall_frame")),
        drawn_(makeTopic(*joined_, presa_dds_WallDrawn_desc, "presa_wall_drawn")),
        frames_in_(readerOf(*joined_, frames_, commandQos())),
        drawn_in_(readerOf(*joined_, drawn_, commandQos())),
        frames_out_(writerOf(*joined_, frames_, commandQos())),
        drawn_out_(writerOf(*joined_, drawn_, commandQos())) {}

  void send(const bus::WallFrame& frame) noexcept override { bus_dds::send(frames_out_, toTopic(frame)); }
  void send(const bus::WallDrawn& drawn) noexcept override { bus_dds::send(drawn_out_, toTopic(drawn)); }
  Arrived take() override {
    Arrived arrived;
    takeAll<presa_dds_WallFrame>(frames_in_, arrived.frames);
    takeAll<presa_dds_WallDrawn>(drawn_in_, arrived.drawn);
    return arrived;
  }

 private:
  std::shared_ptr<Participant> joined_;
  Entity frames_, drawn_;  // topics
  Entity frames_in_, drawn_in_, frames_out_, drawn_out_;
};

}  // namespace

std::unique_ptr<bus::WallLink> makeWallLink(const BusSettings& settings) {
  return std::make_unique<DdsWallLink>(settings);
}

}  // namespace presa::bus_dds
