#include "modules/bus_dds/participant.h"

#include <RunState.h>
#include <dds/ddsrt/log.h>

#include <map>
#include <mutex>
#include <string>

#include "framework/bus/bus_keys.h"
#include "framework/bus/loopback_only.h"
#include "framework/core/diagnostics/refuse.h"
#include "modules/bus_dds/security.h"

namespace presa::bus_dds {
namespace {

constexpr int kKept = 32;  // publications
constexpr int kCommandsKept = 256;

// Complete configuration, so that no file or environment variable of the machine changes where the state is sent.
// - Peers, ParticipantIndex: without multicast the viewers' ports are tried one by one.
// - LeaseDuration: time after which packets to a killed viewer end.
// - SocketReceiveBufferSize: a viewer may be suspended for half a second without loss.
// - WhcHigh: far above the need of kKept publications of the largest scene, so that a stopped reader never blocks the
//   writer.
std::string configuration(const std::string& network) {
  std::string interface = "<NetworkInterface autodetermine=\"true\"/>", multicast = "spdp", peers;
  if (network == "loopback") {
    interface = "<NetworkInterface name=\"lo\" multicast=\"false\"/>";
    multicast = "false";
    peers = "<Peers><Peer address=\"127.0.0.1\"/></Peers>";
  } else if (network.starts_with("lan:")) {
    interface = "<NetworkInterface name=\"" + network.substr(4) + "\"/>";
  }
  return "<CycloneDDS><Domain Id=\"any\"><General><Interfaces>" + interface + "</Interfaces><AllowMulticast>" +
         multicast +
         "</AllowMulticast></General>"
         "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>64</MaxAutoParticipantIndex>"
         "<LeaseDuration>2 s</LeaseDuration>" +
         peers +
         "</Discovery><Internal><SocketReceiveBufferSize min=\"default\" max=\"4 MB\"/>"
         "<Watermarks><WhcHigh>32 MB</WhcHigh></Watermarks></Internal>"
         "<Tracing><Verbosity>none</Verbosity></Tracing></Domain></CycloneDDS>";
}

/// Cyclone's last log message, which is appended to error messages. It is not printed directly, because an unplugged
/// cable would cause hundreds of lines per second; viewers report the silence.
class LastDdsError {
 public:
  static void listen() { dds_set_log_sink(&LastDdsError::note, nullptr); }
  static std::string last() {
    const std::lock_guard lock(mutex());
    return text();
  }

 private:
  static void note(void*, const dds_log_data_t* entry) {
    std::string message(entry->message);
    while (!message.empty() && message.back() == '\n') message.pop_back();
    const std::lock_guard lock(mutex());
    text() = std::move(message);
  }
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static std::string& text() {
    static std::string one;
    return one;
  }
};

/// Creates the domain. Cyclone creates its sockets here, on this thread.
Entity openDomain(dds_domainid_t id, const std::string& network, const std::string& what) {
  const std::string settings = configuration(network);
  if (network != "loopback") return checked(dds_create_domain(id, settings.c_str()), what.c_str());
  const bus::LoopbackOnly inside;
  Entity domain = checked(dds_create_domain(id, settings.c_str()), what.c_str());
  if (inside.bound() == 0)
    refuse(750, "bus", "Cyclone DDS bypassed Presa's bind() and may listen on every interface",
           "this happens when a library that is loaded before Presa's brings a bind() of its own (LD_PRELOAD)");
  return domain;
}

std::shared_ptr<Participant> open(const BusSettings& settings) {
  LastDdsError::listen();
  auto joined = std::make_shared<Participant>();
  const std::string network = "the network '" + settings.network + "'";
  const auto id = static_cast<dds_domainid_t>(settings.domain);
  joined->domain = openDomain(id, settings.network, network);
  if (settings.keys.empty()) {
    joined->participant = checked(dds_create_participant(id, nullptr, nullptr), network.c_str());
  } else {
    const Qos identity = securityQos(bus::checkedKeys(settings.keys));
    joined->participant = checked(dds_create_participant(id, identity.get(), nullptr),
                                  (network + " with the keys in '" + settings.keys + "'").c_str());
  }
  const auto topic = [&](const dds_topic_descriptor_t& type, const char* name) {
    return makeTopic(*joined, type, name);
  };
  joined->objects = topic(presa_dds_ObjectState_desc, "presa_object_state");
  joined->fingers = topic(presa_dds_DeviceState_desc, "presa_device_state");
  joined->heartbeats = topic(presa_dds_Beat_desc, "presa_beat");
  joined->events = topic(presa_dds_Event_desc, "presa_event");
  joined->scenes = topic(presa_dds_SceneInfo_desc, "presa_scene");
  return joined;
}

Qos reliable() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

}  // namespace

Entity checked(dds_entity_t handle, const char* what) {
  if (handle > 0) return Entity(handle);
  const std::string dds_error = LastDdsError::last();
  if (handle == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
    refuse(
        720, "bus",
        std::string("these keys do not allow the use of ") + what + (dds_error.empty() ? "" : " (" + dds_error + ")"),
        "a run needs DIR/run, a viewer DIR/viewer, presa bus list and set DIR/commander, all made by one presa bus "
        "keys DIR");
  refuse(720, "bus",
         std::string("cannot use ") + what + ": " + dds_strretcode(-handle) +
             (dds_error.empty() ? "" : " (" + dds_error + ")"),
         "ip link shows the interfaces; --bus loopback needs none but lo");
}

std::shared_ptr<Participant> join(const BusSettings& settings) {
  struct Known {
    std::string network, keys;
    std::weak_ptr<Participant> participant;
  };
  static std::mutex mutex;
  static std::map<int, Known> known;
  const std::lock_guard lock(mutex);
  Known& entry = known[settings.domain];
  if (auto joined = entry.participant.lock()) {
    if (entry.network != settings.network)
      refuse(721, "bus", "domain " + std::to_string(settings.domain) + " is in use on network " + entry.network,
             "another --domain");
    if (entry.keys != settings.keys)
      refuse(721, "bus", "domain " + std::to_string(settings.domain) + " is in use with other keys",
             "another --domain");
    return joined;
  }
  auto joined = open(settings);
  entry = {settings.network, settings.keys, joined};
  return joined;
}

Qos stateQos() {
  Qos qos = reliable();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kKept);
  return qos;
}

Entity makeTopic(const Participant& joined, const dds_topic_descriptor_t& type, const char* name) {
  return checked(dds_create_topic(joined.participant, &type, name, nullptr, nullptr), name);
}

Entity framesTopic(const Participant& joined) {
  return makeTopic(joined, presa_dds_FrameState_desc, "presa_frame_state");
}

Qos commandQos() {
  Qos qos = reliable();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kCommandsKept);
  return qos;
}

Qos sceneQos() {
  Qos qos = reliable();
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

}  // namespace presa::bus_dds
