#pragma once
#include <RunState.h>

#include "framework/bus/guide_link.h"
#include "framework/bus/samples.h"
#include "framework/bus/wall_link.h"

/// Conversions between the samples of framework/bus and the topic types. Numbers pass unchanged, to the bit.
namespace presa::bus_dds {

presa_dds_ObjectState toTopic(const bus::ObjectSample& sample) noexcept;
presa_dds_DeviceState toTopic(const bus::FingerSample& sample) noexcept;
presa_dds_FrameState toTopic(const bus::FrameSample& sample) noexcept;
presa_dds_Beat toTopic(const bus::Heartbeat& heartbeat) noexcept;
presa_dds_Event toTopic(const bus::Event& event) noexcept;
/// Parameter names longer than bus::kLongestParameter are truncated.
presa_dds_Command toTopic(const bus::Command& command) noexcept;
presa_dds_Answer toTopic(const bus::Answer& answer) noexcept;
presa_dds_Parameter toTopic(const bus::OpenParameter& parameter) noexcept;
presa_dds_WallFrame toTopic(const bus::WallFrame& frame) noexcept;
presa_dds_WallDrawn toTopic(const bus::WallDrawn& drawn) noexcept;

/// The topic points to the texts of `run`, which must outlive it, and to the vectors beside it. Not copied.
struct SceneInfoTopic {
  explicit SceneInfoTopic(const bus::RunInfo& run);
  SceneInfoTopic(const SceneInfoTopic&) = delete;
  SceneInfoTopic& operator=(const SceneInfoTopic&) = delete;
  std::vector<presa_dds_RigFrame> frames;
  std::vector<char*> places;
  presa_dds_SceneInfo topic{};
};
/// The topic's sequences point to the vectors beside it. Not copied.
struct GuideOrderTopic {
  explicit GuideOrderTopic(const bus::GuideOrder& order);
  GuideOrderTopic(const GuideOrderTopic&) = delete;
  GuideOrderTopic& operator=(const GuideOrderTopic&) = delete;
  std::vector<std::int32_t> draws;
  std::vector<presa_dds_GuideEvent> events;
  presa_dds_GuideOrder topic{};
};
struct GuideStatusTopic {
  explicit GuideStatusTopic(const bus::GuideStatus& status);
  GuideStatusTopic(const GuideStatusTopic&) = delete;
  GuideStatusTopic& operator=(const GuideStatusTopic&) = delete;
  std::vector<presa_dds_GoalStanding> goals;
  presa_dds_GuideStatus topic{};
};

bus::ObjectSample fromTopic(const presa_dds_ObjectState& sample) noexcept;
bus::FingerSample fromTopic(const presa_dds_DeviceState& sample) noexcept;
bus::FrameSample fromTopic(const presa_dds_FrameState& sample) noexcept;
bus::Heartbeat fromTopic(const presa_dds_Beat& heartbeat) noexcept;
bus::Event fromTopic(const presa_dds_Event& event) noexcept;
bus::Command fromTopic(const presa_dds_Command& command);
bus::Answer fromTopic(const presa_dds_Answer& answer) noexcept;
bus::OpenParameter fromTopic(const presa_dds_Parameter& parameter);
bus::RunInfo fromTopic(const presa_dds_SceneInfo& run);
bus::WallFrame fromTopic(const presa_dds_WallFrame& frame) noexcept;
bus::WallDrawn fromTopic(const presa_dds_WallDrawn& drawn);
bus::GuideOrder fromTopic(const presa_dds_GuideOrder& order);
bus::GuideStatus fromTopic(const presa_dds_GuideStatus& status);

}  // namespace presa::bus_dds
