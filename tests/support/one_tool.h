#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "framework/core/graph/graph_builder.h"
#include "framework/haptics/tool_renderer.h"
#include "modules/haptics_proxy/haptics_proxy.h"
#include "tests/support/finger_world.h"

namespace presa::test {

/// A scene whose device "finger" holds a tool. `tool`: the element; `settings`: of the tool `renderer`; `bodies`: the
/// bodies, of materials "smooth" and "rough" (static friction 0.5, dynamic 0.4).
inline std::shared_ptr<const World> toolWorld(const std::string& tool, const std::string& bodies,
                                              const std::string& settings = "",
                                              const std::string& renderer = "pointshell") {
  return fingerWorld(R"(<scene version="1.1" name="tool"><world gravity="0 0 0"/><haptics tools=")" + renderer +
                     R"(">)" + settings + R"(</haptics><materials><material name="smooth" stiffness="1000"/>
    <material name="rough" stiffness="1000"><friction static="0.5" dynamic="0.4"/></material></materials>)" +
                     bodies + R"(<devices><device role="finger">)" + tool + "</device></devices></scene>");
}

/// A fixed slab whose upper side is z = 0.
inline std::string slab(const std::string& material = "smooth") {
  return R"(<body name="slab" fixed="true" material=")" + material +
         R"(" pos="0 0 -0.05"><haptic><box size="0.4 0.4 0.1"/></haptic></body>)";
}

/// A turn about an axis by degrees.
inline Quat turned(const Vec3& axis, double degrees) {
  return Quat(Eigen::AngleAxisd(degrees * EIGEN_PI / 180, axis.normalized()));
}

/// One tool in a world, rendered by the module in a graph, tick by tick.
class OneTool {
 public:
  explicit OneTool(std::shared_ptr<const World> world) : world_(std::move(world)) {
    GraphBuilder builder;
    device_ = &builder.add(std::make_unique<Source<DeviceState>>("device_state"));
    device_->out.value = DeviceState(1);
    objects_ = &builder.add(std::make_unique<Source<ObjectState>>("object_state"));
    objects_->out.value.bodies.resize(world_->scene.bodies.size());
    for (std::size_t b = 0; b < world_->scene.bodies.size(); ++b) {
      BodyMotion& motion = objects_->out.value.bodies[b];
      motion.X_WB_begin = motion.X_WB_end = world_->scene.bodies[b].X_WB;
    }
    builder.add(std::make_unique<HapticsProxy>(world_, RunOptions{}));
    sink_ = &builder.add(std::make_unique<Sink>());
    builder.connectByName();
    graph_ = builder.build();
  }

  /// A tick with the handle at this pose; its velocity is that since the last one.
  const FingerContact& tick(const Pose& X_WH) {
    FingerInput input{X_WH.p, (X_WH.p - last_) * 1000, -1, true};
    if (index_ == 0) input.v_WH = Vec3::Zero();
    last_ = X_WH.p;
    input.oriented = true;
    input.buttons = buttons;
    input.q_WT = X_WH.q;
    device_->out.value.fingers[0] = input;
    graph_.step(RateGroup::kHaptic, {index_, 1e-3 * static_cast<double>(index_), 1e-3});
    ++index_;
    return sink_->contact->fingers[0];
  }
  /// `count` ticks at rest; the last one's contact.
  const FingerContact& rest(const Pose& X_WH, int count) {
    for (int i = 1; i < count; ++i) tick(X_WH);
    return tick(X_WH);
  }
  const ToolState& state() const { return sink_->tools->tools[0]; }
  const ContactExchange& all() const { return sink_->contact.value(); }
  ObjectState& objects() { return objects_->out.value; }
  const World& world() const { return *world_; }

  std::uint32_t buttons = 0;  ///< pressed in the next ticks

 private:
  template <class T>
  struct Source final : Module {
    explicit Source(const char* port)
        : Module(std::string("source_of_") + port, RateGroup::kHaptic), out(*this, port) {}
    void step(const Tick&) noexcept override {}
    Out<T> out;
  };
  struct Sink final : Module {
    Sink() : Module("sink", RateGroup::kHaptic) {}
    void step(const Tick&) noexcept override {}
    In<ContactExchange> contact{*this, "contact_exchange"};
    In<ToolStates> tools{*this, kToolStatesPort};
  };

  std::shared_ptr<const World> world_;
  Graph graph_;
  Source<DeviceState>* device_ = nullptr;
  Source<ObjectState>* objects_ = nullptr;
  Sink* sink_ = nullptr;
  std::uint64_t index_ = 0;
  Vec3 last_ = Vec3::Zero();
};

}  // namespace presa::test
