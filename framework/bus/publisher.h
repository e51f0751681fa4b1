#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "framework/bus/guide_desk.h"
#include "framework/bus/parameter_server.h"
#include "framework/bus/state_bus.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

namespace presa::bus {

/// Publishes every free body and finger of a run once per tick of the bus group. Only reads its ports, which the haptic
/// thread fills wait-free. Ports, all optional: device_state, contact_exchange, force_command, object_state; only when
/// the rig has frames also frame_state; only when the run takes commands (RunOptions::bus_commands) also the out port
/// surface_settings to the haptic thread; only when its guide is in a viewer (RunOptions::guide) assembly_state, and
/// the out ports guide_orders and guide_report.
class Publisher final : public Module, public Commandable, public Guidable {
 public:
  using Open = std::function<std::unique_ptr<Writer>()>;
  /// All three are called in start(), on the thread of the group, and may throw InputError; `open_post` only when the
  /// run takes commands, `open_orders` only when its guide is in a viewer.
  Publisher(std::shared_ptr<const World> world, const RunOptions& options, Open open,
            ParameterServer::Open open_post = {}, GuideDesk::Open open_orders = {});
  ~Publisher() override;
  void start() override;
  void step(const Tick& tick) noexcept override;
  void stop() override;
  std::vector<std::string> stages() const override;
  ParameterServer* parameterServer() noexcept override { return server_ ? &server_->server : nullptr; }
  GuideDesk* guideDesk() noexcept override { return guide_ ? &guide_->desk : nullptr; }

 private:
  struct Server {
    Server(Module& owner, const Scene& scene, ParameterServer::Open open)
        : settings(owner, "surface_settings"), server(scene, std::move(open)) {}
    Out<SurfaceSettings> settings;
    ParameterServer server;
  };

  struct GuideEnd {
    GuideEnd(Module& owner, const Scene& scene, bool realtime, GuideDesk::Open open);
    void serve(const Stamp& stamp) noexcept;
    In<AssemblyState> assembly;
    Out<GuideOrders> orders;
    Out<GuideReport> report;
    GuideDesk desk;
  };

  void fillObjects(const Stamp& stamp) noexcept;
  void fillFingers(const Stamp& stamp) noexcept;
  void fillFrames(const Stamp& stamp) noexcept;
  void publishEvents(const Stamp& stamp) noexcept;

  std::shared_ptr<const World> world_;
  const bool realtime_;
  Open open_;
  std::unique_ptr<Server> server_;
  std::unique_ptr<GuideEnd> guide_;
  In<DeviceState> device_{*this, "device_state", In<DeviceState>::Optional{}};
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ForceCommand> command_{*this, "force_command", In<ForceCommand>::Optional{}};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};

  std::optional<In<FrameState>> frames_;  // only where the rig has some

  std::unique_ptr<Writer> writer_;
  std::uint64_t run_ = 0;
  Heartbeat heartbeat_;
  std::vector<ObjectSample> object_samples_;
  std::vector<FingerSample> finger_samples_;
  std::vector<FrameSample> frame_samples_;  // none before the first state
  std::uint32_t reported_status_ = 0, reported_faults_ = 0;
};

/// Random id of a run, never 0.
std::uint64_t newRunId();

}  // namespace presa::bus
