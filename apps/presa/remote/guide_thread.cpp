#include "apps/presa/remote/guide_thread.h"

#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

constexpr double kPatience = 0.05;  ///< longest wait for a publication [s]

enum GuideCode { kRunIsNotGuided = 769 };

const std::shared_ptr<const World>& guided(const std::shared_ptr<const World>& world, const bus::RunInfo& run) {
  if (!run.guide || !world->scene.assembly)
    refuse(kRunIsNotGuided, "--guide", "the run takes no guide from a viewer: it has its own, or nothing to assemble",
           "start the run with --bus-commands --guide viewer, or show it without --guide");
  return world;
}

}  // namespace

GuideThread::GuideThread(std::shared_ptr<const World> world, const bus::RunInfo& run, const BusSettings& settings)
    : guide_(guided(world, run), bus::openReader(settings), bus::openOrderSender(settings)) {
  guide_.join(run);
  thread_ = std::thread([this] {
    while (!stop_) guide_.step(kPatience);
  });
}

GuideThread::~GuideThread() {
  stop_ = true;
  thread_.join();
}

}  // namespace presa
