#include <array>
#include <string>

#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

using xml::Element;

/// What a format changed against the one before it.
struct Change {
  int minor;              ///< format 1.MINOR has it
  const char* path;       ///< of the element, below the root
  const char* attribute;  ///< in the formats before
  const char* now;        ///< its new name; empty: it is gone
};

// How to change the format: raise kFormatMinor, change the schema, add a row for each name that older files have. A new
// name alone needs no row.
constexpr std::array kChanges{
    Change{1, "collision", "max_triangles", ""},  // it had no effect any more: patches are not bounded
};

void apply(const Change& change, const Element& at, const std::string& path) {
  const std::size_t slash = path.find('/');
  for (Element child : at.children(path.substr(0, slash))) {
    if (slash != std::string::npos) {
      apply(change, child, path.substr(slash + 1));
    } else if (child.hasAttribute(change.attribute)) {
      if (*change.now != '\0' && !child.hasAttribute(change.now))
        child.setAttribute(change.now, child.attribute(change.attribute), child.where(change.attribute));
      child.removeAttribute(change.attribute);
    }
  }
}

/// The minor number of a version "1.MINOR"; -1 for any other text.
int minorOf(const std::string& version) {
  const std::string major = std::to_string(kFormatMajor) + ".";
  if (!version.starts_with(major) || version.size() == major.size() || version.size() > major.size() + 4) return -1;
  const std::string minor = version.substr(major.size());
  return minor.find_first_not_of("0123456789") == std::string::npos ? std::stoi(minor) : -1;
}

}  // namespace

void upgrade(xml::Element root) {
  const int minor = minorOf(root.attribute("version"));
  if (minor < 0 || minor >= kFormatMinor) return;
  for (const Change& change : kChanges)
    if (change.minor > minor) {
      apply(change, root, change.path);
      for (const Element& defaults : root.children("defaults")) apply(change, defaults, change.path);
    }
  root.setAttribute("version", std::to_string(kFormatMajor) + "." + std::to_string(kFormatMinor),
                    root.where("version"));
}

}  // namespace presa
