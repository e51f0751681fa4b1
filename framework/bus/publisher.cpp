#include "framework/bus/publisher.h"

#include <algorithm>
#include <random>

#include "framework/bus/mesh_store.h"
#include "framework/bus/rig_frames.h"
#include "framework/bus/scene_hash.h"
#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/output_stage.h"

namespace presa::bus {

std::uint64_t newRunId() {
  std::random_device random;
  const std::uint64_t id = (std::uint64_t{random()} << 32) | random();
  return id == 0 ? 1 : id;
}

Publisher::GuideEnd::GuideEnd(Module& owner, const Scene& scene, bool realtime, GuideDesk::Open open)
    : assembly(owner, "assembly_state", In<AssemblyState>::Optional{}),
      orders(owner, kGuideOrdersPort),
      report(owner, kGuideReportPort),
      desk(scene, realtime, std::move(open)) {
  orders.value = desk.orders();
  report.value = desk.report();
}

void Publisher::GuideEnd::serve(const Stamp& stamp) noexcept {
  desk.serve(stamp, assembly.value());
  orders.value = desk.orders();
  report.value = desk.report();
}

Publisher::Publisher(std::shared_ptr<const World> world, const RunOptions& options, Open open,
                     ParameterServer::Open open_post, GuideDesk::Open open_orders)
    : Module("bus_dds", RateGroup::kBus),
      world_(std::move(world)),
      realtime_(options.realtime),
      open_(std::move(open)) {
  if (options.bus_commands) server_ = std::make_unique<Server>(*this, world_->scene, std::move(open_post));
  if (options.guide == RunOptions::Guide::kViewer && world_->scene.assembly)
    guide_ = std::make_unique<GuideEnd>(*this, world_->scene, realtime_, std::move(open_orders));
  if (!world_->rig.frames.empty()) frames_.emplace(*this, kFramesPort, In<FrameState>::Optional{});
  const auto& bodies = world_->scene.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].fixed) continue;  // its pose is in the scene
    ObjectSample sample;
    sample.body = static_cast<std::int32_t>(b);
    sample.X_WB = bodies[b].X_WB;
    object_samples_.push_back(sample);
  }
  finger_samples_.resize(world_->scene.devices.size());
}

Publisher::~Publisher() = default;

std::vector<std::string> Publisher::stages() const {
  std::vector<std::string> stages{"take the latest states, poses interpolated to now",
                                  "hand every object and finger to the network"};
  if (server_) stages.emplace_back("check the commands that have arrived, and answer them");
  if (guide_) stages.emplace_back("tell the guide in the viewer the state of the assembly, and check its orders");
  return stages;
}

void Publisher::start() {
  writer_ = open_();
  run_ = newRunId();
  const Scene& scene = world_->scene;
  writer_->announce({run_, sceneHash(*world_), RateTable(scene.rates).period(RateGroup::kBus), realtime_, scene.name,
                     scene.resolved_xml, server_ != nullptr, sumsOfMeshes(scene), guide_ != nullptr,
                     rigFrames(world_->rig), placesOf(*world_)});
  if (server_) server_->server.start(run_);
  if (guide_) guide_->desk.start(run_);
}

void Publisher::step(const Tick& tick) noexcept {
  const Stamp stamp{run_, heartbeat_.stamp.sequence + 1, tick.time, monotonicNs()};
  heartbeat_.stamp = stamp;
  fillObjects(stamp);
  fillFingers(stamp);
  if (frames_) fillFrames(stamp);
  heartbeat_.objects = static_cast<std::int32_t>(object_samples_.size());
  heartbeat_.fingers = static_cast<std::int32_t>(finger_samples_.size());
  heartbeat_.output_status = command_->status;
  heartbeat_.object_faults = objects_->faults;
  if (guide_) guide_->desk.show(stamp, guide_->assembly.value());
  heartbeat_.refused += writer_->publish({object_samples_, finger_samples_, heartbeat_, frame_samples_});
  publishEvents(stamp);
  if (guide_) guide_->serve(stamp);
  if (!server_) return;
  server_->server.serve(tick.time);
  server_->settings.value = server_->server.surfaces();
}

void Publisher::stop() {
  if (!writer_) return;
  if (server_) server_->server.stop();
  if (guide_) guide_->desk.stop();
  // publish the last states once more, so that the end does not look like a loss
  const Stamp stamp{run_, heartbeat_.stamp.sequence + 1, heartbeat_.stamp.time, monotonicNs()};
  heartbeat_.stamp = stamp;
  heartbeat_.last = true;
  for (ObjectSample& sample : object_samples_) sample.stamp = stamp;
  for (FingerSample& sample : finger_samples_) sample.stamp = stamp;
  for (FrameSample& sample : frame_samples_) sample.stamp = stamp;
  writer_->publish({object_samples_, finger_samples_, heartbeat_, frame_samples_});
  writer_->finish();
  writer_.reset();
}

void Publisher::fillObjects(const Stamp& stamp) noexcept {
  for (ObjectSample& sample : object_samples_) {
    sample.stamp = stamp;
    if (!objects_.hasValue() || sample.body >= objects_->count()) continue;
    const BodyMotion& motion = objects_->bodies[static_cast<std::size_t>(sample.body)];
    sample.X_WB = objects_->poseAt(sample.body, stamp.time);
    sample.v_WB = motion.v_WB;
    sample.w_WB = motion.w_WB;
    sample.asleep = motion.asleep;
  }
}

void Publisher::fillFingers(const Stamp& stamp) noexcept {
  for (std::size_t f = 0; f < finger_samples_.size(); ++f) {
    const auto finger = static_cast<std::int32_t>(f);
    FingerSample& sample = finger_samples_[f];
    sample = {};
    sample.stamp = stamp;
    sample.finger = finger;
    if (finger < device_->count()) {
      sample.valid = device_->fingers[f].valid;
      sample.p_WH = device_->fingers[f].p_WH;
      sample.oriented = device_->fingers[f].oriented;
      sample.q_WT = device_->fingers[f].q_WT;
    }
    if (finger < contact_->count()) sample.contact = contact_->fingers[f];
    if (finger < command_->count()) sample.f_H_W = command_->f_H_W[f], sample.t_H_W = command_->t_H_W[f];
  }
}

void Publisher::fillFrames(const Stamp& stamp) noexcept {
  if (!frames_->hasValue()) return;
  const auto& frames = frames_->value().frames;
  frame_samples_.resize(frames.size());
  for (std::size_t n = 0; n < frames.size(); ++n) frame_samples_[n] = {stamp, static_cast<std::int32_t>(n), frames[n]};
}

// Publishes newly latched output faults and newly frozen bodies.
void Publisher::publishEvents(const Stamp& stamp) noexcept {
  const std::uint32_t status = command_->status & kOutputLatches;
  if (const std::uint32_t fresh = status & ~reported_status_; fresh != 0)
    writer_->publish({stamp, Event::Kind::kFingerStatus, fresh});
  reported_status_ = status;
  if (const std::uint32_t fresh = objects_->faults & ~reported_faults_; fresh != 0)
    writer_->publish({stamp, Event::Kind::kObjectFault, fresh});
  reported_faults_ = objects_->faults;
}

}  // namespace presa::bus
