#pragma once
// Small pictures of the view, for lists of projects.

#include "editor/editor_context.hpp"
#include "fascicle/io/png.hpp"

#include <optional>

namespace fascicle::editor {

inline constexpr int thumbnail_width = 320, thumbnail_height = 200; ///< pixels

/// The scene as the view shows it now; nothing without a graphics context or when it cannot be drawn.
std::optional<PngImage> take_thumbnail(const EditorContext& context);

} // namespace fascicle::editor
