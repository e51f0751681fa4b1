#include "framework/bus/bus_keys.h"
#include "modules/bus_dds/dds_bus.h"
#include "modules/bus_dds/participant.h"
#include "modules/bus_dds/polled_topics.h"

namespace presa::bus_dds {
namespace {

/// The two topics of a guide in a viewer; created only by an OrderPost or an OrderSender.
struct GuideTopics {
  explicit GuideTopics(const Participant& joined)
      : orders(makeTopic(joined, presa_dds_GuideOrder_desc, "presa_guide_order")),
        statuses(makeTopic(joined, presa_dds_GuideStatus_desc, "presa_guide_status")) {}
  Entity orders, statuses;
};

class DdsOrderPost final : public bus::OrderPost {
 public:
  explicit DdsOrderPost(const BusSettings& settings)
      : joined_(join(settings)),
        topics_(*joined_),
        orders_(readerOf(*joined_, topics_.orders, commandQos())),
        statuses_(writerOf(*joined_, topics_.statuses, commandQos())) {}

  void show(const bus::GuideStatus& status) noexcept override { send(statuses_, GuideStatusTopic(status).topic); }
  std::vector<bus::GuideOrder> take() override {
    std::vector<bus::GuideOrder> orders;
    takeAll<presa_dds_GuideOrder>(orders_, orders);
    return orders;
  }

 private:
  std::shared_ptr<Participant> joined_;
  GuideTopics topics_;
  Entity orders_, statuses_;
};

class DdsOrderSender final : public bus::OrderSender {
 public:
  explicit DdsOrderSender(const BusSettings& settings)
      : joined_(join(settings)),
        topics_(*joined_),
        orders_(writerOf(*joined_, topics_.orders, commandQos())),
        statuses_(readerOf(*joined_, topics_.statuses, commandQos())) {}

  void send(const bus::GuideOrder& order) noexcept override { bus_dds::send(orders_, GuideOrderTopic(order).topic); }
  std::vector<bus::GuideStatus> take() override {
    std::vector<bus::GuideStatus> statuses;
    takeAll<presa_dds_GuideStatus>(statuses_, statuses);
    return statuses;
  }

 private:
  std::shared_ptr<Participant> joined_;
  GuideTopics topics_;
  Entity orders_, statuses_;
};

}  // namespace

std::unique_ptr<bus::OrderPost> makeOrderPost(const BusSettings& settings) {
  bus::requireKeysForCommands(settings);
  return std::make_unique<DdsOrderPost>(settings);
}
std::unique_ptr<bus::OrderSender> makeOrderSender(const BusSettings& settings) {
  return std::make_unique<DdsOrderSender>(settings);
}

}  // namespace presa::bus_dds
