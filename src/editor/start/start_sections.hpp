#pragma once
// What the start page offers: sections of cards. A new section is a function and a row of start_sections().

#include "editor/editor_context.hpp"

#include <functional>

namespace fascicle::editor {

struct StartCard {
    std::string id; ///< of its widgets: "start/ID"
    std::string title, line;
    std::string tip;
    std::filesystem::path picture{}; ///< a PNG file; empty: see `embedded`
    std::string embedded{};          ///< the embedded scene to be pictured
    std::string missing{}; ///< why it cannot be opened; shown in place of the line, the card is greyed
    std::function<void(EditorContext&)> open{};
    std::function<void(EditorContext&)> remove{}; ///< from the list; null: it stays
};

struct StartSection {
    const char* title;
    const char* empty; ///< what is said when there are no cards; null: the section is left out then
    std::vector<StartCard> (*cards)(EditorContext&);
};

const std::vector<StartSection>& start_sections();

} // namespace fascicle::editor
