#pragma once
#include <dds/dds.h>

#include <memory>

#include "framework/scene/scene.h"

namespace presa::bus_dds {

/// An entity of Cyclone DDS, deleted with its owner.
class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  operator dds_entity_t() const noexcept { return handle_; }

 private:
  dds_entity_t handle_ = 0;
};

/// Throws InputError E720 when `handle` is an error code.
Entity checked(dds_entity_t handle, const char* what);

/// This process on one network and domain; writers and readers share it.
struct Participant {
  Entity domain, participant;
  Entity objects, fingers, beats, events, scenes;  // topics
};

/// Throws InputError E720 when the network cannot be used, E721 when this process is in that domain on another network already.
std::shared_ptr<Participant> join(const BusSettings& settings);

/// Quality of service of state and events: reliable, the last kKept publications of each key. A lost packet is asked for again as long as
/// the writer still has it (0.16 s); a writer never waits for a reader that stands still.
struct QosDelete {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDelete>;
Qos stateQos();
/// The static part, and what commands may set: the last of each key is kept for who comes late.
Qos sceneQos();
/// Commands and answers: reliable, the last kCommandsKept; beyond that the oldest go, and are sent again by who waits for an answer.
Qos commandQos();
/// A topic in this participant, deleted with the entity. Throws InputError E720.
Entity makeTopic(const Participant& joined, const dds_topic_descriptor_t& type, const char* name);

}  // namespace presa::bus_dds
