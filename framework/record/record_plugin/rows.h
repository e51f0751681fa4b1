#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

/// The tables of a recording, as C++ structs and as named columns with units. Every table repeats index and time, so
/// that it can be used alone and so that a reader can verify each row.
namespace presa::record {

/// /haptic/ticks
struct TickRow {
  std::uint64_t index = 0;
  double time = 0;
  double device_time = 0;
  double command_time = 0;
  double object_time_end = 0;
  std::uint64_t surfaces_changed = 0;
  std::uint64_t rearms = 0;
  std::uint64_t commanded = 0;  // 1 + slot of SurfaceSettings; 0: nothing
  double commanded_value = 0;
  std::int32_t device_count = 0;
  std::int32_t command_count = 0;
  std::int32_t stop_requested = 0;
  std::uint32_t output_status = 0;
  std::uint32_t coverage_lost = 0;
  std::uint32_t pop_through = 0;
};

/// /haptic/fingers/<role>
struct FingerRow {
  std::uint64_t index = 0;
  double time = 0;
  double p_WH[3] = {}, v_WH[3] = {};
  double p_WP[3] = {}, p_BP[3] = {}, p_BC[3] = {}, nhat_W[3] = {};
  double depth = 0;
  double normal_force = 0;
  double tangential_force_W[3] = {}, f_rendered_W[3] = {}, f_command_W[3] = {};
  std::int32_t phase = -1;
  std::int32_t valid = 0;
  std::int32_t mode = 0;
  std::int32_t body = -1;
};

/// /haptic/bodies/<name>
struct BodyRow {
  std::uint64_t index = 0;
  double time = 0;
  double p_WB[3] = {};
  double q_WB[4] = {1, 0, 0, 0};
  double v_WB[3] = {}, w_WB[3] = {};
};

/// /haptic/tools/<role>, for a device that measures its orientation
struct ToolRow {
  std::uint64_t index = 0;
  double time = 0;
  double q_WT[4] = {1, 0, 0, 0};
  double w_WT[3] = {};
  double t_rendered_W[3] = {}, t_command_W[3] = {};
};

/// /haptic/frames/<name>, for a frame of the rig
struct FrameRow {
  std::uint64_t index = 0;
  double time = 0;
  double p_WF[3] = {};
  double q_WF[4] = {1, 0, 0, 0};
  double zoom = 1;
  std::uint32_t doing = 0;
  std::uint32_t uses = 0;
  std::uint32_t refusals = 0;
  std::uint32_t none = 0;  // fills the word: rows are written byte by byte
};

/// /haptic/guide, for a run whose guide is in a viewer
struct OrderRow {
  std::uint64_t index = 0;
  double time = 0;
  std::uint64_t tick = 0;  // of the collision group
  std::int32_t goal = -1;  // TakenOrders::kNone
  std::int32_t body = -1;
};

// rows pass through the ring as 64-bit words and are written byte by byte, so they must not contain padding
template <class Row>
inline constexpr bool kPacked = std::is_trivially_copyable_v<Row> && sizeof(Row) % sizeof(std::uint64_t) == 0;
static_assert(kPacked<TickRow> && sizeof(TickRow) == 9 * 8 + 6 * 4);
static_assert(kPacked<FingerRow> && sizeof(FingerRow) == (2 + 3 * 9 + 2) * 8 + 4 * 4);
static_assert(kPacked<BodyRow> && sizeof(BodyRow) == (2 + 13) * 8);
static_assert(kPacked<ToolRow> && sizeof(ToolRow) == (2 + 13) * 8);
static_assert(kPacked<OrderRow> && sizeof(OrderRow) == 3 * 8 + 2 * 4);
static_assert(kPacked<FrameRow> && sizeof(FrameRow) == (2 + 8) * 8 + 4 * 4);

enum class Cell { kU64, kF64, kI32, kU32 };

struct Column {
  std::string name;
  std::size_t offset;
  Cell cell;
  std::string unit;  ///< "1": dimensionless
  std::string description;
};

/// The value at an offset of a row.
template <class Value>
Value valueAt(const void* row, std::size_t offset) noexcept {
  Value value;
  std::memcpy(&value, static_cast<const char*>(row) + offset, sizeof value);
  return value;
}

struct Table {
  std::size_t row_bytes;
  std::vector<Column> columns;
};

Table tickTable();
Table fingerTable();
Table bodyTable();
Table toolTable();
Table frameTable();
Table orderTable();

/// Layout of a complete row in the ring: the tick, then each finger, each free body, each oriented tool, each frame of
/// the rig, and what a guide in a viewer ordered.
struct RowLayout {
  std::size_t fingers = 0;
  std::size_t bodies = 0;
  std::vector<std::size_t> tools;  ///< their fingers
  std::size_t frames = 0;
  bool orders = false;
  std::size_t fingerOffset(std::size_t finger) const { return sizeof(TickRow) + finger * sizeof(FingerRow); }
  std::size_t bodyOffset(std::size_t body) const { return fingerOffset(fingers) + body * sizeof(BodyRow); }
  std::size_t toolOffset(std::size_t tool) const { return bodyOffset(bodies) + tool * sizeof(ToolRow); }
  std::size_t frameOffset(std::size_t frame) const { return toolOffset(tools.size()) + frame * sizeof(FrameRow); }
  std::size_t orderOffset() const { return frameOffset(frames); }
  std::size_t bytes() const { return orderOffset() + (orders ? sizeof(OrderRow) : 0); }
  std::size_t words() const { return bytes() / sizeof(std::uint64_t); }
};

/// The table reduced to these columns (vectors by prefix), read by name into the same structs.
Table subset(const Table& table, const std::vector<std::string>& columns);

}  // namespace presa::record
