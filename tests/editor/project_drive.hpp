#pragma once
// What the tests of projects do with the editor again and again.

#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <imgui_internal.h>

namespace fascicle::test {

using namespace fascicle::editor;
namespace fs = std::filesystem;

inline constexpr Modifiers ctrl{.ctrl = true}, ctrl_shift{.ctrl = true, .shift = true};

inline void edit(Driver& d, double value = 0.4) {
    actions::set_parameter(d.document(), "solver.stiffness", value);
    d.frame();
}

inline double value(Driver& d) {
    return d.document().scene().parameters.get("solver.stiffness");
}

/// Until what was started in the background is done and has been taken.
inline void finish(Driver& d) {
    d.frame();
    d.editor().features().project.finish();
    d.editor().features().opener.finish();
    d.editor().features().watch.finish();
    d.editor().features().autosave.finish();
    d.frame(4);
}

/// Types over what stands in a text field.
inline void write_into(Driver& d, const std::string& field, const std::string& text) {
    d.click(field);
    d.key(key_a, ctrl);
    d.type(text);
}

inline bool popup_open() {
    return ImGui::GetTopMostPopupModal() != nullptr;
}

inline std::string title(Driver& d) {
    return d.document().path().filename().string() + (d.document().dirty() ? " *" : "");
}

/// A bone from a file beside a muscle that is in none.
inline Scene scene_with_file(const fs::path& bone) {
    MeshData data;
    data.mesh = box(20, 20, 40);
    write_mesh_file(bone, data);
    Scene scene = small_scene();
    std::vector<std::string> notes;
    scene.bones[0] = load_bone(bone, notes);
    return scene;
}

} // namespace fascicle::test
