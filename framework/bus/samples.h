#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/scene/frame_state.h"

/// The messages on the bus. They carry whole states and values, never differences, so that any message may be lost,
/// duplicated or late. SI units, world frame.
namespace presa::bus {

/// Header of every sample. All samples of one publication share it.
struct Stamp {
  std::uint64_t run = 0;       ///< id of the run, never 0
  std::uint64_t sequence = 0;  ///< number of the publication in the run, from 1
  double time = 0;             ///< simulated time for which the sample is valid [s]
  std::int64_t sent_ns = 0;    ///< CLOCK_MONOTONIC of the sender; comparable only on the same machine
};

/// One free body at Stamp::time. Key: body.
struct ObjectSample {
  Stamp stamp;
  std::int32_t body = kNoBody;  ///< index into Scene::bodies
  Pose X_WB;
  Vec3 v_WB = Vec3::Zero();  ///< [m/s]
  Vec3 w_WB = Vec3::Zero();  ///< [rad/s]
  bool asleep = false;
};

/// One finger: device input, contact and rendered force. Key: finger. The contact carries mode, body, points, normal_B,
/// friction and forces; members that follow from these are 0.
struct FingerSample {
  Stamp stamp;
  std::int32_t finger = -1;  ///< index into Scene::devices
  bool valid = false;        ///< the device delivers usable samples
  Vec3 p_WH = Vec3::Zero();  ///< [m]
  bool oriented = false;     ///< the device measures the tool's orientation
  Quat q_WT = Quat::Identity();
  FingerContact contact;
  Vec3 f_H_W = Vec3::Zero();  ///< force on the finger after the output stage [N]
  Vec3 t_H_W = Vec3::Zero();  ///< torque [N m]
};

/// One frame of the run's rig. Key: frame. Only of a rig with frames.
struct FrameSample {
  Stamp stamp;
  std::int32_t frame = -1;  ///< index into RunInfo::frames
  FrameNow now;
};

/// Heartbeat: ends each publication and carries the values that belong to no object or finger.
struct Heartbeat {
  Stamp stamp;
  std::int32_t objects = 0, fingers = 0;  ///< number of samples in this publication
  std::uint32_t output_status = 0;        ///< OutputStatus bits of any finger
  std::uint32_t object_faults = 0;        ///< ObjectFault bits since the start
  std::uint64_t refused = 0;              ///< samples that the sender had to discard, since the start
  bool last = false;                      ///< the run has ended
};

/// A single event. No key: every event must be delivered.
struct Event {
  enum class Kind : std::int32_t { kFingerStatus = 1, kObjectFault = 2 };
  Stamp stamp;
  Kind kind = Kind::kFingerStatus;
  std::uint32_t bits = 0;  ///< new bits: OutputStatus of any finger, or ObjectFault
};

/// Sets one parameter of one run. It carries an absolute value, so it may be repeated, late or lost.
struct Command {
  std::uint64_t run = 0;
  std::uint64_t sender = 0;  ///< random id of the commanding process
  std::uint64_t number = 0;  ///< number of the sender's command, from 1
  std::string parameter;     ///< OpenParameter::name
  double value = 0;
};
inline constexpr std::size_t kLongestParameter = 127;  ///< maximum length of a name [characters]

/// The run's answer to a command, repeated whenever the command arrives again.
struct Answer {
  enum class Verdict : std::int32_t {
    kAccepted = 1,
    kUnknown,  ///< no open parameter of this name
    kOutOfRange,
    kNotANumber,
    kOvertaken,   ///< a later command of this sender for this parameter has acted already
    kOutOfOrder,  ///< the number is far ahead of the sender's others: probably forged
  };
  std::uint64_t run = 0, sender = 0, number = 0;
  Verdict verdict = Verdict::kAccepted;
  double value = 0;         ///< value in force
  double min = 0, max = 0;  ///< allowed range
};

/// An open parameter with its current value and range; kept for late subscribers. Key: run and name.
struct OpenParameter {
  std::uint64_t run = 0;
  std::string name;
  double value = 0, min = 0, max = 0;
  std::int32_t of = 0;  ///< number of open parameters of this run
};

/// What a viewer needs to know of a <frame>.
struct RigFrame {
  std::string name, parent;  ///< as Frame
  bool zooms = false;        ///< it has a scale
  bool operator==(const RigFrame&) const = default;
};

/// Static information on a run; kept for late viewers.
struct RunInfo {
  std::uint64_t run = 0;
  std::uint64_t scene_hash = 0;  ///< sceneHash of the running world
  double period = 0;             ///< time between publications [s]
  bool realtime = false;
  std::string scene_name;
  std::string scene_xml;  ///< resolved scene; meshes are given by their file names
  bool commands = false;  ///< the run takes commands
  /// SHA-256 of every mesh of the scene, body by body: visual, haptic, physics; 64 digits each, separated by spaces. A
  /// viewer looks up the files among its own (takeFromMeshStore) and opens no path received over the bus. Empty when
  /// the scene has no meshes.
  std::string mesh_sums{};
  bool guide = false;                 ///< the guide of the scene's assembly is to be in a viewer (guide_link.h)
  std::vector<RigFrame> frames{};     ///< of the rig; empty: none
  std::vector<std::string> places{};  ///< frame in which the device of each role stands; empty without frames
};

/// One publication. The spans are only valid during the call.
struct Snapshot {
  std::span<const ObjectSample> objects;
  std::span<const FingerSample> fingers;
  Heartbeat heartbeat;
  std::span<const FrameSample> frames{};
};

}  // namespace presa::bus
