#include "apps/presa/gallery/listing.h"

#include <algorithm>

#include "apps/common/terminal/text.h"
#include "apps/presa/gallery/groups.h"
#include "framework/core/diagnostics/printable.h"

namespace presa::gallery {
namespace {

using terminal::Style;
using terminal::styled;

constexpr std::size_t kGap = 2;

}  // namespace

std::string listing(const std::vector<Entry>& entries, std::size_t columns, bool color) {
  std::size_t widest = 0;
  for (const Entry& entry : entries) widest = std::max(widest, terminal::widthOf(entry.name));
  const std::size_t indent = kGap + widest + kGap;
  std::string out, group = "\n";  // no group has this name
  for (const Entry& entry : entries) {
    if (entry.group != group) {
      out += (out.empty() ? "" : "\n") + styled(printable(titleOf(entry.group)), Style::kStrong, color) + "\n";
      group = entry.group;
    }
    const std::string name = printable(entry.name) + std::string(widest - terminal::widthOf(entry.name), ' ');
    const std::string text = std::string(indent, ' ') + printable(entry.sentence);
    // the blanks in front are those of the name, which has no width while it is coloured
    out += std::string(kGap, ' ') + styled(name, Style::kGood, color) + std::string(kGap, ' ') +
           terminal::wrapped(text, columns, indent).substr(indent) + "\n";
  }
  out += "\n" +
         terminal::wrapped(
             "Run one: presa gallery NAME. With mouse and keys: presa gallery NAME --mouse. The list with "
             "pictures: presa gallery --page gallery.html.",
             columns, 0) +
         "\n";
  return out;
}

}  // namespace presa::gallery
