#include "framework/record/record_plugin/contents.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <optional>

#include "framework/core/diagnostics/refuse.h"
#include "framework/record/checksum/checksum.h"
#include "framework/record/record_plugin/row_check.h"
#include "framework/record/record_plugin/seal.h"

namespace presa::record {
namespace {

std::string numberText(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.9g", number);
  return text.data();
}

template <class Row>
concept Timed = requires(const Row& row) {
  row.time;
};

class ContentReader {
 public:
  ContentReader(Contents& contents, Diagnostics& findings)
      : contents_(contents), stored_(contents.stored), findings_(findings), sealed_(stored_.version >= seal::kSince) {}

  void read(const TakeRows& take) {
    contents_.ticks = rows<TickRow>(stored_.ticks, tickRules(stored_.fingers.size()), true);
    contents_.count = contents_.ticks.size();
    for (const StoredTable& table : stored_.fingers) {
      auto all = rows<FingerRow>(table, fingerRules(stored_.scene_bodies), static_cast<bool>(take.finger));
      if (take.finger) take.finger(table, std::move(all));
    }
    for (const StoredTable& table : stored_.bodies) {
      auto all = rows<BodyRow>(table, {}, static_cast<bool>(take.body));
      if (take.body) take.body(table, std::move(all));
    }
    for (const StoredTable& table : stored_.tools) {
      auto all = rows<ToolRow>(table, {}, static_cast<bool>(take.tool));
      if (take.tool) take.tool(table, std::move(all));
    }
    for (const StoredTable& table : stored_.frames) {
      auto all = rows<FrameRow>(table, {}, static_cast<bool>(take.frame));
      if (take.frame) take.frame(table, std::move(all));
    }
    if (stored_.orders) {
      auto all = rows<OrderRow>(*stored_.orders, orderRules(stored_.scene_bodies), static_cast<bool>(take.order));
      if (take.order) take.order(*stored_.orders, std::move(all));
    }
    for (std::size_t g = 0; g < stored_.schedule.size(); ++g)
      contents_.schedule[g] = rows<ScheduleRow>(stored_.schedule[g], scheduleRules(), true);
    if (stored_.complete) compareLengths();
    for (const auto& [check, table] : checks_) check.report(stored_.name, reported(*table), findings_);
    checkSeal();
  }

 private:
  void wrong(int code, const std::string& what, const std::string& help) {
    findings_.error(code, {stored_.name, 0, 0}, what, help);
  }

  void shorten(std::size_t rows) { contents_.count = std::min(contents_.count, rows); }

  bool isSchedule(const StoredTable& table) const { return table.path.starts_with("schedule/"); }
  /// Number of rows to report on: in a killed run the newest rows may be anything.
  std::uint64_t reported(const StoredTable& table) const {
    return stored_.complete || isSchedule(table) ? table.rows : contents_.count;
  }

  /// Reads the rows of a table up to the first that cannot be read or is out of order. A complete recording has no such
  /// row; in a killed run's file the newest chunk may be unreadable or hold old data.
  template <class Row>
  std::vector<Row> rows(const StoredTable& table, const std::vector<Rule>& rules, bool keep) {
    RowCheck& check = checks_.emplace_back(RowCheck(table.path, table.columns, rules), &table).first;
    std::vector<Row> all, block;
    Row before;
    std::uint64_t sound = 0;  // valid rows so far
    for (bool whole = true; whole && sound < table.rows;) {
      whole = readBlock(table, sound, block);
      if (!whole) break;
      if (sealed_) sum_.add(block.data(), block.size() * sizeof(Row));
      const std::size_t good = soundRows(table, sound, block, before, check);
      if (keep) all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(good));
      whole = good == block.size();
      sound += good;
    }
    if (!stored_.complete && !isSchedule(table)) shorten(sound);
    if (sealed_) sums_.push_back({table.path, table.rows, sum_.finish()});
    whole_ = whole_ && sound == table.rows;
    return all;
  }

  /// Reads the next rows, at most a chunk. False when they cannot be read.
  template <class Row>
  bool readBlock(const StoredTable& table, hsize_t begin, std::vector<Row>& block) {
    const hsize_t length = std::min<hsize_t>(kBlockRows, table.rows - begin);
    block.assign(length, Row{});  // default values for columns that an older format lacks
    const h5::Handle type = h5::compoundType(table.columns, h5::Side::kMemory);
    const h5::Handle space(H5Dget_space(table.dataset), H5Sclose, "table space");
    const h5::Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose, "row space");
    h5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &length, nullptr), "table selection");
    if (H5Dread(table.dataset, type, memory, space, H5P_DEFAULT, block.data()) >= 0) return true;
    if (stored_.complete)
      wrong(673, table.path + ": rows from " + std::to_string(begin) + " on cannot be read",
            "was it copied completely?");
    return false;
  }

  /// Number of leading rows of a block with the expected index and time. `before`: in, the preceding row; out, the last
  /// good one.
  template <class Row>
  std::size_t soundRows(const StoredTable& table, std::uint64_t begin, const std::vector<Row>& block, Row& before,
                        RowCheck& check) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::uint64_t number = begin + i;
      const std::string problem = keyProblem(table, number, block[i], number > 0 ? &before : nullptr);
      if (!problem.empty()) {
        if (stored_.complete) sayKey(table, number, problem);
        return i;
      }
      check.check(&block[i], number);
      before = block[i];
    }
    return block.size();
  }

  void sayKey(const StoredTable& table, std::uint64_t row, const std::string& problem) {
    wrong(674, table.path + ": row " + std::to_string(row) + ": " + problem,
          "rows count from 0; was it changed since it was recorded?");
  }

  /// The error in the index or time of a row, or "".
  template <class Row>
  std::string keyProblem(const StoredTable& table, std::uint64_t number, const Row& row, const Row* before) const {
    const std::vector<TickRow>& ticks = contents_.ticks;
    if (row.index > kMaxTicks)
      return "index: found " + std::to_string(row.index) + ", allowed up to " + std::to_string(kMaxTicks);
    if (before != nullptr && row.index <= before->index)
      return "index: found " + std::to_string(row.index) + " after " + std::to_string(before->index) +
             ", must be larger";
    if (followsTicks(table) && number < ticks.size() && row.index != ticks[number].index)
      return "index: found " + std::to_string(row.index) + ", haptic/ticks has " + std::to_string(ticks[number].index);
    if constexpr (Timed<Row>) {
      const double time = std::isnan(stored_.haptic_period) ? row.time : timeOf(row.index);
      if (std::bit_cast<std::uint64_t>(row.time) != std::bit_cast<std::uint64_t>(time))
        return "time: found " + numberText(row.time) + ", tick " + std::to_string(row.index) + " is at " +
               numberText(time);
    }
    return {};
  }

  /// Whether the table must have the indices of haptic/ticks: the haptic tables, and the haptic schedule of a complete
  /// run without drops. The schedule in a flight recording is longer or shorter, and with drops it has rows without a
  /// tick.
  bool followsTicks(const StoredTable& table) const {
    if (&table == &stored_.ticks) return false;
    if (!isSchedule(table)) return true;
    return &table == &stored_.schedule.front() && wholeRun();
  }
  bool wholeRun() const {
    return stored_.dropped == 0 && stored_.faults.empty() && !contents_.ticks.empty() &&
           contents_.ticks.front().index == 0;
  }

  /// Computed as in RateTable: whole nanoseconds.
  double timeOf(std::uint64_t index) const {
    const auto period_ns = static_cast<std::int64_t>(std::llround(stored_.haptic_period * 1e9));
    return static_cast<double>(static_cast<std::int64_t>(index) * period_ns) * 1e-9;
  }

  void compareLengths() {
    const auto compare = [&](const StoredTable& table) {
      if (table.rows != stored_.ticks.rows)
        wrong(673,
              table.path + ": found " + std::to_string(table.rows) + " rows, haptic/ticks has " +
                  std::to_string(stored_.ticks.rows) + "; in a complete run the numbers are equal",
              "was it changed since it was recorded?");
    };
    for (const StoredTable& table : stored_.fingers) compare(table);
    for (const StoredTable& table : stored_.bodies) compare(table);
    for (const StoredTable& table : stored_.tools) compare(table);
    for (const StoredTable& table : stored_.frames) compare(table);
    if (stored_.orders) compare(*stored_.orders);
    if (wholeRun()) compare(stored_.schedule.front());
  }

  void checkSeal() {
    if (!sealed_ || !stored_.complete || !whole_) return;
    const std::size_t before = findings_.errorCount();
    for (std::size_t i = 0; i < sums_.size(); ++i)
      compareSum(sums_[i].path, sums_[i].path, sums_[i].sha256, "its rows are");
    // if all tables are intact, a difference is in the attributes or texts
    if (findings_.errorCount() == before)
      compareSum("", "/", seal::sumOf(stored_.file, sums_), "its attributes and texts are");
    contents_.checksum = findings_.errorCount() == before;
  }

  void compareSum(const std::string& said, const std::string& path, const std::string& sum, const std::string& what) {
    const h5::Handle object(H5Oopen(stored_.file, path.c_str(), H5P_DEFAULT), H5Oclose, path);
    const std::string expected =
        h5::hasAttribute(object, seal::kAttribute) ? h5::readStringAttribute(object, seal::kAttribute) : "";
    if (expected == sum) return;
    const std::string found = expected.empty()
                                  ? "attribute 'sha256' is missing"
                                  : what + " not what was recorded: SHA-256 " + sum + ", recorded " + expected;
    wrong(676, (said.empty() ? "" : said + ": ") + found, "the file was damaged or changed after the run");
  }

  Contents& contents_;
  const StoredRecording& stored_;
  Diagnostics& findings_;
  const bool sealed_;
  bool whole_ = true;  // every row was read
  Sha256 sum_;
  std::vector<seal::TableSum> sums_;
  std::vector<std::pair<RowCheck, const StoredTable*>> checks_;
};

}  // namespace

Contents readContents(const std::string& file, const TakeRows& take) {
  const h5::Library library;
  try {
    Diagnostics findings;
    Contents contents{openStored(file, findings), 0, false, {}, {}};
    ContentReader(contents, findings).read(take);
    if (findings.hasErrors()) throw InputError(std::move(findings));
    if (contents.count == 0) refuse(607, file, "holds no tick", "the run ended before its first flush");
    return contents;
  } catch (const h5::Failure& failure) {
    refuse(608, file, std::string("is damaged: ") + failure.what(), "was it copied completely?");
  }
}

}  // namespace presa::record
