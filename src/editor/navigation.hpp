#pragma once
// What the mouse does to the camera, as neighbouring programs have it. Chosen in the Window menu, kept in the settings.

#include <array>

namespace fascicle::editor {

enum class Navigation { fascicle, paraview, blender };

struct NavigationRow {
    Navigation navigation;
    const char* key;   ///< in the settings
    const char* label; ///< in the menu
    const char* help;
};

inline constexpr std::array<NavigationRow, 3> navigations{{
    {Navigation::fascicle, "fascicle", "Mouse: default",
     "Left or middle drag orbits, right drag pans, wheel zooms."},
    {Navigation::paraview, "paraview", "Mouse: as in ParaView",
     "Left drag orbits, middle drag pans, right drag zooms."},
    {Navigation::blender, "blender", "Mouse: as in Blender",
     "Middle drag orbits, with Shift pans, with Ctrl zooms; Alt and the left button do the same."},
}};

} // namespace fascicle::editor
