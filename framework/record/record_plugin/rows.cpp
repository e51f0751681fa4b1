#include "framework/record/record_plugin/rows.h"

#include <algorithm>

namespace presa::record {
namespace {

class Columns {
 public:
  Columns& add(std::string name, std::size_t offset, Cell cell, std::string unit, std::string description) {
    columns_.push_back({std::move(name), offset, cell, std::move(unit), std::move(description)});
    return *this;
  }
  Columns& real(std::string name, std::size_t offset, std::string unit, std::string description) {
    return add(std::move(name), offset, Cell::kF64, std::move(unit), std::move(description));
  }
  /// One column per component: name_x, name_y, name_z.
  Columns& vector(const std::string& name, std::size_t offset, const std::string& unit, const std::string& description,
                  const std::string& components = "xyz") {
    for (std::size_t i = 0; i < components.size(); ++i) {
      real(name + '_' + components[i], offset + i * sizeof(double), unit, description);
    }
    return *this;
  }
  Columns& key(std::size_t index, std::size_t time) {
    add("index", index, Cell::kU64, "1", "number of the haptic tick");
    return real("time", time, "s", "simulated time of the tick");
  }
  std::vector<Column> take() { return std::move(columns_); }

 private:
  std::vector<Column> columns_;
};

}  // namespace

Table tickTable() {
  using R = TickRow;
  Columns c;
  c.key(offsetof(R, index), offsetof(R, time))
      .real("device_time", offsetof(R, device_time), "s", "time of the device sample")
      .real("command_time", offsetof(R, command_time), "s", "time of the force command")
      .real("object_time_end", offsetof(R, object_time_end), "s", "end of the dynamics step that the poses come from")
      .add("device_count", offsetof(R, device_count), Cell::kI32, "1", "fingers in the device state")
      .add("command_count", offsetof(R, command_count), Cell::kI32, "1", "fingers in the force command")
      .add("stop_requested", offsetof(R, stop_requested), Cell::kI32, "1", "1: the run is being stopped, forces fade")
      .add("surfaces_changed", offsetof(R, surfaces_changed), Cell::kU64, "1", "1: surfaces have their other friction")
      .add("rearms", offsetof(R, rearms), Cell::kU64, "1", "latched faults forgiven, since start")
      .add("commanded", offsetof(R, commanded), Cell::kU64, "1",
           "surface that a command changed in this tick, counted from 1 as openSurfaces lists them; 0: none")
      .real("commanded_value", offsetof(R, commanded_value), "1", "to what, in the unit of the scene")
      .add("output_status", offsetof(R, output_status), Cell::kU32, "1",
           "bits of the output stage, all fingers together")
      .add("coverage_lost", offsetof(R, coverage_lost), Cell::kU32, "1",
           "ticks in which a fingertip could not see every surface in its reach, since start")
      .add("pop_through", offsetof(R, pop_through), Cell::kU32, "1", "surfaces passed without contact, since start");
  return {sizeof(R), c.take()};
}

Table fingerTable() {
  using R = FingerRow;
  Columns c;
  c.key(offsetof(R, index), offsetof(R, time))
      .vector("p_WH", offsetof(R, p_WH), "m", "haptic interface point, world frame")
      .vector("v_WH", offsetof(R, v_WH), "m/s", "its velocity, world frame")
      .vector("p_WP", offsetof(R, p_WP), "m", "proxy, world frame")
      .vector("p_BP", offsetof(R, p_BP), "m", "proxy, frame of the touched body (world when none)")
      .vector("p_BC", offsetof(R, p_BC), "m", "touched surface point, frame of the touched body")
      .vector("nhat_W", offsetof(R, nhat_W), "1", "surface normal from body into finger, world frame")
      .real("depth", offsetof(R, depth), "m", "penetration along the normal")
      .real("normal_force", offsetof(R, normal_force), "N", "rendered force along the normal")
      .vector("tangential_force_W", offsetof(R, tangential_force_W), "N", "rendered force without its normal part")
      .vector("f_rendered_W", offsetof(R, f_rendered_W), "N", "force on the finger before the output stage")
      .vector("f_command_W", offsetof(R, f_command_W), "N", "force on the finger after the output stage")
      .add("phase", offsetof(R, phase), Cell::kI32, "1", "phase of the scripted motion; -1: none")
      .add("valid", offsetof(R, valid), Cell::kI32, "1",
           "1: the device delivered a usable sample; 2: lost until re-armed")
      .add("mode", offsetof(R, mode), Cell::kI32, "1", "contact: 0 none, 1 sticking, 2 slipping")
      .add("body", offsetof(R, body), Cell::kI32, "1", "touched body, counted from 0 in scene order; -1: none");
  return {sizeof(R), c.take()};
}

Table bodyTable() {
  using R = BodyRow;
  Columns c;
  c.key(offsetof(R, index), offsetof(R, time))
      .vector("p_WB", offsetof(R, p_WB), "m", "position of the body frame at this tick")
      .vector("q_WB", offsetof(R, q_WB), "1", "orientation at this tick as unit quaternion, body to world", "wxyz")
      .vector("v_WB", offsetof(R, v_WB), "m/s", "velocity at object_time_end, world frame")
      .vector("w_WB", offsetof(R, w_WB), "rad/s", "angular velocity at object_time_end, world frame");
  return {sizeof(R), c.take()};
}

Table toolTable() {
  using R = ToolRow;
  Columns c;
  c.key(offsetof(R, index), offsetof(R, time))
      .vector("q_WT", offsetof(R, q_WT), "1", "orientation of the tool as unit quaternion, tool to world", "wxyz")
      .vector("w_WT", offsetof(R, w_WT), "rad/s", "its angular velocity, world frame")
      .vector("t_rendered_W", offsetof(R, t_rendered_W), "N m", "torque on the tool before the output stage")
      .vector("t_command_W", offsetof(R, t_command_W), "N m", "torque on the tool after the output stage");
  return {sizeof(R), c.take()};
}

Table frameTable() {
  using R = FrameRow;
  Columns c;
  c.key(offsetof(R, index), offsetof(R, time))
      .vector("p_WF", offsetof(R, p_WF), "m", "origin of the frame, world frame")
      .vector("q_WF", offsetof(R, q_WF), "1", "orientation of the frame as unit quaternion, frame to world", "wxyz")
      .real("zoom", offsetof(R, zoom), "1", "metres of the world for one of the frame")
      .add("doing", offsetof(R, doing), Cell::kU32, "1",
           "sum of 1: moves; 2: clutched; 4: zooms; 8: a wish waits; "
           "16: its tool is lost; 32: returns to it")
      .add("uses", offsetof(R, uses), Cell::kU32, "1", "walks, clutches and zooms begun, since start")
      .add("refusals", offsetof(R, refusals), Cell::kU32, "1", "of them held up by a force, since start")
      .add("none", offsetof(R, none), Cell::kU32, "1", "always 0");
  return {sizeof(R), c.take()};
}

Table orderTable() {
  using R = OrderRow;
  Columns c;
  c.key(offsetof(R, index), offsetof(R, time))
      .add("tick", offsetof(R, tick), Cell::kU64, "1", "number of the collision tick that took the order")
      .add("goal", offsetof(R, goal), Cell::kI32, "1",
           "goal that is to pull a body, counted from 0 in scene order; -1: no order, -2: an undo")
      .add("body", offsetof(R, body), Cell::kI32, "1", "that body, counted from 0 in scene order; -1: none any more");
  return {sizeof(R), c.take()};
}

Table subset(const Table& table, const std::vector<std::string>& columns) {
  Table part{table.row_bytes, {}};
  for (const Column& column : table.columns) {
    const auto wanted = [&](const std::string& prefix) {
      return column.name == prefix ||
             (column.name.size() == prefix.size() + 2 && column.name.starts_with(prefix + '_'));
    };
    if (std::any_of(columns.begin(), columns.end(), wanted)) part.columns.push_back(column);
  }
  return part;
}

}  // namespace presa::record
