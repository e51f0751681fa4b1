#include "apps/presa/temple/visit.h"

#include <cstdio>
#include <memory>
#include <optional>

#include "apps/presa/run_session.h"
#include "apps/presa/temple/visit_log.h"
#include "apps/presa/temple/visit_tap.h"
#include "framework/schedule/clock.h"

namespace presa::temple {
namespace {

/// Holds a lockstep run to the clock. In the view group: a frame is when somebody looks.
class Pace final : public Module {
 public:
  explicit Pace(double scale) : Module("pace", RateGroup::kView), scale_(scale) {}
  void start() override { begin_ = monotonicNs(); }
  void step(const Tick& tick) noexcept override {
    sleepUntilNs(begin_ + static_cast<std::int64_t>(1e9 * tick.time / scale_));
  }

 private:
  double scale_;
  std::int64_t begin_ = 0;
};

class Visit {
 public:
  Visit(const Loaded& loaded, const VisitSettings& settings)
      : settings_(settings), assembly_(*loaded.world->scene.assembly) {
    auto witness = std::make_unique<Witness>(loaded.world->scene.bodies.size());
    auto tap = std::make_unique<VisitTap>(loaded.world);
    witness_ = witness.get();
    tap_ = tap.get();
    Run::Settings run{.quiet = settings.quiet, .command = "presa temple"};
    run.more.push_back(std::move(witness));
    run.more.push_back(std::move(tap));
    if (settings.time_scale > 0) run.more.push_back(std::make_unique<Pace>(settings.time_scale));
    run.watch = [this](Session& session, char key) { return watch(session, key); };
    run_ = std::make_unique<Run>(loaded, std::move(run));
    if (!settings.folder.empty()) log_.emplace(settings.folder, settings.start, loaded.world->scene, settings.language);
  }

  Rebuilt go() {
    run_->execute();
    const RunResult& result = run_->result();
    for (const auto& fault : result.faults) std::fprintf(stderr, "%s\n", fault.text.c_str());
    Rebuilt rebuilt = measure(assembly_, *witness_);
    rebuilt.wall_seconds = result.wall_seconds;
    rebuilt.simulated_seconds = result.simulated_seconds;
    rebuilt.interrupted = result.interrupted;
    if (log_) log_->note("end", rebuilt.simulated_seconds);
    return rebuilt;
  }

 private:
  bool watch(Session& session, char key) {
    const VisitTap::Look look = tap_->look();
    if (log_) log_->note(tap_->takeEvents(), look);
    undo(session, key);
    if (settings_.progress && !settings_.progress(look.now.placed, look.now.all)) return false;
    if (look.now.placed < look.now.all)
      done_at_.reset();
    else if (!done_at_)
      done_at_ = look.time;
    return settings_.finish < 0 || !done_at_ || look.time < *done_at_ + settings_.finish;
  }

  void undo(Session& session, char key) {
    const std::uint32_t wanted = session.view() != nullptr ? session.view()->undosWanted() : 0;
    for (; undone_ != wanted; ++undone_) session.assembly()->undo();
    if (key == 'u') session.assembly()->undo();
  }

  const VisitSettings& settings_;
  const Assembly& assembly_;
  const Witness* witness_ = nullptr;  // both owned by the run
  VisitTap* tap_ = nullptr;
  std::unique_ptr<Run> run_;
  std::optional<VisitLog> log_;
  std::optional<double> done_at_;  // [s]
  std::uint32_t undone_ = 0;
};

}  // namespace

Rebuilt visit(const Loaded& loaded, const VisitSettings& settings) { return Visit(loaded, settings).go(); }

}  // namespace presa::temple
