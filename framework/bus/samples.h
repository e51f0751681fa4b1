#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"

/// What travels on the bus: whole states and values, never changes of them, so that any one may be lost, doubled or late. SI units, world frame.
namespace presa::bus {

/// Of every sample. All samples of one publication share it.
struct Stamp {
  std::uint64_t run = 0;       ///< id of the run, never 0
  std::uint64_t sequence = 0;  ///< publications since the start of the run, from 1
  double time = 0;             ///< simulated time for which the sample is valid [s]
  std::int64_t sent_ns = 0;    ///< CLOCK_MONOTONIC of the sender; means something on the same machine only
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

/// One finger: what its device measured, what it touches, what it is made to feel. Key: finger. Of the contact travel mode, body,
/// points, normal_B, friction and forces; what follows from them is 0.
struct FingerSample {
  Stamp stamp;
  std::int32_t finger = -1;  ///< index into Scene::devices
  bool valid = false;        ///< the device delivers
  Vec3 p_WH = Vec3::Zero();  ///< [m]
  FingerContact contact;
  Vec3 f_H_W = Vec3::Zero();  ///< that the device holds, after the output stage [N]
};

/// Ends each publication: what is neither an object's nor a finger's.
struct Beat {
  Stamp stamp;
  std::int32_t objects = 0, fingers = 0;  ///< samples of this publication
  std::uint32_t output_status = 0;        ///< OutputStatus bits of any finger
  std::uint32_t object_faults = 0;        ///< ObjectFault bits since the start
  std::uint64_t refused = 0;              ///< samples that the sender's side had no room for, since the start
  bool last = false;                      ///< the run ends with it
};

/// Something that happened once. Key: none; none is to be missed.
struct Event {
  enum class Kind : std::int32_t { kFingerStatus = 1, kObjectFault = 2 };
  Stamp stamp;
  Kind kind = Kind::kFingerStatus;
  std::uint32_t bits = 0;  ///< those that came up: OutputStatus of any finger, or ObjectFault
};

/// Sets one parameter of one run. It carries the value, never a difference, so that it may come twice, late, or not at all.
struct Command {
  std::uint64_t run = 0;
  std::uint64_t sender = 0;  ///< random, one for each process that commands
  std::uint64_t number = 0;  ///< of the sender's commands, from 1
  std::string parameter;     ///< OpenParameter::name
  double value = 0;
};
inline constexpr std::size_t kLongestParameter = 127;  ///< characters of a name

/// What a run says to one command, as often as the command arrives.
struct Answer {
  enum class Verdict : std::int32_t {
    kAccepted = 1,
    kUnknown,  ///< no such parameter is open here
    kOutOfRange,
    kNotANumber,
    kOvertaken,   ///< a later command of this sender for this parameter was there before
    kOutOfOrder,  ///< its number is far ahead of the sender's others: not from the sender
  };
  std::uint64_t run = 0, sender = 0, number = 0;
  Verdict verdict = Verdict::kAccepted;
  double value = 0;            ///< that is in force
  double least = 0, most = 0;  ///< that is allowed
};

/// A parameter that commands may set, as it is now; kept for who comes late. Key: run and name.
struct OpenParameter {
  std::uint64_t run = 0;
  std::string name;
  double value = 0, least = 0, most = 0;
  std::int32_t of = 0;  ///< how many this run has
};

/// The static part, kept for viewers that come late.
struct RunInfo {
  std::uint64_t run = 0;
  std::uint64_t scene_hash = 0;  ///< sceneHash of the world that runs
  double period = 0;             ///< from one publication to the next [s]
  bool realtime = false;
  std::string scene_name;
  std::string scene_xml;  ///< resolved; meshes are named by their files
  bool commands = false;  ///< it takes commands
  /// SHA-256 of every file of filesNamedBy(scene), in that order, 64 digits each, with spaces between: a viewer finds the bytes among its
  /// own files (MeshShelf) and opens no path that comes from outside. Empty where the scene names none.
  std::string mesh_sums{};
};

/// One publication; the spans are read during the call only.
struct Snapshot {
  std::span<const ObjectSample> objects;
  std::span<const FingerSample> fingers;
  Beat beat;
};

}  // namespace presa::bus
