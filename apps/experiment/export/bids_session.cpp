#include "apps/experiment/export/bids_session.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>

#include "apps/common/delimited.h"
#include "apps/common/file_text.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/export/cells.h"
#include "framework/record/record_plugin.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTracking = "presa";
constexpr std::time_t kYear1900 = -2208988800;

std::string seconds(double value) { return terminal::format("%.6f", value); }

/// Columns left out of the BIDS table: file names hold subject and session; `file` is a name in the source folder.
bool leftOut(const SourceColumn& column) {
  static const std::set<std::string> kNames{"subject", "session", "file"};
  return kNames.contains(column.name);
}

}  // namespace

void Tsv::add(const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::string cell = cells[i].empty() ? kNothing : cells[i];
    std::replace_if(
        cell.begin(), cell.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    text_ += (i > 0 ? "\t" : "") + quotedCell(cell, '\t');
  }
  text_ += '\n';
}

std::time_t instantOf(const std::string& utc) {
  std::tm parts{};
  return ::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) == nullptr ? 0 : ::timegm(&parts);
}

std::string shifted(const std::string& utc, std::time_t zero) {
  const std::time_t instant = instantOf(utc) - zero + kYear1900;
  std::tm parts{};
  ::gmtime_r(&instant, &parts);
  std::array<char, 32> written{};
  std::strftime(written.data(), written.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return written.data();
}

std::string BidsSession::labelOf(const std::string& name) {
  std::string label;
  std::copy_if(name.begin(), name.end(), std::back_inserter(label),
               [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; });
  return label.empty() ? "experiment" : label;
}

BidsSession::BidsSession(const SourceSession& source, std::time_t zero, const StagedFolder& out)
    : source_(source),
      zero_(zero),
      out_(out),
      folder_("sub-" + source.log.start.subject.id + "/ses-" + std::to_string(source.log.start.session) + "/"),
      prefix_(source.prefix() + "_task-" + labelOf(source.name())) {}

bool BidsSession::write(const Continue& more) {
  Tsv beh(behaviourHeader());
  const std::string beh_file = "beh/" + prefix_ + "_beh";
  scanned(beh_file + ".tsv", source_.start.value("utc", ""));
  for (std::size_t run = 0; run < source_.log.runs.size(); ++run) {
    if (ended(source_.log.runs[run]) && !writeRun(run, beh, more)) return false;
  }
  out_.write(folder_ + beh_file + ".tsv", beh.text());
  out_.write(folder_ + source_.prefix() + "_scans.tsv", scans_.text());
  writeDictionaries();
  writeSourceData();
  return true;
}

bool BidsSession::writeRun(std::size_t run, Tsv& beh, const Continue& more) {
  const LoggedRun& logged = source_.log.runs[run];
  const std::vector<std::string> files = source_.recordings(logged);
  std::vector<std::string> cells;
  for (std::size_t c = 0; c < source_.columns.size(); ++c) {
    if (!leftOut(source_.columns[c])) cells.push_back(c < source_.rows[run].size() ? source_.rows[run][c] : kNothing);
  }
  cells.push_back(files.empty() ? kNothing : std::to_string(recordings_ + 1));
  beh.add(cells);
  for (std::size_t i = 0; i < files.size(); ++i) {
    writeRecording(logged, files[i], i);
    if (!more(source_.prefix() + " " + files[i])) return false;
  }
  return true;
}

void BidsSession::writeRecording(const LoggedRun& run, const std::string& file, std::size_t presentation) {
  checkUnaltered(source_.folder, file, run.end.at("sha256").at(file));
  const RecordedSamples samples = recordPlugin().samples(source_.folder.file(file));
  const Motion motion(samples);
  const std::string base =
      "motion/" + prefix_ + "_tracksys-" + kTracking + terminal::format("_run-%03d", ++recordings_);
  scanned(base + "_motion.tsv", run.begin.value("utc", ""));
  writeMotion(folder_ + base, motion, run);
  writeEvents(folder_ + base, motion, run, presentation);
}

void BidsSession::writeMotion(const std::string& base, const Motion& motion, const LoggedRun& run) const {
  out_.write(base + "_motion.tsv", motion.rows('\t'));  // the specification forbids a header
  Tsv channels({"name", "component", "type", "tracked_point", "units", "description", "reference_frame"});
  for (const Channel& one : motion.channels()) {
    const bool in_frame = one.component != kNothing;
    channels.add({one.name, one.component, one.type, one.tracked_point, one.units, one.description,
                  in_frame ? "world" : kNothing});
  }
  out_.write(base + "_channels.tsv", channels.text());
  // virtual time is exact; in real time the achieved rate is ticks per wall time
  const double wall = run.end.value("wall_s", 0.0);
  const bool measured = source_.log.start.realtime && wall > 0;
  Json json = taskJson();
  json["SamplingFrequency"] = motion.nominalRate();
  json["SamplingFrequencyEffective"] = measured ? run.end.value("ticks", 0.0) / wall
                                       : motion.duration() > 0
                                           ? static_cast<double>(motion.ticks() - 1) / motion.duration()
                                           : motion.nominalRate();
  json["RecordingDuration"] = motion.duration();
  json["TrackingSystemName"] = kTracking;
  json["TrackedPointsCount"] = motion.trackedPoints();
  json["MotionChannelCount"] = motion.count("POS") + motion.count("ORNT");
  for (const char* type : {"LATENCY", "POS", "ORNT", "MISC"})
    json[std::string(type) + "ChannelCount"] = motion.count(type);
  json["MissingValues"] = kNothing;
  json["SoftwareVersions"] = "Presa " + source_.start.value("presa", "");
  out_.write(base + "_motion.json", text(json));
}

void BidsSession::writeEvents(const std::string& base, const Motion& motion, const LoggedRun& run,
                              std::size_t presentation) const {
  if (!run.end.contains("phases") || run.end.at("phases").size() <= presentation) return;
  std::vector<std::pair<double, std::vector<std::string>>> events;
  for (const auto& [phase, stretch] : run.end.at("phases").at(presentation).items()) {
    if (stretch.at(0).is_null()) continue;  // phase never reached
    const double begin = stretch.at(0).get<double>();
    const std::string duration = stretch.at(1).is_null() ? kNothing : seconds(stretch.at(1).get<double>() - begin);
    events.push_back({begin,
                      {seconds(begin - motion.begin()), duration, phase, std::to_string(run.number),
                       std::to_string(run.run), std::to_string(presentation + 1), toString(run.outcome)}});
  }
  if (events.empty()) return;  // an empty events file is discouraged
  std::stable_sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Tsv table({"onset", "duration", "trial_type", "trial", "trial_run", "presentation", "outcome"});
  for (const auto& [begin, cells] : events) table.add(cells);
  out_.write(base + "_events.tsv", table.text());
}

std::vector<std::string> BidsSession::behaviourHeader() const {
  std::vector<std::string> header;
  for (const SourceColumn& column : source_.columns) {
    if (!leftOut(column)) header.push_back(column.name);
  }
  header.emplace_back("motion_run");
  return header;
}

Json BidsSession::taskJson() const {
  Json json{{"TaskName", source_.name()}};
  if (!source_.description.empty()) json["TaskDescription"] = source_.description;
  if (!source_.instructions.empty()) json["Instructions"] = source_.instructions;
  return json;
}

void BidsSession::writeDictionaries() const {
  Json beh = taskJson();
  for (const SourceColumn& column : source_.columns) {
    if (leftOut(column)) continue;
    beh[column.name] = {{"Description", column.description.empty() ? column.name : column.description}};
    if (!column.unit.empty()) beh[column.name]["Units"] = column.unit;
  }
  beh["motion_run"] = {{"Description", "index of the trial's recording among the motion files (the first of them)"}};
  out_.write(folder_ + "beh/" + prefix_ + "_beh.json", text(beh));
  out_.write(
      folder_ + source_.prefix() + "_scans.json",
      text({{"acq_time",
             {{"Description",
               "when the first sample was taken; all dates of a participant are shifted alike, so that the first "
               "session begins in 1900"}}}}));
  if (recordings_ == 0) return;
  const std::string base = folder_ + "motion/" + prefix_ + "_tracksys-" + kTracking;
  out_.write(base + "_channels.json",
             text({{"reference_frame",
                    {{"Description", "frame in which the channel is to be read"},
                     {"Levels",
                      {{"world",
                        {{"RotationRule", "right-hand"},
                         {"Description", "world frame of the scene: right-handed, z up, metres"}}}}}}}}));
  out_.write(base + "_events.json",
             text({{"onset", {{"Description", "since the first row of the motion file"}, {"Units", "s"}}},
                   {"duration", {{"Description", "n/a: the trial ended in it"}, {"Units", "s"}}},
                   {"trial_type", {{"Description", "phase of the trial, as the experiment names it"}}},
                   {"trial", {{"Description", "number of the trial, as in the table of beh"}}},
                   {"trial_run", {{"Description", "column run of the table in beh"}}},
                   {"presentation", {{"Description", "1, or the interval of a trial that compares"}}},
                   {"outcome", {{"Description", "of the trial's run: done, aborted or skipped"}}}}));
}

void BidsSession::writeSourceData() const {
  for (const char* name : {"experiment.xml", "scene.xml", "rig.xml"}) {
    out_.write("sourcedata/" + folder_ + name, contentsOf(source_.folder.file(name)));
  }
}

void BidsSession::scanned(const std::string& file, const std::string& utc) { scans_.add({file, shifted(utc, zero_)}); }

}  // namespace presa::experiment
