#pragma once
// How the scene is looked at: selection, visibility, camera, playhead, colours. Never undone, never saved with
// the scene.

#include "editor/export_choices.hpp"
#include "editor/layout.hpp"
#include "editor/navigation.hpp"
#include "editor/plot_state.hpp"
#include "editor/section.hpp"
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
enum class Tool { look, paint, pick_point };

/// What the ruler and the plots' axes show at a frame.
enum class RulerUnit { frame, seconds, angle };

/// What happens at the end of the frames that are played.
enum class Repeat { once, loop, ping_pong };

struct Playback {
    bool playing = false;
    Repeat repeat = Repeat::loop;
    double speed = 1;         ///< times real time, -4 to 4 but not 0; negative: backwards
    bool every_frame = false; ///< leaves no frame out, however long that takes; otherwise real time
    bool turned = false;      ///< ping-pong: on the way back
    double position = 0;      ///< fractional frame; the playhead is its whole part
    std::optional<std::pair<int, int>> range; ///< first and last frame that are played; none: all
    int playhead() const { return static_cast<int>(position); }
};

struct EditorState {
    Selection selection;
    Tool tool = Tool::look;
    std::set<std::string> hidden; ///< names of bones and muscles
    view::Camera camera;
    std::array<std::optional<view::Camera>, 4> camera_slots;
    bool frame_view_pending = true;      ///< fill the view with the scene as soon as its size is known
    double view_aspect = 1.5;            ///< width over height of the viewport
    int view_width = 1, view_height = 1; ///< its size in pixels

    Playback playback;
    RulerUnit ruler = RulerUnit::frame;
    std::optional<double> hover_frame;      ///< under the pointer, in any plot or the ruler
    std::optional<double> next_hover_frame; ///< set by panels, shown in the next frame
    PlotRange plot_range{0, 1};
    double plot_range_for = 0; ///< last frame that plot_range was made for
    std::set<std::string> hidden_curves;
    PlotsState plots;

    std::optional<FibreRef> hover_fibre;      ///< under the pointer, in a plot or in the view
    std::optional<FibreRef> next_hover_fibre; ///< set by panels, shown in the next frame

    view::Colouring colouring = view::Colouring::anatomy; ///< what muscles are coloured by
    bool wireframe = false;
    bool attachments = true;
    bool rest_ghost = false; ///< muscles at rest, faint
    bool joint_axis = true;
    view::ColourScales colour_scales;  ///< ends of the legends
    float muscle_opacity = 1;          ///< 0 to 1
    float see_through_opacity = 0.35f; ///< that the muscles go to when they are made transparent
    float bone_opacity = 1;            ///< 0 to 1
    bool fibres = true;                ///< where muscles let them be seen
    bool line_muscles = true;          ///< of the scene's model
    bool occlusion = true;             ///< surfaces darken each other where they are near
    Section section;
    BoundingBox scene_box; ///< whatever may come into view, set by the viewport

    LayoutSizes layout;
    std::string bottom_panel = "plots";    ///< id of the panel in front below
    std::string side_panel = "parameters"; ///< and at the right side
    bool dark = true;
    float scale = 1;       ///< of the interface
    float start_scale = 1; ///< what "normal" means

    Navigation navigation = Navigation::fascicle;

    bool show_shortcuts = false;
    bool show_start = false; ///< the start page instead of the scene
    bool presenting = false; ///< larger, full screen
    int last_command = -1;   ///< Command that a key ran last, for tests and the status line; -1: none
    ExportChoices exporting; ///< of the export dialog

    // Wishes to whoever owns the window.
    bool wants_quit = false;
    bool wants_full_screen = false;
    std::optional<std::filesystem::path> wants_picture; ///< of the view, into this file

    bool visible(const std::string& name) const { return hidden.count(name) == 0; }
};

} // namespace fascicle::editor
