#pragma once
// The editor's main screens as pictures, without a display: for the documents, for tests, and to be looked at. A screen is
// reached by what a person does: clicks, keys, commands. A new one is a row of screens().

#include "fascicle/base/job_control.hpp"
#include "render/draw_list.hpp"

#include <string>
#include <vector>

namespace fascicle::editor {

struct ScreenOptions {
    int width = 1280, height = 800; ///< pixels
    float scale = 1;                ///< of the interface
    bool dark = true;
    std::vector<std::string> only; ///< ids; empty: all of them
};

class ScreenStage;

struct ScreenRow {
    const char* id;    ///< also the file's name
    const char* title; ///< one line, for lists
    void (*prepare)(ScreenStage&);
};
const std::vector<ScreenRow>& screens();

struct ScreenPicture {
    const ScreenRow* row;
    render::Image image;
};

/// The screens of the embedded hip scene, run twice: with its own parameters and with others. Error (usage) for an id that is
/// none; error when OSMesa is missing.
std::vector<ScreenPicture> draw_screens(const ScreenOptions& options = {}, const JobControl& control = {});

} // namespace fascicle::editor
