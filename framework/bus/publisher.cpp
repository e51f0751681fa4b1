#include "framework/bus/publisher.h"

#include <algorithm>
#include <random>

#include "framework/bus/mesh_shelf.h"
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

Publisher::Publisher(std::shared_ptr<const World> world, const RunOptions& options, Open open,
                     CommandDesk::Open open_post)
    : Module("bus_dds", RateGroup::kBus),
      world_(std::move(world)),
      realtime_(options.realtime),
      open_(std::move(open)) {
  if (options.bus_commands) desk_ = std::make_unique<Desk>(*this, world_->scene, std::move(open_post));
  const auto& bodies = world_->scene.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].fixed) continue;  // its pose is in the scene
    ObjectSample sample;
    sample.body = static_cast<std::int32_t>(b);
    sample.X_WB = bodies[b].X_WB;
    object_samples_.push_back(sample);
  }
  finger_samples_.resize(std::min<std::size_t>(world_->scene.devices.size(), kMaxFingers));
}

Publisher::~Publisher() = default;

std::vector<std::string> Publisher::stages() const {
  std::vector<std::string> stages{"take the latest states, poses interpolated to now",
                                  "hand every object and finger to the network"};
  if (desk_) stages.emplace_back("judge the commands that have come, and answer");
  return stages;
}

void Publisher::start() {
  writer_ = open_();
  run_ = newRunId();
  const Scene& scene = world_->scene;
  writer_->announce({run_, sceneHash(*world_), RateTable(scene.rates).period(RateGroup::kBus), realtime_, scene.name,
                     scene.resolved_xml, desk_ != nullptr, sumsOfMeshes(scene)});
  if (desk_) desk_->desk.start(run_);
}

void Publisher::step(const Tick& tick) noexcept {
  const Stamp stamp{run_, beat_.stamp.sequence + 1, tick.time, monotonicNs()};
  beat_.stamp = stamp;
  fillObjects(stamp);
  fillFingers(stamp);
  beat_.objects = static_cast<std::int32_t>(object_samples_.size());
  beat_.fingers = static_cast<std::int32_t>(finger_samples_.size());
  beat_.output_status = command_->status;
  beat_.object_faults = objects_->faults;
  beat_.refused += writer_->publish({object_samples_, finger_samples_, beat_});
  tellEvents(stamp);
  if (!desk_) return;
  desk_->desk.serve(tick.time);
  desk_->settings.value = desk_->desk.surfaces();
}

void Publisher::stop() {
  if (!writer_) return;
  if (desk_) desk_->desk.stop();
  // publish the last states once more, so that the end does not look like a loss
  const Stamp stamp{run_, beat_.stamp.sequence + 1, beat_.stamp.time, monotonicNs()};
  beat_.stamp = stamp;
  beat_.last = true;
  for (ObjectSample& sample : object_samples_) sample.stamp = stamp;
  for (FingerSample& sample : finger_samples_) sample.stamp = stamp;
  writer_->publish({object_samples_, finger_samples_, beat_});
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
    if (finger < device_->count) {
      sample.valid = device_->fingers[f].valid;
      sample.p_WH = device_->fingers[f].p_WH;
    }
    if (finger < contact_->count) sample.contact = contact_->fingers[f];
    if (finger < command_->count) sample.f_H_W = command_->f_H_W[f];
  }
}

// Publishes newly latched output faults and newly frozen bodies.
void Publisher::tellEvents(const Stamp& stamp) noexcept {
  const std::uint32_t status = command_->status & kOutputLatches;
  if (const std::uint32_t fresh = status & ~told_status_; fresh != 0)
    writer_->publish({stamp, Event::Kind::kFingerStatus, fresh});
  told_status_ = status;
  if (const std::uint32_t fresh = objects_->faults & ~told_faults_; fresh != 0)
    writer_->publish({stamp, Event::Kind::kObjectFault, fresh});
  told_faults_ = objects_->faults;
}

}  // namespace presa::bus
