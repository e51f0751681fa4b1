#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/surroundings.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/world.h"

namespace presa {

/// The active constraints of a proxy, at most three. The vector from the goal to the proxy is the sum of weight * nhat.
struct ActiveSet {
  /// One piece that holds the proxy.
  struct Member {
    PieceRef piece;     ///< valid until the next Surroundings::begin()
    std::int32_t body;  ///< index into Scene::bodies
    Vec3 nhat;          ///< unit, from the piece towards the proxy, in A
    double weight;      ///< multiplier [m], >= 0
  };
  std::array<Member, 3> member;  ///< the first `count` are set
  int count = 0;                 ///< 0: the goal is free
};

/// Result of moving a proxy towards its goal.
struct ProxyMove {
  Vec3 x = Vec3::Zero();            ///< final position of the tool's centre
  Vec3 first_touch = Vec3::Zero();  ///< position at the first contact (x if there was none)
  bool touching = false;            ///< a surface keeps the sphere from the goal
  std::int32_t body = kNoBody;      ///< body of the most violated constraint
  ActiveSet active;                 ///< constraints at x
};

/// The proxy of one tool at the end of a tick, in the working frame A.
struct ProxyState {
  Vec3 x = Vec3::Zero();           ///< proxy, held by friction
  Vec3 god_object = Vec3::Zero();  ///< frictionless proxy; x itself in free space
  bool touching = false;           ///< a surface holds the god-object off the goal
  bool slipping = false;           ///< friction does not hold x: see Renderer::touch
};

/// Contact of one tool in one tick, in the working frame A.
struct ProxyContact {
  ProxyState state;                             ///< end of this tick
  Vec3 x = Vec3::Zero();                        ///< rendered proxy: state.x, unless an effect moves it
  Vec3 first_touch = Vec3::Zero();              ///< position at the first contact of this tick's motion
  Vec3 nhat = Vec3::UnitZ();                    ///< direction of the frictionless force, body into tool
  double depth = 0;                             ///< (x - g) . nhat [m]
  Vec3 tangential_displacement = Vec3::Zero();  ///< x - g without its normal part [m]
  std::int32_t body = kNoBody;                  ///< of several the one that holds most; kNoBody: no contact
  ActiveSet active;                             ///< of the frictionless proxy; empty: `body` bears all
  bool swept = true;  ///< state.x came here along the path that Surroundings::leaveTrail got, which Presa then checks
  bool crossed = false;  ///< not swept: the renderer itself knows that the tool went through a surface
};

/// One of the contacts of a tool that touches in more places than an ActiveSet holds, in A. The force acts at the
/// proxy.
struct RenderedContact {
  std::int32_t body = kNoBody;  ///< index into Scene::bodies
  Vec3 nhat = Vec3::UnitZ();    ///< body into tool
  double depth = 0;             ///< > 0 [m]
};

/// One tool in one haptic tick. The tool is a sphere. Working frame A: the body that was next to the tool at the start
/// of the tick, so that a tool at rest on a moving body is at rest.
struct RenderInput {
  std::size_t tool;        ///< index of the scene's device role
  const Vec3& g;           ///< goal: where the device is, in A [m]
  double radius;           ///< > 0 [m]
  const ProxyState& last;  ///< end of the last tick, after friction
  const Pose& X_WA;        ///< pose of A
  Surroundings& near;      ///< the pieces of bodies that the tool can reach in this tick
  /// Empty, with room for Renderer::maxOwnContacts(). Not left empty, it takes the place of ProxyContact::active; then
  /// the contact without friction has x - g = sum of depth * nhat.
  BoundedList<RenderedContact>& contacts;
};

/// Moves a proxy from x towards g without passing through a piece.
class ProxyMover {
 public:
  virtual ~ProxyMover() = default;
  /// Haptic thread; nonblocking.
  virtual ProxyMove move(const Vec3& x, const Vec3& g, double radius, Surroundings& near) const noexcept = 0;
  /// True when a tool at x touches at least one piece and overlaps none. Haptic thread; nonblocking.
  virtual bool isSupported(const Vec3& x, double radius, Surroundings& near) const noexcept = 0;
};

/// Says where each tool is held by the surfaces of bodies. The spring between that point and the device, the damping
/// and the friction of the material, and the forces on the bodies follow from it.
/// Thread: haptic, except for construction and what(); no allocation, lock, exception or system call.
class Renderer {
 public:
  virtual ~Renderer() = default;
  /// The contact without friction: state.slipping is true where it touches. A contact that is not finite, or of no body
  /// in reach, ends the run: forces go to zero, and the fault is reported with the renderer's name.
  virtual ProxyContact touch(const RenderInput& input) noexcept = 0;
  /// Maximum number of contacts that touch() adds to RenderInput::contacts. A tick with more counts as lost coverage.
  virtual std::size_t maxOwnContacts() const noexcept { return 0; }
  /// Moves the proxy that friction holds. Null: there is none, and the manifest does not say gives="proxy"; friction
  /// and force shading are then left out of the scene.
  virtual const ProxyMover* mover() const noexcept { return nullptr; }
  /// The working frame of a tool changes from A to B after this tick. Transforms what the renderer itself keeps in A.
  virtual void changeFrame(std::size_t /*tool*/, const Pose& /*X_BA*/) noexcept {}
  /// Description for `presa explain`.
  virtual std::string what() const = 0;
};

/// The contact of a frictionless proxy that `moved` towards g. Haptic thread; nonblocking.
ProxyContact contactOf(const ProxyMove& moved, const Vec3& g) noexcept;

/// Table of a renderer plug-in. Its manifest (framework/scene/manifest.h) makes its name a value of the attribute
/// `renderer` of `<haptics>`; an element of the manifest, if it has one, stands in `<haptics>` and has defaults for all
/// its attributes.
struct RendererPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// May throw (E596). The world stays alive as long as the renderer.
  std::unique_ptr<Renderer> (*create)(const PluginElement& settings, const World& world);
};

}  // namespace presa

/// Exports `table`, a RendererPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_RENDERER_PLUGIN(table)                                                                     \
  extern "C" __attribute__((visibility("default"))) const presa::RendererPlugin* presaRendererPlugin() { \
    return &(table);                                                                                     \
  }
