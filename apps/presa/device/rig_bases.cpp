#include "apps/presa/device/rig_bases.h"

#include <filesystem>
#include <vector>

#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/scene/load.h"

namespace presa::device {
namespace {

namespace fs = std::filesystem;
using xml::Element;

Element settingOf(const Element& device, const std::string& key) {
  for (Element set : device.children("set")) {
    if (set.attribute("key") == key) return set;
  }
  Diagnostics diagnostics;
  diagnostics.error(473, device.where(), device.label() + " has no setting " + quote(key),
                    "a device that is to be calibrated needs the pose of its base: pos (x y z) and quat (w x y z)");
  throw InputError(std::move(diagnostics));
}

std::vector<double> numbersOf(const Element& device, const std::string& key, std::size_t count) {
  const Element set = settingOf(device, key);
  std::vector<double> numbers = set.numbers("value");
  double size = 0;
  for (const double value : numbers) size += value * value;
  if (numbers.size() == count && (count != 4 || size > 0)) return numbers;
  Diagnostics diagnostics;
  diagnostics.error(473, set.where("value"),
                    key + " must be " + std::to_string(count) + " numbers, found " + quote(set.attribute("value")));
  throw InputError(std::move(diagnostics));
}

std::string text(const Vec3& p) { return terminal::format("%.7g %.7g %.7g", p.x(), p.y(), p.z()); }
std::string text(const Quat& q) { return terminal::format("%.9g %.9g %.9g %.9g", q.w(), q.x(), q.y(), q.z()); }

std::unique_ptr<xml::Document> load(const std::string& file) {
  Diagnostics diagnostics;
  auto document = xml::Document::load(file, diagnostics);
  if (!document) throw InputError(std::move(diagnostics));
  return document;
}

}  // namespace

RigBases::RigBases(const std::string& file) : file_(file) {
  Diagnostics diagnostics;
  resolved_ = loadRig(file, diagnostics).resolved_xml;
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  const auto document = load(file);
  const std::vector<Element> devices = document->root().children("device");
  if (devices.size() != 2 || devices[0].attribute("driver") != devices[1].attribute("driver"))
    refuse(473, file,
           "a calibration links two devices of one driver, found " + std::to_string(devices.size()) + " devices",
           "give a rig with two, such as config/rigs/pinch_cube_percro.xml");
  driver_ = devices[0].attribute("driver");
  for (int i = 0; i < 2; ++i) {
    const Element& device = devices[static_cast<std::size_t>(i)];
    roles_[i] = device.attribute("role");
    if (device.hasAttribute("in") && device.attribute("in") != kWorldFrame) {
      Diagnostics found;
      found.error(473, device.where("in"),
                  "a calibration needs devices that stand in the world, found in=" + quote(device.attribute("in")),
                  "take in=\"…\" out of the rig, and put it back into the rig that is written");
      throw InputError(std::move(found));
    }
    const auto p = numbersOf(device, "pos", 3), q = numbersOf(device, "quat", 4);
    bases_[i] = {{p[0], p[1], p[2]}, Quat(q[0], q[1], q[2], q[3]).normalized()};
  }
}

std::string RigBases::withSecondAt(const Pose& X_WB, const std::string& folder) const {
  const auto document = load(file_);
  const fs::path from = fs::absolute(file_).parent_path(), to = fs::absolute(folder);
  for (const Element& device : document->root().children("device")) {
    for (Element set : device.children("set")) {
      const std::string key = set.attribute("key");
      if (key == "motion" || key == "file")
        set.setAttribute(
            "value",
            ((from / set.attribute("value")).lexically_normal()).lexically_relative(to.lexically_normal()).string());
    }
  }
  const Element second = document->root().children("device")[1];
  settingOf(second, "pos").setAttribute("value", text(X_WB.p));
  settingOf(second, "quat").setAttribute("value", text(X_WB.q));
  return document->text();
}

std::string RigBases::rehearsal(const Pose& X_WB, int leader, double link, std::uint64_t seed) const {
  const auto set = [](const std::string& key, const std::string& value) {
    return "<set key=\"" + key + "\" value=\"" + value + "\"/>";
  };
  std::string xml = "<rig version=\"1.0\" name=\"rehearsal\">";
  for (int i = 0; i < 2; ++i) {
    const Pose& base = i == 0 ? bases_[0] : X_WB;
    xml += "<device role=\"" + roles_[i] + "\" driver=\"" + driver_ + "\">" + set("hand", "linking_hand") +
           set("leads", roles_[leader]) + set("link", terminal::format("%.9g", link)) +
           set("seed", std::to_string(seed)) + set("pos", text(base.p)) + set("quat", text(base.q)) + "</device>";
  }
  return xml + "</rig>";
}

}  // namespace presa::device
