"""The faults that `./dev mutate` puts in, one at a time. Each is: class, file, fragment (in the file exactly once), what it becomes.

Safety: what stands between any scene and a finger. Core: what the forces and motions are computed with.
A fragment that the file no longer has is an error: then the fault moves with the code, or goes with it.
"""

# Test programs by the beginning of a path, the quickest to find a fault first.
TESTS = {
    "framework/device/": ["device", "supervision"],
    "framework/device/supervision/": ["supervision"],
    "framework/geometry/": ["geometry", "haptics", "surface"],
    "framework/scene/": ["scene", "geometry"],
    "framework/core/state/": ["graph", "dynamics", "haptics"],
    "framework/core/math/": ["math", "haptics", "dynamics"],
    "framework/haptics/surface_effects": ["shading", "texture", "haptics"],
    "framework/haptics/": ["haptics", "surface"],
    "modules/haptics_proxy/": ["haptics", "surface"],
    "modules/god_object/": ["haptics", "surface"],
    "modules/friction_cone/": ["haptics", "surface"],
    "modules/shading/": ["shading", "haptics"],
    "modules/dynamics_ode/": ["dynamics"],
}

STAGE = "framework/device/output_stage.cpp"
LIMITS = "framework/device/output_limits.cpp"
MODULES = "framework/device/device_modules.cpp"
SAMPLE = "framework/device/sample_check.h"
HEAT = "framework/device/thermal_budget.h"
ENERGY = "framework/device/passivity_controller.h"
WATCH = "framework/device/transport_watch.cpp"
KEEPER = "framework/device/supervision/command_keeper.h"
SUPERVISOR = "framework/device/supervision/supervisor.cpp"
SUPERVISED = "framework/device/supervision/supervised_device.cpp"

SAFETY = [
    # the output stage
    (STAGE, "clampMagnitude(wanted, part.max, kOutputMagnitude)", "clampMagnitude(wanted, 1e9, kOutputMagnitude)"),
    (STAGE, "if (const double norm = force.norm(); norm > max) {", "if (const double norm = force.norm(); norm > 1e9) {"),
    (STAGE, "largest > max) {\n    force *= max / largest;", "false) {\n    force *= max / largest;"),
    (STAGE, "if (!input.command.f.allFinite() || !input.command.t.allFinite()) latches_ |= kOutputNotFinite;", ""),
    (STAGE, "if (input.lost) latches_ |= kOutputLost;", ""),
    (STAGE, "if (input.other_lost) latches_ |= kOutputOther;", ""),
    (STAGE, "if (input.resumed) latches_ |= kOutputGap;", ""),
    (STAGE, "if (over_speed && over_speed_) latches_", "if (over_speed_ && false) latches_"),
    (STAGE, "&& last_.f.dot(input.v_WH) > 0)", "&& last_.f.dot(input.v_WH) < 0)"),
    (STAGE, "if (latches_ == 0) good_ = input.command;", "good_ = input.command;"),
    (STAGE, "  gain_ = 0;\n  over_speed_ = false;", "  gain_ = 1;\n  over_speed_ = false;"),
    (STAGE, "dropped ? gap_ + period : 0;", "dropped ? period : 0;"),
    (STAGE, "fading ? -period / limits_.fade_out", "fading ? period / limits_.fade_out"),
    (STAGE, "period / limits_.soft_start), 0.0, 1.0)", "10 * period / limits_.soft_start), 0.0, 1.0)"),
    (STAGE, "return dropped ? 0 : gain_;", "return gain_;"),
    (STAGE, "input.catch_up ? 0 : force_.rate * period", "input.catch_up ? 0 : 2 * force_.rate * period"),
    (STAGE, "input.catch_up ? 0 : force_", "force_"),
    (STAGE, "if (!(length > max)) return force;", "if (!(length > 1e9)) return force;"),
    (STAGE, "part.budget.step(last.norm(), period);", ""),
    (STAGE, "return clampMagnitude(force, part.budget.maxForce(part.max), kOutputWarm);", "return force;"),
    (STAGE, "if (limits_.passivity) force_.energy.sent(last_.f);", ""),
    # what a rig and a scene may ask for
    (LIMITS, "if (!allowed || *allowed <= rated) return", "if (true) return"),
    (LIMITS, "imagined() ? rating_.force : 0.5 * rating_.force", "rating_.force"),
    (LIMITS, "force = std::min(asked, room);", "force = asked;"),
    (LIMITS, "limits.speed = allowedUpTo(\"speed\", allowed.speed, rating_.speed, \"m/s\");", "limits.speed = rating_.speed;"),
    (LIMITS, "const double rate = std::min(asked, room)", "const double rate = asked"),
    (LIMITS, "if (rate >= slowest) return rate;", "if (true) return rate;"),
    (LIMITS, "std::max(allowed.soft_start.value_or(rating_.soft_start), rating_.soft_start)", "rating_.soft_start"),
    (LIMITS, "allowedUpTo(\"continuous\", allowed.continuous, rating_.continuous, \"N\")", "rating_.continuous"),
    (LIMITS, "if (asked <= rating_.watchdog) return asked;", "if (true) return asked;"),
    # which samples are believed, and what a finger's age does
    (SAMPLE, "(rejected && suspect_)", "false"),
    (SAMPLE, "<= kFastest * since_", "<= 1e9 * since_"),
    (SAMPLE, "good_.valid && since_ <= kHold && input.age <= kHold", "good_.valid"),
    (SAMPLE, "input.v_WH.setZero();", ""),
    (MODULES, "contact_->time < tick.time) return Trust::kDropped", "false) return Trust::kDropped"),
    (MODULES, "objects_->faults != 0", "false"),
    (MODULES, "objects_.age(tick) > watchdog_[finger]", "false"),
    (MODULES, "neighbourhoods_.age(tick) > neighbourhood_age_", "false"),
    (MODULES, ".other_lost = lost > (finger.lost ? 1 : 0)", ".other_lost = false"),
    (MODULES, "if (!tick.catch_up) devices_", "devices_"),
    (MODULES, "if (device_->rearms != rearms_) stages_[f].rearm();", ""),
    # motors and energy
    (HEAT, "load * load - heat_", "load - heat_"),
    (HEAT, "std::clamp((1 - heat_) / kFold, 0.0, 1.0)", "1.0"),
    (ENERGY, "given_ += sent_.dot(x - x_)", "given_ -= sent_.dot(x - x_)"),
    (ENERGY, "return wanted - damping_ * v;", "return wanted;"),
    # the transport watch, which has to see what the stage let through
    (WATCH, "if (!f.allFinite()) fail", "if (false) fail"),
    (WATCH, "if (step > slew", "if (step > 1e9 + slew"),
    (WATCH, "if (lost_for_ > kGone + tick.period && force > 0)", "if (false)"),
    # the process that holds the device
    (KEEPER, "if (alone_ || age_ > kHold)", "if (alone_)"),
    (KEEPER, "if (alone_ || age_ > kHold)", "if (age_ > kHold)"),
    (KEEPER, "input.fresh && input.command == Wrench()", "input.fresh"),
    (KEEPER, "bool dropped_ = true, alone_", "bool dropped_ = false, alone_"),
    (KEEPER, ".lost = input.finger.lost,", ".lost = false,"),
    (SUPERVISOR, "(life.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0", "false"),
    (SUPERVISED, "finger.lost || silence_ > kDead", "finger.lost"),
    (SUPERVISED, "&& silence_ <= kSilent", ""),
]

GOD = "modules/god_object/god_object.cpp"
FRICTION = "modules/haptics_proxy/friction.cpp"
CONE = "modules/friction_cone/friction_cone.cpp"
NEAREST = "framework/haptics/nearest_feasible.cpp"
SHADING = "modules/shading/shading.cpp"
EFFECTS = "framework/haptics/surface_effects.cpp"
CLOSEST = "framework/geometry/closest_point.h"
SLIVER = "framework/geometry/closest_point.cpp"
MASS = "framework/geometry/tri_mesh.cpp"
ROTATION = "modules/dynamics_ode/rotation.cpp"
ROW = "modules/dynamics_ode/finger_constraint.cpp"
FINGERS = "modules/dynamics_ode/finger_joints.cpp"
CONTACTS = "modules/dynamics_ode/contact_joints.cpp"

CORE = [
    # where the fingertip goes
    (GOD, "constexpr double kInContact = 1e-10;", "constexpr double kInContact = 1e-4;"),
    (GOD, "constexpr double kStill = 1e-6;", "constexpr double kStill = 1e-3;"),
    (GOD, "constexpr int kMaxLegs = 256;", "constexpr int kMaxLegs = 2;"),
    (GOD, "piece.at.nhat.dot(x) + r - piece.at.distance}", "piece.at.nhat.dot(x) + 0.99 * r - piece.at.distance}"),
    (GOD, "if (slope < 0) reach =", "if (slope < -1e9) reach ="),
    (GOD, "overlapping = overlapping || piece.at.distance < r - tolerance.contact_gap;", ""),
    (GOD, "if (l > max) {\n        max = l;\n        worst = i;", "if (l > 1e9) {\n        max = l;\n        worst = i;"),
    (FRICTION, "contact.nhat = (free.x - now.g) / contact.depth;", "contact.nhat = free.x - now.g;"),
    (NEAREST, "const double det = 1 - c * c;", "const double det = 1 + c * c;"),
    (NEAREST, "(ri - c * rj) / det", "(ri + c * rj) / det"),
    (NEAREST, "if (lambda.minCoeff() < 0) return false;", ""),
    (NEAREST, "if (three(i, j, k)) return best_;", ""),
    (NEAREST, "if (slack(half_space) < slack(other)) other = half_space;", ""),
    # friction of a fingertip
    (CONE, "kBorder * input.mu_dynamic : input.mu_static", "input.mu_static : input.mu_static"),
    (CONE, "stretch *= input.mu_dynamic * input.depth / length", "stretch *= input.mu_static * input.depth / length"),
    (CONE, "length > (input", "length > 1.05 * (input"),
    (FRICTION, "one.displacement -= one.displacement.dot(contact.nhat) * contact.nhat;", ""),
    (FRICTION, "const Vec3 from = last.touching ? last.x : contact.first_touch;", "const Vec3 from = last.x;"),
    (FRICTION, "contact.tangential_displacement = away - contact.depth * contact.nhat;", "contact.tangential_displacement = away;"),
    # smooth meshes
    (SHADING, "std::atan2(u.cross(v).norm(), u.dot(v)) * cross.normalized()", "cross.normalized()"),
    (EFFECTS, "contact.tangential_displacement = turn * contact.tangential_displacement;", ""),
    (SHADING, "return {1 - w1 - w2, w1, w2};", "return {1 - w1 - w2, w2, w1};"),
    # geometry
    (CLOSEST, "if (d3 >= 0 && d4 <= d3) return t.b;", ""),
    (CLOSEST, "if (vb <= 0 && d2 >= 0 && d6 <= 0)", "if (false)"),
    (CLOSEST, "static constexpr double kSliverSine = 1e-4;", "static constexpr double kSliverSine = 0;"),
    (SLIVER, "if (!(along < length_squared)) return b;", ""),
    (MASS, "result.volume * offset * offset.transpose()", "0 * offset * offset.transpose()"),
    (MASS, "std::swap(neighbours[0], neighbours[2]);", "(void)neighbours;"),
    # rotation and the integrators
    (ROTATION, "x += s / 6 * (k1 + 2 * k2 + 2 * k3 + k4);", "x += s / 6 * (k1 + 2 * k2 + k3 + 2 * k4);"),
    (ROTATION, "x + s * k3,", "x + 0.5 * s * k3,"),
    (ROTATION, "w_WB = spin(q_WB, inverse_inertia, momentum_W);", ""),
    (ROTATION, "w_B.cross(inertia * w_B)", "(inertia * w_B).cross(w_B)"),
    # fingers, friction and torsion among bodies
    (ROW, "const double hk_d = h * k + d;", "const double hk_d = h * k;"),
    (ROW, "row.slip = rubs ? 1 / hk_t_d", "row.slip = rubs ? 0.1 / hk_t_d"),
    (ROW, "contact.mode == ContactMode::kSlip ? contact.friction_dynamic : contact.friction_static", "contact.friction_static"),
    (ROW, "const double ahead = std::clamp(age, 0.0, old_after);", "const double ahead = 0;"),
    (ROW, "1 - (age - old_after) / kFingerFade", "1 - 0 * (age - old_after) / kFingerFade"),
    (ROW, "own.p_WH = part.p_WP - part.stretch_W;", "own.p_WH = contact.p_WH;"),
    (FINGERS, "torsional_radius_[body] * row.mu * normal", "torsional_radius_[body] * normal"),
    (FINGERS, "torsional_radius_[body] * row.mu * normal", "torsional_radius_[body] * row.mu"),
    (FINGERS, "row.mu = row.mu_dynamic;\n    wanted", "wanted"),
    (CONTACTS, "std::sqrt(a.friction_dynamic * b.friction_dynamic)", "std::sqrt(a.friction_static * b.friction_static)"),
    (CONTACTS, "slip_speed < kRestSpeed ? std::sqrt(a.friction_static * b.friction_static)", "slip_speed < kRestSpeed ? a.friction_static"),
    (CONTACTS, "surface.motionN = c.depth / h_;", "surface.motionN = 0;"),
    (CONTACTS, "slip(i, bodies).norm() < kRestSpeed ? pair.at_rest : pair.sliding", "pair.at_rest"),
    (CONTACTS, "joints_[i].f_B_W = same->f_B_W;", ""),
]
