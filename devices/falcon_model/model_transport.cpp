#include "devices/falcon_model/model_transport.h"

#include <limits>

namespace presa::falcon_model {

std::unique_ptr<ModelTransport> ModelTransport::open(FalconModel& model) {
  if (!model.claim()) return nullptr;
  return std::unique_ptr<ModelTransport>(new ModelTransport(model));
}

ModelTransport::~ModelTransport() {
  if (!lost()) model_.release();
}

bool ModelTransport::lost() const noexcept { return !model_.plugged() || model_.powerUps() != power_up_; }

bool ModelTransport::control(falcon::Control control, double now) noexcept {
  if (lost()) return false;
  collect(now);
  const falcon::FtdiRequest request = falcon::ftdiRequestOf(control);
  if (!model_.vendorRequest(request.request, request.value, now)) return false;
  if (control == falcon::Control::kPurgeReceive || control == falcon::Control::kReset) arrived_.clear();
  return true;
}

bool ModelTransport::write(std::span<const std::uint8_t> bytes, double now) noexcept {
  return !lost() && bytes.size() <= falcon::kMaxWrite && model_.hostWrites(bytes, now);
}

void ModelTransport::collect(double now) {
  constexpr double kAlways = -std::numeric_limits<double>::infinity();
  while (const auto packet = model_.toHost(now, kAlways)) {
    arrived_.insert(arrived_.end(), packet->bytes.begin(), packet->bytes.end());
  }
}

std::size_t ModelTransport::read(std::span<std::uint8_t> buffer, double now) noexcept {
  if (!lost()) collect(now);
  std::size_t count = 0;
  for (; count < buffer.size() && !arrived_.empty(); ++count) {
    const WireByte byte = arrived_.front();
    arrived_.pop_front();
    buffer[count] = byte.value;
    model_.hostHasRead(byte, now);
  }
  return count;
}

}  // namespace presa::falcon_model
