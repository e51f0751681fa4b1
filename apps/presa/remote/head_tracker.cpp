#include "apps/presa/remote/head_tracker.h"

#include <chrono>
#include <cmath>

#include "framework/core/diagnostics/refuse.h"
#include "framework/device/framed_device.h"
#include "framework/scene/load.h"
#include "framework/session/session.h"

namespace presa {
namespace {

enum HeadCode { kNoHead = 766 };

constexpr double kRate = 1000;                     ///< at which a simulated device advances [Hz]
constexpr std::int64_t kTryAgain = 2'000'000'000;  ///< between attempts to reopen [ns]

std::unique_ptr<Device> openHead(const std::string& file) {
  Diagnostics diagnostics;
  auto world = std::make_shared<World>();
  world->rig = loadRig(file, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  if (world->rig.devices.size() != 1)
    refuse(kNoHead, file, "the head needs a rig of one device, found " + std::to_string(world->rig.devices.size()),
           "see config/cave/head.xml");
  const DeviceBinding binding = world->rig.devices.front();
  world->scene.devices.emplace_back().role = binding.role;
  Plan plan;
  plan.devices.push_back({binding.role, binding.driver, {}});
  RunOptions options;
  options.realtime = true;
  DeviceList made = createDevices(world, options, plan, diagnostics);
  if (diagnostics.hasErrors() || made.size() != 1) throw InputError(diagnostics);
  if (!made.front()->measuresOrientation()) {
    diagnostics.error(
        kNoHead, binding.where,
        "role '" + binding.role + "': driver '" + binding.driver + "' measures no orientation here, and a head turns",
        "keyframes need the columns qw,qx,qy,qz (config/cave/walk.csv)");
    throw InputError(diagnostics);
  }
  made.front()->open();
  const auto tree = std::make_shared<FrameTree>(world->rig, world->scene.devices);
  const int frame = tree->find(binding.frame);
  if (frame == FrameTree::kWorld) return std::move(made.front());
  return std::make_unique<FramedDevice>(std::move(made.front()), tree, frame, 0);
}

}  // namespace

HeadTracker::HeadTracker(const std::string& rig, const Pose& rest) : device_(openHead(rig)), watch_(rest) {}

HeadTracker::~HeadTracker() {
  stop_ = true;
  if (reopening_.valid()) reopening_.wait();
  device_->close();
}

const Pose& HeadTracker::update(double time, std::int64_t now_ns) {
  Tick tick;
  tick.period = 1 / kRate;
  tick.index = std::max<std::int64_t>(0, std::llround(time * kRate));
  tick.time = time;
  const FingerInput sample = device_->read(tick);
  const bool good = sample.valid && !sample.lost && sample.oriented;
  const Pose& head = watch_.update({sample.p_WH, sample.q_WT}, good, static_cast<double>(now_ns) * 1e-9);
  if (watch_.lost()) bringBack(now_ns);
  return head;
}

void HeadTracker::bringBack(std::int64_t now_ns) {
  if (now_ns - tried_ns_ < kTryAgain) return;
  if (reopening_.valid()) {
    if (reopening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    reopening_ = {};
    device_->rearm();
  }
  tried_ns_ = now_ns;
  reopening_ = std::async(std::launch::async, [this] {
    try {
      device_->reopen(stop_);
    } catch (const std::exception&) {  // still lost: tried again
    }
  });
}

}  // namespace presa
