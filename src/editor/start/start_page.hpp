#pragma once
// The first thing that a person sees: recent projects, scenes to begin with, and the ways to load something of one's own.

#include "editor/feature.hpp"
#include "editor/layout.hpp"
#include "editor/start/scene_pictures.hpp"
#include "editor/start/start_sections.hpp"

namespace fascicle::editor {

class StartPage : public Feature {
public:
    /// In place of all panels, while EditorState::show_start is set.
    void draw(EditorContext& context, const Rect& area, ImFont* heading);
    void update(EditorContext& context) override;
    std::optional<double> redraw_after() const override;
    /// Waits for a scene whose picture is being made; for pictures and tests.
    void wait() { pictures_.wait(); }

private:
    struct Card {
        StartCard card;
        PictureTexture picture;
    };
    struct Section {
        const StartSection* section;
        std::vector<Card> cards;
    };
    void collect(EditorContext& context);
    void draw_ways_in(EditorContext& context, float width);
    void draw_drop_place(const EditorContext& context, float width, float height);
    void draw_state(EditorContext& context, float width);
    void draw_section(EditorContext& context, Section& section, float width);
    void draw_card(EditorContext& context, Card& card, const Rect& area);

    std::vector<Section> sections_;
    ScenePictures pictures_;
    std::function<void(EditorContext&)> wish_; ///< what a card was clicked for, done after drawing
    ImFont* heading_ = nullptr;                ///< in draw()
    bool shown_ = false, stale_ = true;
};

/// Meshes dropped on the start page, or asked for there: into a new scene when the present one is in use.
void start_with_meshes(EditorContext& context, const std::vector<std::filesystem::path>& files);

} // namespace fascicle::editor
