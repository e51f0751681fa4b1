#pragma once
#include <deque>
#include <memory>

#include "devices/falcon_model/falcon_model.h"
#include "devices/novint_falcon/transport.h"

namespace presa::falcon_model {

/// The host's side of the model's socket, without a bus: it always has reads pending. Uses the model's time. Thread:
/// the model's.
class ModelTransport final : public falcon::FalconTransport {
 public:
  /// Null when the device is unplugged or taken. The model must outlive the transport.
  static std::unique_ptr<ModelTransport> open(FalconModel& model);
  ~ModelTransport() override;
  ModelTransport(const ModelTransport&) = delete;
  ModelTransport& operator=(const ModelTransport&) = delete;

  bool control(falcon::Control control, double now) noexcept override;
  bool write(std::span<const std::uint8_t> bytes, double now) noexcept override;
  std::size_t read(std::span<std::uint8_t> buffer, double now) noexcept override;
  bool lost() const noexcept override;

 private:
  explicit ModelTransport(FalconModel& model) : model_(model), power_up_(model.powerUps()) {}
  void collect(double now);

  FalconModel& model_;
  int power_up_;
  std::deque<WireByte> arrived_;
};

}  // namespace presa::falcon_model
