#pragma once
// Attachment outlines from a table of points: attachment,bone,x_mm,y_mm,z_mm.

#include "fascicle/scene/scene.hpp"

#include <filesystem>
#include <string_view>

namespace fascicle {

/// Columns in any order: `attachment` (origin or insertion), `bone`, and x, y, z, all three with the same unit: `_mm`,
/// `_cm`, `_m`, also written " [mm]" or " (mm)"; without a unit they are in scene units. Comma, semicolon or tab,
/// dot or comma decimals. Further columns, each may be missing: `head` (of a muscle with several), `loop` (any text), `hole` (1:
/// what the outline encloses is taken out of the area; 0 or empty: added). Rows that follow each other with the same attachment, bone, head, loop
/// and hole form one outline; points come out in scene units. Error naming file and line for a missing column, another word, a
/// bad number, no rows.
std::vector<AttachmentOutline> read_attachments(std::string_view bytes, const std::string& file,
                                                LengthUnit scene_unit);

std::vector<AttachmentOutline> read_attachment_file(const std::filesystem::path& path, LengthUnit scene_unit);

} // namespace fascicle
