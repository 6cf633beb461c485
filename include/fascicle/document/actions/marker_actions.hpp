#pragma once
// Changes of the timeline's markers: named frames, one a frame, ascending. One undo step each.

#include "fascicle/document/document.hpp"

namespace fascicle::actions {

/// Adds a marker at a frame within 0 and the last one, named "Marker N" when no name is given. False, and no step, when
/// there is one already or the frame is out of range.
bool add_marker(Document& document, int frame, std::string name = {});
/// An empty name, or the one it has: false, and no step.
bool rename_marker(Document& document, std::size_t index, std::string name);
/// To another frame within the timeline; a marker that was there is replaced. False, and no step, when it stays.
bool move_marker(Document& document, std::size_t index, int frame);
bool remove_marker(Document& document, std::size_t index);

/// The marker at the frame, or -1.
int marker_at(const Scene& scene, int frame);

} // namespace fascicle::actions
