#pragma once
// Attachment areas on a muscle: which vertex belongs to which kind, and the border between them.

#include "fascicle/anatomy/attachment.hpp"
#include "render/draw_list.hpp"

#include <optional>
#include <vector>

namespace fascicle::view {

/// Colour of an attachment area.
render::Rgba attachment_colour(AttachmentKind kind);

/// Kind per vertex, nothing where the muscle is free. A vertex of several attachments has the last one's kind; vertices
/// out of range are passed over.
std::vector<std::optional<AttachmentKind>> vertex_kinds(int vertex_count,
                                                        const std::vector<Attachment>& attachments);

/// A border segment runs from the middle of edge (a0, a1) to the middle of edge (b0, b1).
struct BorderSegment {
    int a0, a1, b0, b1;
    AttachmentKind kind; ///< of the area it encloses
};

/// Segments through every triangle whose corners do not all have one kind; where two areas touch, one for each. Of an
/// insertion only every second segment is there: its border looks dotted, so that colour is not the only sign.
std::vector<BorderSegment> border_segments(const std::vector<Tri>& triangles,
                                           const std::vector<std::optional<AttachmentKind>>& kinds);

} // namespace fascicle::view
