#pragma once
#include <string>
#include <vector>

#include "apps/presa/device/rig_bases.h"
#include "devices/percro_arm/calibration/linked_bases.h"

namespace presa::device {

/// How the motion of two linked devices is recorded.
struct LinkRecording {
  std::string rig_xml, name;  ///< of the rig whose devices are used
  double seconds = 20;
  bool realtime = true;  ///< against the clock; false: virtual time, for modelled devices
  std::string doing;     ///< shown with the progress: "index leads thumb"
  std::vector<std::string> roles;
  std::vector<Pose> bases;  ///< X_WD by which the devices turn what they measure into the world
};

struct RecordedLink {
  std::vector<LinkedSample> samples;  ///< what each device reports in its base's frame, every 10 ms
  bool stopped = false;               ///< by Ctrl-C, which keeps the samples
};

/// Runs both devices without any force and records where they report their fingertips. Throws InputError with the
/// findings of the rig; E400 when a device gives no samples. Progress goes to stderr. Thread: main.
RecordedLink recordLink(const LinkRecording& recording);

}  // namespace presa::device
