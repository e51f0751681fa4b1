#pragma once
#include <memory>
#include <vector>

#include "framework/haptics/renderer.h"
#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/touchables.h"

namespace presa {

/// The renderer that the scene names, with its settings. Loads its plug-in. Throws InputError: the errors of
/// pluginTable; E596 a renderer that cannot be made or does not give what its manifest says.
std::unique_ptr<Renderer> makeRenderer(const World& world);

/// The renderer of the scene's tools, as above.
std::unique_ptr<ToolRenderer> makeToolRenderer(const World& world);

/// The distances that this renderer looks up, for pictures; none: it looks up none. Thread: view. Errors as above.
std::vector<ToolField> toolFieldsOf(const World& world);

/// Whether forces keep ToolRenderer's contract. Haptic thread.
bool keepsContract(const BoundedList<ToolForce>& forces, const Pose& X_WT, const Touchables& touchables) noexcept;

/// Whether a contact keeps Renderer's contract. Haptic thread.
bool keepsContract(const ProxyContact& contact, const BoundedList<RenderedContact>& own,
                   const Touchables& touchables) noexcept;

}  // namespace presa
