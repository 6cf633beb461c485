#include "view/attachment_marks.hpp"

#include "fascicle/base/assert.hpp"
#include "view/colour_map.hpp"

namespace fascicle::view {

render::Rgba attachment_colour(AttachmentKind kind) {
    switch (kind) {
    case AttachmentKind::origin:
        return palette::origin;
    case AttachmentKind::insertion:
        return palette::insertion;
    case AttachmentKind::unknown:
        break;
    }
    return palette::attachment;
}

std::vector<std::optional<AttachmentKind>> vertex_kinds(int vertex_count,
                                                        const std::vector<Attachment>& attachments) {
    std::vector<std::optional<AttachmentKind>> kinds(static_cast<std::size_t>(vertex_count));
    for (const Attachment& attachment : attachments)
        for (const int vertex : attachment.vertices)
            if (vertex >= 0 && vertex < vertex_count)
                kinds[static_cast<std::size_t>(vertex)] = attachment.kind;
    return kinds;
}

std::vector<BorderSegment> border_segments(const std::vector<Tri>& triangles,
                                           const std::vector<std::optional<AttachmentKind>>& kinds) {
    std::vector<BorderSegment> segments;
    bool draw_insertion = true;
    for (const Tri& triangle : triangles) {
        for (const AttachmentKind kind :
             {AttachmentKind::origin, AttachmentKind::insertion, AttachmentKind::unknown}) {
            int inside = 0, odd_inside = -1, odd_outside = -1; // odd one out: its two edges are cut
            for (int corner = 0; corner < 3; ++corner) {
                const auto vertex = static_cast<std::size_t>(triangle[static_cast<std::size_t>(corner)]);
                FASCICLE_ASSERT(vertex < kinds.size());
                const bool is_inside = kinds[vertex] == kind;
                inside += is_inside ? 1 : 0;
                (is_inside ? odd_inside : odd_outside) = corner;
            }
            if (inside == 0 || inside == 3)
                continue;
            if (kind == AttachmentKind::insertion && !(draw_insertion = !draw_insertion))
                continue;
            const int odd = inside == 1 ? odd_inside : odd_outside;
            const auto at = [&](int k) { return triangle[static_cast<std::size_t>((odd + k) % 3)]; };
            segments.push_back({at(0), at(1), at(0), at(2), kind});
        }
    }
    return segments;
}

} // namespace fascicle::view
