#pragma once
// Where a muscle is fixed to bones: outlines as digitised, and the muscle vertices that follow from them.

#include "fascicle/geometry/tri_mesh.hpp"

#include <string>

namespace fascicle {

enum class AttachmentKind { origin, insertion, unknown };
const char* to_text(AttachmentKind kind);

/// A digitised border on a bone: ordered points in scene units, closed unless its ends are far apart.
struct AttachmentOutline {
    AttachmentKind kind = AttachmentKind::unknown;
    std::string bone; ///< name as in the file; need not be a bone of the scene
    Points points;
    std::string head = {}; ///< of a muscle with several; empty: the only one
    bool hole = false;     ///< what it encloses is taken out of the area instead of added
};

/// Muscle vertices fixed to one bone: they move rigidly with it.
struct Attachment {
    AttachmentKind kind = AttachmentKind::unknown;
    int bone = -1;             ///< index into Scene::bones
    std::vector<int> vertices; ///< ascending indices into the muscle mesh, each at most once
};

} // namespace fascicle
