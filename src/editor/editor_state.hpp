#pragma once
// How the scene is looked at: selection, visibility, camera, playhead, colours. Never undone, never saved with
// the scene.

#include "editor/layout.hpp"
#include "editor/widgets/plot.hpp"
#include "view/camera.hpp"
#include "view/colouring.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace fascicle::editor {

/// By name, so that it outlives undo and indices that move.
struct Selection {
    enum class Kind { none, bone, muscle };
    Kind kind = Kind::none;
    std::string name;
    bool operator==(const Selection&) const = default;
};

/// One fibre of a muscle.
struct FibreRef {
    std::string muscle;
    int fibre = 0; ///< index in the muscle's FibreModel
    bool operator==(const FibreRef&) const = default;
};

/// What the pointer does in the viewport.
enum class Tool { look, paint };

/// What the ruler and the plots' axes show at a frame.
enum class RulerUnit { frame, seconds, angle };

struct Playback {
    bool playing = false;
    bool loop = true;
    double speed = 1;    ///< times real time, > 0
    double position = 0; ///< fractional frame; the playhead is its whole part
    int playhead() const { return static_cast<int>(position); }
};

struct EditorState {
    Selection selection;
    Tool tool = Tool::look;
    std::set<std::string> hidden; ///< names of bones and muscles
    view::Camera camera;
    std::array<std::optional<view::Camera>, 4> camera_slots;
    bool frame_view_pending = true; ///< fill the view with the scene as soon as its size is known
    double view_aspect = 1.5;       ///< width over height of the viewport

    Playback playback;
    RulerUnit ruler = RulerUnit::frame;
    std::optional<double> hover_frame;      ///< under the pointer, in any plot or the ruler
    std::optional<double> next_hover_frame; ///< set by panels, shown in the next frame
    PlotRange plot_range{0, 1};
    double plot_range_for = 0; ///< last frame that plot_range was made for
    std::set<std::string> hidden_curves;

    std::optional<FibreRef> hover_fibre;      ///< under the pointer, in a plot or in the view
    std::optional<FibreRef> next_hover_fibre; ///< set by panels, shown in the next frame

    view::Colouring colouring = view::Colouring::anatomy; ///< what muscles are coloured by
    bool wireframe = false;
    bool attachments = true;
    bool rest_ghost = false; ///< muscles at rest, faint
    bool joint_axis = true;

    LayoutSizes layout;
    std::string bottom_panel = "plots";    ///< id of the panel in front below
    std::string side_panel = "parameters"; ///< and at the right side
    bool dark = true;
    float scale = 1;       ///< of the interface
    float start_scale = 1; ///< what "normal" means

    bool show_shortcuts = false;
    bool show_start = false; ///< the start page instead of the scene

    // Wishes to whoever owns the window.
    bool wants_quit = false;
    bool wants_full_screen = false;
    std::optional<std::filesystem::path> wants_picture; ///< of the view, into this file

    bool visible(const std::string& name) const { return hidden.count(name) == 0; }
};

} // namespace fascicle::editor
