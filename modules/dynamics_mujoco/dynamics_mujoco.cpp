#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "framework/core/graph/port.h"
#include "framework/core/state/object_state.h"
#include "framework/session/module_plugin.h"
#include "modules/dynamics_mujoco/mjcf.h"

namespace presa::mujoco {
namespace {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

mjModel* compile(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[512] = "";
  mjModel* model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
  mj_deleteFileVFS(files.get(), "scene.xml");
  if (model != nullptr) return model;
  Diagnostics diagnostics;
  diagnostics.error(581, {"dynamics_mujoco", 0, 0}, std::string("the engine does not take this scene: ") + error);
  throw InputError(diagnostics);
}

/// The free bodies of a scene, stepped by MuJoCo. Thread: dynamics.
class DynamicsMujoco final : public Module {
 public:
  explicit DynamicsMujoco(std::shared_ptr<const World> world)
      : Module("dynamics_mujoco", RateGroup::kDynamics), world_(std::move(world)) {
    objects_.value.bodies.resize(world_->scene.bodies.size());
    substeps_ = std::max<std::size_t>(1, world_->scene.dynamics.substeps);
    step_ = 1 / (world_->scene.rates.dynamics * static_cast<double>(substeps_));
    model_.reset(compile(mjcfOf(*world_, step_)));
    data_.reset(mj_makeData(model_.get()));
    place();
  }

  void start() override {
    write(objects_.value);
    write(objects_.value);
    objects_.value.time_begin = objects_.value.time_end = 0;
  }

  void step(const Tick& tick) noexcept override {
    for (std::size_t i = 0; i < substeps_; ++i) mj_step(model_.get(), data_.get());
    write(objects_.value);
    objects_.value.time_begin = tick.time;
    objects_.value.time_end = tick.time + tick.period;
  }

  std::vector<std::string> stages() const override {
    const bool iterative = world_->scene.dynamics.solver == DynamicsSettings::Solver::kIterative;
    return {std::string("collide and solve by MuJoCo (") + (iterative ? "conjugate gradients" : "Newton") +
            ", elliptic cones), " + std::to_string(substeps_) + " step(s) a period"};
  }

 private:
  /// Sets start velocities and constant forces; start poses are in the model.
  void place() {
    int address = 0;
    for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i) {
      const Body& body = world_->scene.bodies[i];
      if (body.fixed) continue;
      const Vec3 w_B = body.X_WB.q.conjugate() * body.w_WB;  // MuJoCo: angular velocity of a free joint in body axes
      const Vec3 v_WB = body.v_WCm - body.w_WB.cross(body.X_WB.q * world_->inertias[i].p_BCm);
      for (int k = 0; k < 3; ++k) {
        data_->qvel[address + k] = v_WB[k];
        data_->qvel[address + 3 + k] = w_B[k];
        data_->xfrc_applied[6 * (i + 1) + static_cast<std::size_t>(k)] = body.force_W[k];
      }
      address += 6;
    }
  }

  void write(ObjectState& out) noexcept {
    const std::vector<Body>& bodies = world_->scene.bodies;
    int q = 0, v = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      BodyMotion& motion = out.bodies[i];
      motion.X_WB_begin = motion.X_WB_end;
      if (bodies[i].fixed) {
        motion.X_WB_begin = motion.X_WB_end = bodies[i].X_WB;
        continue;
      }
      const double* p = data_->qpos + q;
      motion.X_WB_end = {Vec3(p[0], p[1], p[2]), Quat(p[3], p[4], p[5], p[6])};
      motion.v_WB = Vec3(data_->qvel[v], data_->qvel[v + 1], data_->qvel[v + 2]);
      motion.w_WB = motion.X_WB_end.q * Vec3(data_->qvel[v + 3], data_->qvel[v + 4], data_->qvel[v + 5]);
      q += 7;
      v += 6;
    }
  }

  std::shared_ptr<const World> world_;
  std::size_t substeps_ = 1;
  double step_ = 0;
  std::unique_ptr<mjModel, DeleteModel> model_;
  std::unique_ptr<mjData, DeleteData> data_;
  Out<ObjectState> objects_{*this, "object_state"};
};

const ModulePlugin kPlugin{
    .name = "dynamics_mujoco",
    .create = [](std::shared_ptr<const World> world, const RunOptions&) -> std::unique_ptr<Module> {
      return std::make_unique<DynamicsMujoco>(std::move(world));
    },
    .library = [] { return std::string("MuJoCo ") + mj_versionString(); }};

}  // namespace
}  // namespace presa::mujoco

PRESA_MODULE_PLUGIN(presa::mujoco::kPlugin)
