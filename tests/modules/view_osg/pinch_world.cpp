#include "tests/modules/view_osg/pinch_world.h"

#include "framework/core/graph/port.h"

namespace presa::view_test {
namespace {

Body makeBox(const std::string& name, const Vec3& size, const Vec3& p_WB, bool fixed, std::size_t material) {
  Body body;
  body.name = name;
  body.fixed = fixed;
  body.X_WB.p = p_WB;
  body.material = material;
  body.haptic = body.physics = Geometry{Box{size}, Pose{}, {}};
  return body;
}

template <class T>
In<T>& port(Module& module, const std::string& name) {
  for (InPortBase* in : module.inputs())
    if (in->name() == name) return dynamic_cast<In<T>&>(*in);
  throw std::runtime_error("the view has no port " + name);
}

}  // namespace

Material material(const char* name, double stiffness, double mu_static, double mu_dynamic, const Vec3& color) {
  Material material;
  material.name = name;
  material.stiffness = stiffness;
  material.damping = stiffness / 1000;
  material.friction_static = mu_static;
  material.friction_dynamic = mu_dynamic;
  material.color = color;
  return material;
}

PinchRun makePinchRun(RunOptions::View view, const std::string& screenshot) {
  auto world = std::make_shared<World>();
  Scene& scene = world->scene;
  scene.name = "cube";
  scene.materials = {material("wood", 2000, 0.6, 0.5, {0.55, 0.42, 0.30}),
                     material("rubber", 1000, 0.8, 0.6, {0.75, 0.25, 0.2})};
  scene.bodies = {makeBox("table", {0.6, 0.4, 0.04}, {0, 0, -0.02}, true, 0),
                  makeBox("cube", Vec3::Constant(kCubeEdge), {0, 0, kCubeEdge / 2}, false, 1)};
  scene.bodies[1].mass = 0.2;
  for (const char* role : {"thumb", "index"})
    scene.devices.push_back({.role = role, .fingertip_radius = 0.008, .limits = {10, 1000, 20}, .where = {}});
  world->meshes.resize(2);
  world->inertias.resize(2);
  RunOptions options;
  options.view = view;
  options.screenshot = screenshot;
  return {std::move(world), std::move(options)};
}

PinchStates makePinchStates(const World& world, const Vec3& p_WO, double yaw) {
  PinchStates states;
  const Pose X_WO{p_WO, Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()))};
  states.objects.bodies.resize(2);
  states.objects.time_end = 1;
  states.objects.bodies[0].X_WB_begin = states.objects.bodies[0].X_WB_end = world.scene.bodies[0].X_WB;
  states.objects.bodies[1].X_WB_begin = states.objects.bodies[1].X_WB_end = X_WO;

  states.device = DeviceState(2);
  states.contacts = ContactExchange(2);
  states.forces = ForceCommand(2);
  const double radius = world.scene.devices[0].fingertip_radius;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1 : 1;
    FingerContact& contact = states.contacts.fingers[i];
    contact.mode = i == 0 ? ContactMode::kStick : ContactMode::kSlip;
    contact.body = 1;
    contact.nhat_B = side * Vec3::UnitX();
    contact.nhat_W = X_WO.q * contact.nhat_B;
    contact.p_BC = kCubeEdge / 2 * contact.nhat_B + Vec3(0, 0, 0.004);
    contact.p_BP = contact.p_BC + radius * contact.nhat_B;
    contact.p_WP = X_WO * contact.p_BP;
    contact.normal_force = i == 0 ? 3.2 : 3.0;
    contact.tangential_force_W = Vec3(0, 0, i == 0 ? -0.9 : -1.8);
    contact.f_H_W = contact.normal_force * contact.nhat_W + contact.tangential_force_W;
    contact.stiffness = 1000;
    contact.friction_static = 0.8;
    contact.friction_dynamic = 0.6;
    contact.p_WH = contact.p_WP - contact.f_H_W / contact.stiffness;
    contact.depth = contact.normal_force / contact.stiffness;
    states.device.fingers[i].valid = true;
    states.device.fingers[i].p_WH = contact.p_WH;
    states.forces.f_H_W[i] = contact.f_H_W;
  }
  return states;
}

struct Feed::Bridges {
  PinchStates source;
  Bridge<DeviceState> device;
  Bridge<ContactExchange> contacts;
  Bridge<ForceCommand> forces;
  Bridge<ObjectState> objects;
  explicit Bridges(Module& view)
      : device(source.device), contacts(source.contacts), forces(source.forces), objects(source.objects) {
    device.addReader(port<DeviceState>(view, "device_state"));
    contacts.addReader(port<ContactExchange>(view, "contact_exchange"));
    forces.addReader(port<ForceCommand>(view, "force_command"));
    objects.addReader(port<ObjectState>(view, "object_state"));
  }
};

Feed::Feed(Module& view) : bridges_(std::make_unique<Bridges>(view)) {}
Feed::~Feed() = default;

void Feed::publish(const PinchStates& states, double time) {
  bridges_->source = states;
  for (BridgeBase* bridge :
       {static_cast<BridgeBase*>(&bridges_->device), static_cast<BridgeBase*>(&bridges_->contacts),
        static_cast<BridgeBase*>(&bridges_->forces), static_cast<BridgeBase*>(&bridges_->objects)}) {
    bridge->push({0, time, 0});
    bridge->pull(RateGroup::kView, {0, time, 0});
  }
}

}  // namespace presa::view_test
