#pragma once
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/core/diagnostics/refuse.h"
#include "framework/geometry/long_work.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/scene.h"

namespace presa {

/// "<drag>", of several in one place "<drag[2]>" as in a --set path, and " of body 'cube'" if it stands in one.
std::string nameOf(const PluginElement& element, const Scene& scene);

/// Value of a bound such as max_force; zero for an element without it.
double boundOf(const PluginElement& element, const std::string& attribute);

/// The object that a plug-in makes for an element of the scene. Throws InputError: E596 with the element's place when
/// `create` throws or makes nothing. std::invalid_argument says what is wrong with the element's values; any other
/// exception is the plug-in's own failure.
template <class Create>
auto madeFor(const PluginElement& element, const Create& create) -> decltype(create()) {
  enum Code { kCannotBeMade = 596 };
  Diagnostics diagnostics;
  try {
    if (auto made = create()) return made;
    diagnostics.error(kCannotBeMade, element.where,
                      "plug-in '" + element.plugin + "' made nothing for <" + element.element + ">");
  } catch (const InputError&) {
    throw;
  } catch (const WorkStopped&) {
    throw;
  } catch (const std::invalid_argument& error) {  // the scene's author can mend it
    diagnostics.error(kCannotBeMade, element.where, "<" + element.element + ">: " + error.what());
  } catch (const std::exception& error) {
    diagnostics.error(kCannotBeMade, element.where,
                      "plug-in '" + element.plugin + "' cannot make <" + element.element + ">: " + error.what(),
                      "report this to the author of the plug-in");
  }
  throw InputError(std::move(diagnostics));
}

}  // namespace presa
