#include "framework/record/record_plugin/flight_buffer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "framework/core/diagnostics/refuse.h"
#include "framework/core/schedule/rates.h"

namespace presa::record {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxFiles = 99;  // per run: a device that faults repeatedly must not fill the disk

void checkFolder(const std::string& file) {
  fs::path folder = fs::path(file).parent_path();
  if (folder.empty()) folder = ".";
  if (access(folder.c_str(), W_OK | X_OK) == 0) return;
  refuse(602, "--flight", "'" + file + "' could not be written: " + std::strerror(errno),
         "choose another name or folder");
}

}  // namespace

FlightBuffer::FlightBuffer(std::shared_ptr<const World> world, RunOptions options, RecordedDevices devices)
    : world_(std::move(world)),
      options_(std::move(options)),
      devices_(std::move(devices)),
      layout_(layoutOf(*world_, devices_)),
      capacity_(static_cast<std::size_t>(std::ceil(kBefore * RateTable(world_->scene.rates).rate(RateGroup::kHaptic)))),
      after_(static_cast<std::size_t>(std::ceil(kAfter * RateTable(world_->scene.rates).rate(RateGroup::kHaptic)))),
      kept_(capacity_ * layout_.words()) {
  checkFolder(options_.flight);
  const Sha256 loaded;  // loads the plug-in now rather than at the first fault
}

void FlightBuffer::nameInputs(const ScheduleInputs& inputs) {
  inputs_ = inputs;
  if (file_) file_->nameInputs(inputs_);
}

void FlightBuffer::append(const std::uint64_t* rows, std::size_t count) {
  if (missing_ == 0) close();  // not earlier: the schedule of the last rows arrives after the rows
  for (std::size_t i = 0; i < count; ++i) {
    std::copy_n(rows + i * layout_.words(), layout_.words(), &kept_[next_ * layout_.words()]);
    next_ = (next_ + 1) % capacity_;
    filled_ = std::min(filled_ + 1, capacity_);
  }
  if (!file_) return;
  const std::size_t taken = std::min(count, missing_);
  file_->append(rows, taken);
  missing_ -= taken;
}

void FlightBuffer::appendSchedule(RateGroup group, const ScheduleRow* rows, std::size_t count) {
  auto& kept = schedule_[static_cast<std::size_t>(group)];
  const auto max = static_cast<std::size_t>(kBefore * RateTable(world_->scene.rates).rate(group)) + 1;
  kept.insert(kept.end(), rows, rows + count);
  if (kept.size() > max) kept.erase(kept.begin(), kept.end() - static_cast<std::ptrdiff_t>(max));
  if (file_) file_->appendSchedule(group, rows, count);
}

void FlightBuffer::addFault(const std::string& what) {
  if (missing_ == 0) close();  // this fault belongs to the next file
  if (!file_) begin();
  if (file_) file_->addFault(what);
}

void FlightBuffer::begin() {
  const std::string name = nextName();
  if (name.empty()) return;
  RunOptions options = options_;
  options.record = name;
  try {
    file_ = std::make_unique<RecordingFile>(*world_, options, devices_);
  } catch (const InputError& error) {
    throw h5::Failure(error.what());
  }
  files_.push_back(name);
  missing_ = after_;
  file_->nameInputs(inputs_);
  const std::size_t oldest = filled_ < capacity_ ? 0 : next_;
  const std::size_t to_the_end = std::min(filled_, capacity_ - oldest);
  file_->append(&kept_[oldest * layout_.words()], to_the_end);
  if (to_the_end < filled_) file_->append(kept_.data(), filled_ - to_the_end);
  for (int g = 0; g < kScheduledGroupCount; ++g) {
    const auto& kept = schedule_[static_cast<std::size_t>(g)];
    const std::vector<ScheduleRow> rows(kept.begin(), kept.end());
    if (!rows.empty()) file_->appendSchedule(static_cast<RateGroup>(g), rows.data(), rows.size());
  }
  file_->flush();
}

void FlightBuffer::close() {
  if (!file_) return;
  file_->writeDropped(dropped_);
  file_->finish();
  file_.reset();
}

std::string FlightBuffer::nextName() const {
  const fs::path first = options_.flight;
  for (int number = 1; number <= kMaxFiles; ++number) {
    const std::string tail = number == 1 ? "" : "-" + std::to_string(number);
    const fs::path name = first.parent_path() / (first.stem().string() + tail + first.extension().string());
    if (!fs::exists(name)) return name;
  }
  return {};
}

void FlightBuffer::writeDropped(std::uint64_t dropped) { dropped_ = dropped; }

void FlightBuffer::flush() {
  if (file_) file_->flush();
}

void FlightBuffer::rollBack() noexcept {
  if (file_) file_->rollBack();
  file_.reset();
}

}  // namespace presa::record
