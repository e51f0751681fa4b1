#include "apps/experiment/simulate/shards.h"

#include <cstdio>
#include <filesystem>

#include "apps/common/cluster/shard_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/file_text.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/journal.h"
#include "apps/experiment/session_log.h"
#include "apps/experiment/simulate/variations.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/math/fnv.h"
#include "framework/input/folders.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum ShardCode { kNoShard = 810, kOfAnother = 811, kNoFolder = 951 };

/// The same for all shards of one simulation.
std::string workOf(const Simulation& wanted, const Experiment& experiment) {
  const StudiesPlan& plan = wanted.plan;
  Fnv1a hash;
  hash.add(planText(plan, experiment));
  for (const int number : {plan.subjects, plan.studies, plan.recordings ? 1 : 0})
    hash.add(std::to_string(number) + "\n");
  for (const std::string& setting : wanted.varied) hash.add(setting + "\n");
  hash.add(std::to_string(plan.power));
  return std::to_string(hash.value());
}

json storedOf(const Simulation& wanted) {
  const StudiesPlan& plan = wanted.plan;
  return {{"experiment", plan.experiment_file},
          {"rig", plan.rig_file},
          {"level", plan.level},
          {"subjects", plan.subjects},
          {"seeds", plan.studies},
          {"recordings", plan.recordings},
          {"power", plan.power},
          {"vary", wanted.varied}};
}

Simulation simulationFrom(const json& stored) {
  Simulation wanted;
  wanted.plan.experiment_file = stored.at("experiment");
  wanted.plan.rig_file = stored.at("rig");
  wanted.plan.level = stored.at("level");
  wanted.plan.subjects = stored.at("subjects");
  wanted.plan.studies = stored.at("seeds");
  wanted.plan.recordings = stored.at("recordings");
  wanted.plan.power = stored.at("power");
  wanted.varied = stored.at("vary");
  return wanted;
}

/// The words of `presa` for it, without --out and --jobs.
std::vector<std::string> wordsOf(const Simulation& wanted) {
  const StudiesPlan& plan = wanted.plan;
  std::vector<std::string> words{"experiment",
                                 "simulate",
                                 plan.experiment_file,
                                 "--subjects",
                                 std::to_string(plan.subjects),
                                 "--seeds",
                                 std::to_string(plan.studies)};
  words.insert(words.end(), {"--power", terminal::format("%.17g", plan.power)});
  if (!plan.level.empty()) words.insert(words.end(), {"--simulated", plan.level});
  if (!plan.rig_file.empty()) words.insert(words.end(), {"--rig", plan.rig_file});
  for (const std::string& setting : wanted.varied) words.insert(words.end(), {"--vary", setting});
  if (plan.recordings) words.emplace_back("--recordings");
  return words;
}

/// The plan of each variation, or the only one.
std::vector<StudiesPlan> plansOf(const Simulation& wanted) {
  if (wanted.varied.empty()) return {wanted.plan};
  std::vector<StudiesPlan> plans;
  for (const Variation& variation : variationsOf(wanted.plan, wanted.varied)) plans.push_back(variation.plan);
  return plans;
}

/// Links a file, or copies it where the disk has no links; what is there under that name is replaced.
void putFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::equivalent(from, to, error)) return;
  fs::create_directories(to.parent_path(), error);
  const fs::path part = to.string() + ".part";  // an interrupted copy leaves no half file under the name
  fs::remove(part, error);
  fs::create_hard_link(from, part, error);
  if (error) fs::copy_file(from, part, error);
  if (!error) fs::rename(part, to, error);
  if (error) refuse(kNoFolder, to.string(), "cannot be written: " + error.message());
}

/// A session of a shard replaces one of before: the plan is the same, and so is what it simulates.
void putSession(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::equivalent(from / kJournal, to / kJournal, error)) return;
  fs::remove_all(to, error);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(from))
    if (entry.is_regular_file() && entry.path().filename() != kJournal)
      putFile(entry.path(), to / fs::relative(entry.path(), from));
  putFile(from / kJournal, to / kJournal);  // the last one: a session with it is whole
}

/// E810: a session of the shard is gone; E951: the merged folder holds another plan.
void checkSessions(const StudiesPlan& from, const StudiesPlan& to, std::uint64_t seed, Diagnostics& diagnostics) {
  for (const StudySession& session : sessionsOf(from, seed))
    if (const std::string journal = folderOf(session.data, session.subject_id, 1).journal(); !fs::exists(journal))
      diagnostics.error(kNoShard, {journal, 0, 0}, "is missing: a session of the shard was removed",
                        "make the shard again, into an empty folder");
  const std::string there = to.out + "/plan.txt";
  if (fs::exists(there) && contentsOf(there) != contentsOf(from.out + "/plan.txt"))
    diagnostics.error(kNoFolder, {to.out, 0, 0}, "holds studies of another experiment, level or seed",
                      "give another --out");
}

/// Puts the sessions of a shard's plan into the merged one.
void takeSessions(const StudiesPlan& from, const StudiesPlan& to, std::uint64_t seed) {
  putFile(from.out + "/plan.txt", to.out + "/plan.txt");
  for (const StudySession& session : sessionsOf(from, seed)) {
    const fs::path folder = folderOf(session.data, session.subject_id, 1).path;
    putSession(folder, to.out / fs::relative(folder, from.out));
  }
}

}  // namespace

int simulateShard(const Simulation& wanted) {
  const StudiesPlan& plan = wanted.plan;
  const auto experiment = readSimulated(plan);
  if (!experiment) return kExitBadInput;
  const std::string work = workOf(wanted, *experiment);
  if (!cluster::holdsShard(plan.out, plan.shard, work)) {
    if (const int status = simulate(wanted); status != kExitOk) return status;
    cluster::writeShardFile(plan.out, plan.shard, work, storedOf(wanted));
  }
  std::printf("Shard %s. When all shards are there: presa experiment simulate merge FOLDER… --out FOLDER\n",
              cluster::textOf(plan.shard).c_str());
  return kExitOk;
}

int mergeShards(const std::vector<std::string>& folders, const std::string& out) {
  Diagnostics diagnostics;
  const auto shards = cluster::readShards(folders, "presa experiment simulate", diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  Simulation wanted;
  try {
    wanted = simulationFrom(shards.front().content);
  } catch (const json::exception&) {
    cluster::tellDamaged(shards.front().head.folder, diagnostics);
    throw InputError(std::move(diagnostics));
  }
  wanted.plan.out = out;
  for (const std::string& file :
       {wanted.plan.experiment_file, wanted.plan.rig_file})  // as for those who made the shards
    if (!file.empty()) input::allowFolder(fs::path(file).parent_path().string());
  const auto experiment = readSimulated(wanted.plan);
  if (!experiment) return kExitBadInput;
  if (workOf(wanted, *experiment) != shards.front().head.work)
    refuse(kOfAnother, wanted.plan.experiment_file,
           "has changed since the shards were made, or a file that it names has", "make the shards again");
  const std::vector<StudiesPlan> merged = plansOf(wanted);
  std::vector<std::vector<StudiesPlan>> parts;
  for (const cluster::ShardFile& shard : shards) {
    Simulation part = wanted;
    part.plan.out = shard.head.folder;
    part.plan.shard = shard.head.shard;
    parts.push_back(plansOf(part));
    for (std::size_t k = 0; k < merged.size(); ++k)
      checkSessions(parts.back()[k], merged[k], experiment->seed, diagnostics);
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  for (const auto& part : parts)
    for (std::size_t k = 0; k < merged.size(); ++k) takeSessions(part[k], merged[k], experiment->seed);
  return simulate(wanted);
}

int submitShards(const Simulation& wanted, const cluster::SubmitOptions& on) {
  constexpr const char* kCommand = "presa experiment simulate submit";
  Diagnostics diagnostics;
  cluster::checkCluster(kCommand, on, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  const auto experiment = readSimulated(wanted.plan);
  if (!experiment) return kExitBadInput;
  const cluster::ShardedWork work{
      .command = kCommand,
      .name = "presa_" + experiment->name,
      .folder = fs::absolute(wanted.plan.out).string() + "/shards",
      .words = wordsOf(wanted),
      .is_done = [sessions = workOf(wanted, *experiment)](const std::string& folder, const cluster::Shard& shard) {
        return cluster::holdsShard(folder, shard, sessions);
      }};
  if (const auto status = cluster::submitShards(work, on)) return *status;
  return mergeShards(cluster::shardFolders(work, on), wanted.plan.out);
}

}  // namespace presa::experiment
