#include "modules/haptics_proxy/held_tools.h"

#include <algorithm>
#include <limits>

#include "framework/haptics/renderers.h"

namespace presa {

HeldTools::HeldTools(Module& owner, const World& world, const std::vector<Material>& materials)
    : materials_(materials),
      renderer_(makeToolRenderer(world)),
      forces_(renderer_->maxForces()),
      states_(owner, kToolStatesPort) {
  const std::vector<DeviceRole>& roles = world.scene.devices;
  for (std::size_t d = 0; d < roles.size(); ++d) {
    grips_.emplace_back();
    if (!roles[d].tool) continue;
    roles_.push_back(d);
    if (roles[d].tool->put_down) grips_.back().emplace(*roles[d].tool->put_down, boundsOf(*world.tools[d]));
  }
  states_.value.tools.resize(roles.size());
}

void HeldTools::step(const DeviceState& devices, double period, const Touchables& touchables,
                     ContactExchange& out) noexcept {
  for (const std::size_t d : roles_) touch(d, devices.fingers[d], period, touchables, out);
}

void HeldTools::touch(std::size_t d, const FingerInput& input, double period, const Touchables& touchables,
                      ContactExchange& all) noexcept {
  FingerContact& out = all.fingers[d];
  ToolState& state = states_.value.tools[d];
  out = {};
  out.has_volume = true;
  out.p_WH = out.p_WP = out.p_BP = input.p_WH;
  out.v_WH = input.v_WH;
  state.f_H_W = state.t_H_W = Vec3::Zero();
  if (!input.valid) {
    state.alive = state.lies;
    return;
  }
  const double share = grips_[d] ? grips_[d]->step(input, period, state) : 1;
  if (state.lies) {
    state.points = 0;
    state.depth = 0;
    return;
  }
  // where the hand wants the tool, and how fast
  Pose X_WH{input.p_WH, input.q_WT};
  Vec3 v_WH = input.v_WH;
  if (grips_[d]) {
    X_WH = X_WH * state.X_HT;
    v_WH += input.w_WT.cross(X_WH.p - input.p_WH);
  }
  if (!state.alive) state.X_WT = X_WH;
  forces_.clear();
  renderer_->touch({d, X_WH, v_WH, input.w_WT, period, touchables, materials_}, forces_, state);
  state.alive = true;
  if (forces_.lost() > 0) ++all.coverage_lost;
  if (!keepsContract(forces_, state.X_WT, touchables) || !(state.f_H_W + state.t_H_W).allFinite()) [[unlikely]] {
    broken_.store(true, std::memory_order_release);
    out.f_H_W.setConstant(std::numeric_limits<double>::quiet_NaN());
    state.X_WT = X_WH;
    return;
  }
  out.p_WP = out.p_BP = state.X_WT.p;
  if (!forces_.empty()) write(input, share, touchables, all, out);
  out.f_H_W += share * state.f_H_W;
  out.t_H_W += share * (state.t_H_W + (X_WH.p - input.p_WH).cross(state.f_H_W));
}

// Sums the forces of one tool, of which only a share acts, and lists them.
void HeldTools::write(const FingerInput& input, double share, const Touchables& touchables, ContactExchange& all,
                      FingerContact& out) noexcept {
  for (ToolForce& one : forces_) one.f_W *= share;
  const auto strongest = std::max_element(forces_.begin(), forces_.end(), [](const ToolForce& a, const ToolForce& b) {
    return a.f_W.squaredNorm() < b.f_W.squaredNorm();
  });
  out.first_contact = static_cast<std::uint32_t>(all.contacts.size());
  out.body = strongest->body;
  out.mode = ContactMode::kSlip;
  Vec3 pressure = Vec3::Zero();
  for (const ToolForce& one : forces_) {
    const Pose X_BW = touchables.frameOf(one.body).inverse();
    const Vec3 stretch = one.f_W / one.stiffness;
    all.contacts.add({.body = one.body,
                      .p_BP = X_BW * one.p_W,
                      .p_WP = one.p_W,
                      .nhat_B = X_BW.q * one.nhat_W,
                      .v_WH = input.v_WH + input.w_WT.cross(one.p_W - input.p_WH),
                      .stretch_W = stretch,
                      .depth = stretch.dot(one.nhat_W),
                      .stiffness = one.stiffness,
                      .mode = one.slips ? ContactMode::kSlip : ContactMode::kStick,
                      .friction_static = one.friction_static,
                      .friction_dynamic = one.friction_dynamic,
                      .f_H_W = one.f_W});
    if (!one.slips) out.mode = ContactMode::kStick;
    out.f_H_W += one.f_W;
    out.t_H_W += (one.p_W - input.p_WH).cross(one.f_W);
    pressure += one.f_W.dot(one.nhat_W) * one.nhat_W;
    out.stiffness += one.stiffness;
  }
  out.contact_count = static_cast<std::uint32_t>(all.contacts.size()) - out.first_contact;
  // pressed from two sides alike, there is no common normal
  out.nhat_W = pressure.norm() > 1e-9 ? Vec3(pressure.normalized()) : strongest->nhat_W;
  const Pose X_BW = touchables.frameOf(out.body).inverse();
  out.nhat_B = X_BW.q * out.nhat_W;
  out.p_BP = X_BW * out.p_WP;
  out.p_BC = X_BW * strongest->p_W;
  out.normal_force = std::max(0.0, out.f_H_W.dot(out.nhat_W));
  out.tangential_force_W = out.f_H_W - out.normal_force * out.nhat_W;
  out.depth = out.normal_force / out.stiffness;
  out.friction_static = strongest->friction_static;
  out.friction_dynamic = strongest->friction_dynamic;
}

}  // namespace presa
