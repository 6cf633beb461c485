#include "fascicle/anatomy/attachment.hpp"

namespace fascicle {

const char* to_text(AttachmentKind kind) {
    switch (kind) {
    case AttachmentKind::origin:
        return "origin";
    case AttachmentKind::insertion:
        return "insertion";
    case AttachmentKind::unknown:
        break;
    }
    return "attachment";
}

} // namespace fascicle
