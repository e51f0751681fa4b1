#include "modules/dynamics_ode/joints/engine_joints.h"

namespace presa::ode {
namespace {

void setAxis(dJointID joint, const JointAxis& axis, void (*set)(dJointID, int, dReal)) {
  set(joint, dParamLoStop, axis.lower.value_or(-dInfinity));
  set(joint, dParamHiStop, axis.upper.value_or(dInfinity));
  set(joint, dParamVel, axis.max_force > 0 ? axis.speed : 0);
  set(joint, dParamFMax, axis.max_force > 0 ? axis.max_force : axis.friction);
}

}  // namespace

EngineJoints::EngineJoints(const World& world, const BodySet& bodies, dWorldID ode_world) {
  for (const Joint& joint : world.scene.joints) {
    const Pose X_WB = world.scene.bodies[joint.body].X_WB;
    const Vec3 p = X_WB * joint.p_BJ;
    Vec3 d = joint.axes.empty() ? Vec3(Vec3::UnitZ()) : Vec3(X_WB.q * joint.axes[0].dhat_B);
    const dBodyID body = bodies.body(joint.body), to = joint.to == Joint::kWorld ? nullptr : bodies.body(joint.to);
    dJointID made = nullptr;
    switch (joint.type) {
      case JointType::kHinge:
        made = dJointCreateHinge(ode_world, nullptr);
        dJointAttach(made, body, to);
        dJointSetHingeAnchor(made, p.x(), p.y(), p.z());
        if (body == nullptr) d = -d;  // the engine then swaps the two, but not the sense of a hinge
        dJointSetHingeAxis(made, d.x(), d.y(), d.z());
        setAxis(made, joint.axes[0], dJointSetHingeParam);
        break;
      case JointType::kSlider:
        made = dJointCreateSlider(ode_world, nullptr);
        dJointAttach(made, body, to);
        dJointSetSliderAxis(made, d.x(), d.y(), d.z());
        setAxis(made, joint.axes[0], dJointSetSliderParam);
        break;
      case JointType::kBall:
        made = dJointCreateBall(ode_world, nullptr);
        dJointAttach(made, body, to);
        dJointSetBallAnchor(made, p.x(), p.y(), p.z());
        break;
      default:  // a scene with another kind is refused
        made = dJointCreateFixed(ode_world, nullptr);
        dJointAttach(made, body, to);
        dJointSetFixed(made);
    }
    joints_.push_back(made);
  }
}

EngineJoints::~EngineJoints() {
  for (const dJointID joint : joints_) dJointDestroy(joint);
}

}  // namespace presa::ode
