#pragma once
// Where widgets are, by name, so that tests click what a person clicks. Costs nothing while nobody records.

#include "editor/layout.hpp"

#include <map>
#include <string>
#include <string_view>

namespace fascicle::editor {

/// Rectangles of one frame's widgets.
class ItemRecorder {
public:
    void begin_frame() { items_.clear(); }
    void add(std::string_view name, const Rect& rect) { items_[std::string(name)] = rect; }
    /// Null when nothing of that name was drawn in the last frame.
    const Rect* find(std::string_view name) const;
    const std::map<std::string, Rect, std::less<>>& items() const { return items_; }

private:
    std::map<std::string, Rect, std::less<>> items_;
};

/// The recorder that record_item() writes to; null (the default) for none.
void set_item_recorder(ItemRecorder* recorder);
ItemRecorder* item_recorder();

/// The widget drawn last, or a place given. Names look like "toolbar/play" or "parameter/solver.stiffness".
void record_item(std::string_view name);
void record_item(std::string_view name, const Rect& rect);

} // namespace fascicle::editor
