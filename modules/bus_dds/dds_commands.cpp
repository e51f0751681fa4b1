#include "framework/bus/bus_keys.h"
#include "modules/bus_dds/convert.h"
#include "modules/bus_dds/dds_bus.h"
#include "modules/bus_dds/participant.h"
#include "modules/bus_dds/polled_topics.h"

namespace presa::bus_dds {
namespace {

/// The three topics of commands; created only by a CommandPost or a Commander.
struct Topics {
  explicit Topics(const Participant& joined)
      : commands(makeTopic(joined, presa_dds_Command_desc, "presa_command")),
        answers(makeTopic(joined, presa_dds_Answer_desc, "presa_answer")),
        parameters(makeTopic(joined, presa_dds_Parameter_desc, "presa_parameter")) {}
  Entity commands, answers, parameters;
};

class DdsPost final : public bus::CommandPost {
 public:
  explicit DdsPost(const BusSettings& settings)
      : joined_(join(settings)),
        topics_(*joined_),
        commands_(readerOf(*joined_, topics_.commands, commandQos())),
        answers_(writerOf(*joined_, topics_.answers, commandQos())),
        parameters_(writerOf(*joined_, topics_.parameters, sceneQos())) {}

  void show(const bus::OpenParameter& parameter) noexcept override { send(parameters_, toTopic(parameter)); }
  std::vector<bus::Command> take() override {
    std::vector<bus::Command> commands;
    takeAll<presa_dds_Command>(commands_, commands);
    return commands;
  }
  void answer(const bus::Answer& answer) noexcept override { send(answers_, toTopic(answer)); }

 private:
  std::shared_ptr<Participant> joined_;
  Topics topics_;
  Entity commands_, answers_, parameters_;
};

class DdsCommander final : public bus::Commander {
 public:
  explicit DdsCommander(const BusSettings& settings)
      : joined_(join(settings)),
        topics_(*joined_),
        commands_(writerOf(*joined_, topics_.commands, commandQos())),
        answers_(readerOf(*joined_, topics_.answers, commandQos())),
        parameters_(readerOf(*joined_, topics_.parameters, sceneQos())) {}

  void send(const bus::Command& command) override { bus_dds::send(commands_, toTopic(command)); }
  Replies take() override {
    Replies replies;
    takeAll<presa_dds_Parameter>(parameters_, replies.parameters);
    takeAll<presa_dds_Answer>(answers_, replies.answers);
    return replies;
  }

 private:
  std::shared_ptr<Participant> joined_;
  Topics topics_;
  Entity commands_, answers_, parameters_;
};

}  // namespace

std::unique_ptr<bus::CommandPost> makePost(const BusSettings& settings) {
  bus::requireKeysForCommands(settings);
  return std::make_unique<DdsPost>(settings);
}
std::unique_ptr<bus::Commander> makeCommander(const BusSettings& settings) {
  return std::make_unique<DdsCommander>(settings);
}

}  // namespace presa::bus_dds
