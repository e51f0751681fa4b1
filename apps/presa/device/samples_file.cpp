#include "apps/presa/device/samples_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "apps/common/delimited.h"
#include "apps/common/file_text.h"
#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::device {
namespace {

const std::vector<std::string> kColumns{"a_x_m", "a_y_m", "a_z_m", "b_x_m", "b_y_m", "b_z_m"};

std::array<std::size_t, 6> columnsOf(const std::string& file, const std::vector<std::string>& head) {
  std::array<std::size_t, 6> columns{};
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto found = std::find(head.begin(), head.end(), kColumns[i]);
    columns[i] = static_cast<std::size_t>(found - head.begin());
    if (found == head.end())
      diagnostics.error(
          474, {file, 1, 1}, "there is no column " + quote(kColumns[i]) + didYouMean(kColumns[i], head),
          "a_x_m, a_y_m, a_z_m: what the rig's first device reports in its base's frame; b_…: the second");
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return columns;
}

}  // namespace

std::vector<LinkedSample> readSamples(const std::string& file) {
  const std::string text = contentsOf(file);
  const auto records = recordsOf(text, ',');
  if (records.empty()) refuse(474, file, "the file is missing or empty");
  const auto columns = columnsOf(file, records[0].cells);
  std::vector<LinkedSample> samples;
  Diagnostics diagnostics;
  for (std::size_t line = 1; line < records.size(); ++line) {
    std::array<double, 6> value{};
    for (std::size_t i = 0; i < 6; ++i) {
      const auto& cells = records[line].cells;
      const std::string cell = columns[i] < cells.size() ? cells[columns[i]] : "";
      const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value[i]);
      if (status != std::errc{} || rest != cell.data() + cell.size() || !std::isfinite(value[i]))
        diagnostics.error(475, {file, static_cast<int>(line) + 1, static_cast<int>(columns[i]) + 1},
                          kColumns[i] + " must be a number, found " + quote(cell));
    }
    samples.push_back({{value[0], value[1], value[2]}, {value[3], value[4], value[5]}});
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return samples;
}

std::string samplesText(const std::vector<LinkedSample>& samples) {
  std::string out;
  for (const std::string& column : kColumns) out += (out.empty() ? "" : ",") + column;
  for (const LinkedSample& s : samples)
    out += terminal::format("\n%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", s.p_A.x(), s.p_A.y(), s.p_A.z(), s.p_B.x(), s.p_B.y(),
                            s.p_B.z());
  return out + "\n";
}

}  // namespace presa::device
