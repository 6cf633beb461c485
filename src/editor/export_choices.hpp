#pragma once
// What was chosen in the export dialog last, so that it opens as it was left.

#include "output/export_kinds.hpp"

namespace fascicle::editor {

struct ExportChoices {
    std::string kind = "picture"; ///< key of output::export_kinds()
    std::filesystem::path folder; ///< empty: the current one
    std::string name;             ///< without extension; empty: the scene's
    int scale = 2;                ///< pictures: times the view; 0: width and height
    int width = 1920, height = 1080;
    bool transparent = false;
    bool all_frames = true; ///< of the run; otherwise first to last
    int first = 0, last = 0, step = 1;
    double fps = 25;
    bool dither = true;
    int morph_targets = 64; ///< glTF: shapes beside the first, at most
    char up = 'z';          ///< axis of the scene that points up
};

} // namespace fascicle::editor
