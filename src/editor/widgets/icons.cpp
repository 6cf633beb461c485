#include "editor/widgets/icons.hpp"

namespace fascicle::editor {

namespace {
bool available = true;
}

void set_icons_available(bool is_available) {
    available = is_available;
}

bool icons_available() {
    return available;
}

const char* text(const Icon& icon) {
    return available ? icon.glyph : icon.words;
}

} // namespace fascicle::editor
