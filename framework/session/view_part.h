#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/world.h"

namespace presa {

/// One moment of a run, for what is drawn in it.
struct ViewMoment {
  double time;                      ///< [s]
  const std::vector<Pose>& X_WB;    ///< in the order of Scene::bodies
  const DeviceState& device;        ///< measured fingertips
  const ContactExchange& contacts;  ///< of the fingertips with bodies
};

/// What a part of the picture draws with. World frame, metres; colours are linear RGB, 0 to 1.
class Canvas {
 public:
  virtual ~Canvas() = default;
  /// A straight line; nothing where a coordinate is not finite.
  virtual void line(const Vec3& p_WA, const Vec3& p_WB, const Vec3& color) = 0;
};

/// Something that is drawn in the picture of a run: a trail, a scale, a field. It exists only where the scene has its
/// element and the run has a picture.
/// Thread: view (60 Hz), except for construction; may allocate, nothing waits for it.
class ViewPart {
 public:
  virtual ~ViewPart() = default;
  /// Every tick of the view, whether a picture is drawn or not.
  virtual void follow(const ViewMoment& /*moment*/) {}
  /// Each picture, after follow().
  virtual void draw(const ViewMoment& moment, Canvas& canvas) = 0;
  /// Description for `presa explain`.
  virtual std::string what() const = 0;
};

/// Table of a plug-in of kind view_part (framework/scene/manifest.h).
struct ViewPartPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// May throw (E596). The world stays alive as long as the part.
  std::unique_ptr<ViewPart> (*create)(const PluginElement& element, const World& world);
};

}  // namespace presa

/// Exports `table`, a ViewPartPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_VIEW_PART_PLUGIN(table)                                                                    \
  extern "C" __attribute__((visibility("default"))) const presa::ViewPartPlugin* presaViewPartPlugin() { \
    return &(table);                                                                                     \
  }
