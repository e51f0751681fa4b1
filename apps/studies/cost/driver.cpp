#include "apps/studies/cost/driver.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <system_error>
#include <thread>

#include "apps/common/atomic_file.h"
#include "apps/common/machine.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/cost/condition_factor.h"
#include "apps/studies/cost/errors.h"
#include "apps/studies/cost/factors.h"
#include "apps/studies/cost/forecast.h"
#include "apps/studies/cost/identity.h"
#include "apps/studies/cost/machine_turn.h"
#include "apps/studies/cost/measure.h"
#include "apps/studies/cost/meshes.h"
#include "apps/studies/cost/metrics.h"
#include "apps/studies/cost/orders.h"
#include "apps/studies/cost/reference_levels.h"
#include "apps/studies/cost/run_store.h"
#include "experiments/study/jobs.h"
#include "framework/core/schedule/clock.h"

namespace presa::cost {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTooLong = "it took too long";
constexpr int kWatched = -1;
constexpr int kCounted = 1000;  ///< pseudo repeat number of the run that counts instructions

/// One run to do: of a setting, or of a level of the reference.
struct Task {
  std::vector<std::string> sets;
  std::uint64_t hash = 0;
  int repeat = kWatched;  ///< kWatched, kCounted, or the index of a timed run
};

int workersOf(const DriverOptions& options) {
  return options.workers > 0 ? options.workers : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// What prevents a result from being written, such as a full disk; empty: it is written.
std::string unlessWritten(const std::function<void()>& write) {
  try {
    write();
    return {};
  } catch (const std::system_error& error) {
    return error.what();
  }
}

double bytesIn(const std::string& folder) {
  std::error_code none;
  double bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    bytes += static_cast<double>(entry.file_size(none));
  return bytes;
}

Forecast::Run runOf(const Task& task) {
  using Kind = Forecast::Kind;
  return {task.repeat == kWatched   ? Kind::kWatched
          : task.repeat == kCounted ? Kind::kCounted
                                    : Kind::kTimed,
          task.hash};
}

class Driver {
 public:
  /// `shard`: the part of the study to run; 1 of 1 is all of it.
  Driver(const Study& study, const DriverOptions& options, const Shard& shard = {})
      : study_(study), options_(options), shard_(shard), forecast_(workersOf(options)) {}

  Result run() {
    prepare();
    result_.study = study_;
    watchFirst();
    refineReference();
    for (std::size_t repeat = 0; repeat < static_cast<std::size_t>(study_.repeats); ++repeat)
      timeAll(static_cast<int>(repeat));
    if (options_.instructions) timeAll(kCounted);
    progress_->finish();
    collect();
    result_.interrupted = stopped_;
    if (!stopped_) store_->dropTraces(workersOf(options_));
    return std::move(result_);
  }

  /// False: interrupted.
  bool runShard() {
    keeps_killed_ = false;  // by whoever is short of memory; another machine may make it
    prepare();
    {
      const MachineTurn turn = takeTurn(MachineTurn::kWithOthers);
      watchFirst();
    }
    const MachineTurn turn = takeTurn(MachineTurn::kAlone);
    for (int repeat = 0; repeat < study_.repeats; ++repeat) timeAll(repeat);
    if (options_.instructions) timeAll(kCounted);
    progress_->finish();
    if (const std::size_t runs = stopped_ ? 0 : lost(); runs > 0)
      throw std::runtime_error(std::to_string(runs) + (runs == 1 ? " run" : " runs") +
                               " left no result: killed from outside, perhaps for want of memory, or crashed; the same "
                               "command with --resume makes what is missing");
    return !stopped_;
  }

 private:
  bool runs(std::size_t setting) const { return shard_.holds(setting) && study_.settings[setting].impossible.empty(); }
  MachineTurn takeTurn(MachineTurn::Kind kind);
  void prepare();
  void expectAll();
  void ended(const Task& task, double seconds, const std::string& what);
  StudySpec spec(const Task& task) const;
  void work(const std::vector<Task>& tasks, int workers, const std::string& what);
  void watchFirst();
  Task levelTask(std::size_t level, const FinerLimits& limits) const;
  bool runsWith(std::size_t level, const FinerLimits& limits);
  void settleLevels(std::size_t levels);
  void refineReference();
  void timeAll(int repeat);
  Timing timing(const Task& task) const;
  bool isMeasured(const Task& task) const;
  std::size_t lost() const;
  /// With that many levels of the reference. False: a finer one is needed, and there is one.
  bool compare(std::size_t levels);
  bool takeErrors(const std::vector<const Metric*>& metrics, const Evidence& fine, bool finer_exists);
  bool allResolved() const;
  void collect();

  const Study& study_;
  const DriverOptions& options_;
  const Shard shard_;
  const std::string hardware_ = hardwareText();
  bool keeps_killed_ = true;  ///< a run that was killed is a result of its setting
  std::string rig_;
  std::unique_ptr<RunStore> store_;
  std::vector<std::uint64_t> level_hash_;  ///< as planned
  FinerLimits limits_;                     ///< of the reference's knobs
  Result result_;
  bool stopped_ = false;
  std::unique_ptr<terminal::JobProgress> progress_;
  Forecast forecast_;
  std::int64_t forecast_due_ns_ = 0;
};

void Driver::prepare() {
  const Identity identity = identityOf(study_);
  level_hash_ = identity.levels;
  limits_ = noLimits(study_);
  if (!identity.rig.empty()) {
    rig_ = study_.folder + "/rig.xml";
    writeFileAtomically(rig_, identity.rig);
  }
  result_.meshes = makeMeshes(study_);
  const std::string runs = study_.folder + "/runs";
  if (!options_.resume) fs::remove_all(runs);
  fs::create_directories(runs);
  store_ = std::make_unique<RunStore>(runs, identity.common);
  expectAll();
}

void Driver::expectAll() {
  std::size_t count = 0;
  const auto expect = [&](Task task) {
    forecast_.add(runOf(task));
    ++count;
  };
  for (std::size_t level = 0; level < std::min(kFirstLevels, level_hash_.size()); ++level)
    if (shard_.holds(level)) expect({{}, level_hash_[level]});
  for (std::size_t i = 0; i < study_.settings.size(); ++i) {
    if (!runs(i)) continue;
    const std::uint64_t hash = study_.settings[i].scene_hash;
    for (int repeat = kWatched; repeat < study_.repeats; ++repeat) expect({{}, hash, repeat});
    if (options_.instructions && !hasConditions(study_.settings[i])) expect({{}, hash, kCounted});
  }
  progress_ = std::make_unique<terminal::JobProgress>(count);
}

/// Runs of the shard that left nothing.
std::size_t Driver::lost() const {
  std::size_t count = 0;
  for (std::size_t level = 0; level < std::min(kFirstLevels, level_hash_.size()); ++level)
    count += shard_.holds(level) && !store_->hasEvidence(level_hash_[level]) ? 1 : 0;
  for (std::size_t i = 0; i < study_.settings.size(); ++i) {
    if (!runs(i)) continue;
    const std::uint64_t hash = study_.settings[i].scene_hash;
    const bool watched = store_->hasEvidence(hash);
    count += watched ? 0 : 1;
    if (!watched || !store_->evidence(hash, false).failure.empty()) continue;
    for (int repeat = 0; repeat < study_.repeats; ++repeat) count += store_->hasTiming(hash, repeat) ? 0 : 1;
  }
  return count;
}

MachineTurn Driver::takeTurn(MachineTurn::Kind kind) {
  MachineTurn turn;
  while (!stopped_ && !turn.take(kind)) {
    progress_->show();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stopped_ = terminal::JobProgress::interrupted();
  }
  return turn;
}

void Driver::ended(const Task& task, double seconds, const std::string& what) {
  forecast_.done(runOf(task), seconds);
  if (const std::int64_t now = monotonicNs(); now >= forecast_due_ns_) {
    if (const double left = forecast_.left(); left >= 0) progress_->expect(left);
    forecast_due_ns_ = now + 1'000'000'000;
  }
  progress_->done(what);
}

StudySpec Driver::spec(const Task& task) const {
  StudySpec spec;
  spec.scene = study_.inputs.scene;
  spec.rig = rig_;
  spec.sets = study_.inputs.sets;
  spec.sets.insert(spec.sets.end(), task.sets.begin(), task.sets.end());
  Diagnostics known;  // reported by the plan
  spec.conditions = takeConditions(spec.sets, known);
  spec.duration = study_.duration;
  spec.seed = study_.seed;
  return spec;
}

// A cost of another machine counts for nothing here.
bool Driver::isMeasured(const Task& task) const {
  return store_->hasTiming(task.hash, task.repeat) && store_->timing(task.hash, task.repeat).hardware == hardware_;
}

// A job saves its result on disk; it returns text only if it cannot.
void Driver::work(const std::vector<Task>& tasks, int workers, const std::string& what) {
  std::vector<Task> missing;
  std::set<std::pair<std::uint64_t, int>> planned;
  for (const Task& task : tasks) {
    const bool there = task.repeat < 0 ? store_->hasEvidence(task.hash) : isMeasured(task);
    if (!there && planned.insert({task.hash, task.repeat}).second)
      missing.push_back(task);
    else
      ended(task, there && task.repeat < 0 ? store_->evidence(task.hash, false).seconds : -1, what);
  }
  ::malloc_trim(0);  // a fork copies the page tables of all memory, free memory too
  JobOptions jobs;
  jobs.workers = workers;
  std::string unwritten;
  jobs.stop = [&] { return !unwritten.empty() || terminal::JobProgress::interrupted(); };
  jobs.on_wait = [&] { progress_->show(); };
  jobs.on_done = [&](std::size_t i, const JobResult& job) {
    ended(missing[i], job.seconds, what);
    if (job.outcome == JobResult::Outcome::kDone && !job.text.empty()) unwritten = job.text;
    if (job.outcome == JobResult::Outcome::kDone || job.outcome == JobResult::Outcome::kNotRun ||
        missing[i].repeat >= 0)
      return;
    Evidence evidence;
    evidence.seconds = job.seconds;
    evidence.failure = job.outcome == JobResult::Outcome::kTimedOut ? kTooLong : job.text;
    if (!keeps_killed_ && job.killed) return;
    unwritten += unlessWritten([&] { store_->save(missing[i].hash, evidence); });
  };
  const std::int64_t runs_begin = monotonicNs();
  const auto results = runJobs(
      missing.size(),
      [&](std::size_t i) {
        const Task& task = missing[i];
        if (task.repeat < 0) {
          const std::int64_t begin = monotonicNs();
          Evidence evidence = watch(spec(task), study_);
          evidence.seconds = static_cast<double>(monotonicNs() - begin) * 1e-9;
          return unlessWritten([&] { store_->save(task.hash, evidence); });
        }
        const Timing measured = timing(task);
        return unlessWritten([&] { store_->save(task.hash, task.repeat, measured); });
      },
      jobs);
  if (!unwritten.empty()) {
    progress_->finish();
    throw std::runtime_error(unwritten + "; finished runs are kept: make room, then the same command with --resume");
  }
  result_.runs_seconds += 1e-9 * static_cast<double>(monotonicNs() - runs_begin);
  result_.runs += missing.size();
  for (const JobResult& job : results) stopped_ = stopped_ || job.outcome == JobResult::Outcome::kNotRun;
}

void Driver::watchFirst() {
  std::vector<Task> tasks;
  for (std::size_t level = 0; level < std::min(kFirstLevels, study_.reference.size()); ++level)
    if (shard_.holds(level)) tasks.push_back(levelTask(level, limits_));
  for (std::size_t i = 0; i < study_.settings.size(); ++i) {
    if (runs(i)) tasks.push_back({study_.settings[i].sets, study_.settings[i].scene_hash});
  }
  work(tasks, options_.workers, "accuracy");
}

Task Driver::levelTask(std::size_t level, const FinerLimits& limits) const {
  std::vector<std::string> sets = setsOfLevel(study_, level, limits);
  Diagnostics known;  // reported by the plan
  const std::uint64_t hash =
      limits == noLimits(study_) ? level_hash_[level] : checkedScene(study_.inputs, sets, study_.folder, known);
  return {std::move(sets), hash};
}

/// Runs the level if it has not been run. False: it cannot be, or the study was stopped.
bool Driver::runsWith(std::size_t level, const FinerLimits& limits) {
  if (stopped_) return false;
  const Task task = levelTask(level, limits);
  if (!store_->hasEvidence(task.hash)) {
    progress_->more(1);
    forecast_.add(runOf(task));
    work({task}, 1, "a finer reference");
  }
  return !stopped_ && store_->evidence(task.hash, false).failure.empty();
}

// A level whose knobs are too fine for the scene, for want of memory for instance, is run with coarser ones.
void Driver::settleLevels(std::size_t levels) {
  for (std::size_t level = 0; level < std::min(levels, study_.reference.size()) && !stopped_;) {
    if (!runsWith(level, limits_) && !stopped_ && limits_ != FinerLimits(limits_.size(), 0)) {
      limits_ =
          limitsThatRun(study_, level, limits_, [&](const FinerLimits& limits) { return runsWith(level, limits); });
      level = 0;  // the levels before may have changed
    } else {
      ++level;
    }
  }
}

// Until the reference's own uncertainty is small compared with the smallest error in the report.
void Driver::refineReference() {
  for (std::size_t levels = kFirstLevels; !stopped_; ++levels) {
    settleLevels(levels);
    if (stopped_) return;
    const bool enough = compare(levels);
    stopped_ = stopped_ || terminal::JobProgress::interrupted();
    if (!enough) continue;
    result_.orders = ordersOf(result_, [&](std::uint64_t scene) { return store_->evidence(scene, true); });
    return;
  }
}

Timing Driver::timing(const Task& task) const {
  Timing timing;
  if (task.repeat == kCounted)
    timing.instructions = countInstructions(spec(task));
  else
    timing = timeRun(spec(task));
  timing.hardware = hardware_;
  return timing;
}

void Driver::timeAll(int repeat) {
  if (stopped_ || !options_.measured_on.empty()) return;
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < study_.settings.size(); ++i) {
    if (!runs(i)) continue;
    const Setting& setting = study_.settings[i];
    if (repeat == kCounted && hasConditions(setting)) continue;  // valgrind runs a program that knows none
    const Task task{setting.sets, setting.scene_hash, repeat};
    if (store_->evidence(setting.scene_hash, false).failure == kTooLong)
      ended(task, -1, "time");
    else
      tasks.push_back(task);
  }
  if (repeat == kCounted) return work(tasks, options_.workers, "instructions");
  work(tasks, 1, "time");  // one at a time: parallel runs would share the cache and disturb the timing
}

// One error that a finer reference is needed for is enough.
bool Driver::compare(std::size_t levels) {
  keepFreeMemory();
  Result::Reference& reference = result_.reference;
  using Kind = Study::Reference;
  const bool refined = study_.reference_kind == Kind::kRefined;
  const Evidence fine = refined ? store_->evidence(levelTask(levels - 1, limits_).hash, true)
                        : study_.reference_kind == Kind::kAnalytic ? analyticAnswer(spec({}))
                                                                   : Evidence{};
  const Evidence coarser = refined ? store_->evidence(levelTask(levels - 2, limits_).hash, true) : fine;
  for (const Evidence* level : {&fine, &coarser}) {
    if (!level->failure.empty()) throw std::runtime_error("the reference cannot be run: " + level->failure);
  }
  if (refined) {
    reference.sets = setsOfLevel(study_, levels - 1, limits_);
    reference.kept = keptKnobs(study_, levels - 1, limits_);
  }
  result_.outcomes.clear();
  result_.metrics = study_.metrics;
  for (const Setting& setting : study_.settings) result_.outcomes.push_back({setting, setting.impossible, {}, {}});
  std::vector<const Metric*> metrics;
  for (const std::string& name : study_.metrics) {
    const Metric& metric = *metrics.emplace_back(findMetric(name));
    const auto residual = metric.error(coarser, fine);
    if (residual && !metric.absolute) reference.residual[name] = *residual;
    if (const auto noticeable = metric.noticeable(fine)) reference.noticeable[name] = *noticeable;
  }
  const bool finer_exists = levels < study_.reference.size();
  if (!takeErrors(metrics, fine, finer_exists)) return false;
  std::erase_if(result_.metrics, [&](const std::string& name) {
    return std::none_of(result_.outcomes.begin(), result_.outcomes.end(), [&](const Outcome& outcome) {
      return outcome.error.contains(name) && outcome.error.at(name) > kRounding;
    });
  });
  reference.fine_enough = allResolved();
  return reference.fine_enough || !finer_exists;
}

/// False: interrupted, or one error is too small for the reference and `finer_exists`.
bool Driver::takeErrors(const std::vector<const Metric*>& metrics, const Evidence& fine, bool finer_exists) {
  std::vector<Outcome*> outcomes;
  std::vector<std::uint64_t> scenes;
  for (Outcome& outcome : result_.outcomes) {
    if (!outcome.failure.empty()) continue;
    outcomes.push_back(&outcome);
    scenes.push_back(outcome.setting.scene_hash);
  }
  return compareRuns(*store_, scenes, metrics, fine, workersOf(options_),
                     [&](std::size_t run, const Compared& compared) {
                       Outcome& outcome = *outcomes[run];
                       outcome.failure = compared.failure;
                       for (std::size_t m = 0; m < compared.errors.size(); ++m) {
                         if (!compared.errors[m]) continue;
                         const double error = *compared.errors[m];
                         outcome.error[study_.metrics[m]] = error;
                         if (finer_exists && error > kRounding && !result_.resolved(outcome, study_.metrics[m]))
                           return false;
                       }
                       return true;
                     });
}

/// True when the reference resolves every error in the report to a tenth.
bool Driver::allResolved() const {
  for (const std::string& name : result_.metrics) {
    for (const Outcome& outcome : result_.outcomes) {
      if (outcome.failure.empty() && !result_.resolved(outcome, name)) return false;
    }
  }
  return true;
}

void Driver::collect() {
  std::set<std::string> engines;
  for (Outcome& outcome : result_.outcomes) {
    if (!outcome.setting.impossible.empty()) continue;
    if (options_.instructions && store_->hasTiming(outcome.setting.scene_hash, kCounted))
      outcome.instructions = store_->timing(outcome.setting.scene_hash, kCounted).instructions;
    for (int repeat = 0; repeat < study_.repeats; ++repeat) {
      if (store_->hasTiming(outcome.setting.scene_hash, repeat))
        outcome.timings.push_back(store_->timing(outcome.setting.scene_hash, repeat));
    }
    for (const Timing& timing : outcome.timings) engines.insert(timing.engines.begin(), timing.engines.end());
  }
  result_.machine = options_.measured_on.empty() ? machineFacts() : options_.measured_on;
  std::string names;
  for (const std::string& engine : engines) names += (names.empty() ? "" : ", ") + engine;
  if (!names.empty()) result_.machine.emplace_back("engines", names);
}

}  // namespace

void checkFolder(const Study& study, Diagnostics& diagnostics) {
  const std::string& folder = study.folder;
  std::error_code error;
  fs::create_directories(folder, error);
  std::string trouble;
  if (error || !fs::is_directory(folder) || ::access(folder.c_str(), W_OK | X_OK) != 0) {
    trouble = error ? error.message() : "no right to";
  } else {
    // runs of an earlier study make room or are kept
    const double free = static_cast<double>(fs::space(folder, error).available) + bytesIn(folder + "/runs");
    if (error || study.disk_bytes <= free) return;
    trouble = "its runs need about " + std::to_string(std::llround(1e-6 * study.disk_bytes)) + " MB, found " +
              std::to_string(std::llround(1e-6 * free)) + " MB that are free";
  }
  diagnostics.error(803, {"--out " + folder, 0, 0},
                    "cannot write the study into the folder '" + folder + "': " + trouble, "choose another with --out");
}

Result runStudy(const Study& study, const DriverOptions& options) { return Driver(study, options).run(); }

bool runShard(const Study& study, const Shard& shard, const DriverOptions& options) {
  return Driver(study, options, shard).runShard();
}

}  // namespace presa::cost
