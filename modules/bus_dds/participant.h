#pragma once
#include <dds/dds.h>

#include <memory>

#include "framework/scene/scene.h"

namespace presa::bus_dds {

/// Owning handle of a Cyclone DDS entity.
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

/// This process on one network and domain, shared by its writers and readers.
struct Participant {
  Entity domain, participant;
  Entity objects, fingers, heartbeats, events, scenes;  // topics
};

/// Throws InputError E720 when the network cannot be used, E721 when this process already uses the domain on another
/// network or with other keys.
std::shared_ptr<Participant> join(const BusSettings& settings);

/// Quality of service of state and events: reliable, with the last kKept publications of each key. A lost packet is
/// requested again while the writer still has it (0.16 s); a writer never waits for a stopped reader.
struct QosDelete {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDelete>;
Qos stateQos();
/// Run information and open parameters: the last sample of each key is kept for late readers.
Qos sceneQos();
/// Commands and answers: reliable, the last kCommandsKept. Older ones are discarded; the sender repeats a command until
/// it is answered.
Qos commandQos();
/// The frames of a rig have a topic only where a run has some.
Entity framesTopic(const Participant& joined);
/// A topic of this participant, deleted with the returned entity. Throws InputError E720.
Entity makeTopic(const Participant& joined, const dds_topic_descriptor_t& type, const char* name);

}  // namespace presa::bus_dds
