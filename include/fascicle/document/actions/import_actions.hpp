#pragma once
// What was read from files, put to the muscles of the scene. One undo step each. Indices must be in range.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Gives the scene the built-in fibre templates when it has none: every way a scene changes leaves it with them.
void keep_fibre_templates(Scene& scene);

/// The muscle's outlines become these; the attachments in force are then made from them unless vertices or areas are set.
void set_outlines(Document& document, int muscle, std::vector<AttachmentOutline> outlines,
                  const MeshSource& source);
/// fibres: not null.
void set_surface_fibres(Document& document, int muscle, std::shared_ptr<const Polylines> fibres,
                        const MeshSource& source);
/// The muscle's own template; not null.
void set_fibre_template(Document& document, int muscle, std::shared_ptr<const FibreTemplate> fibre_template,
                        const MeshSource& source);
/// lines: not null.
void set_line_muscles(Document& document, std::shared_ptr<const LineMuscles> lines);

} // namespace fascicle::actions
