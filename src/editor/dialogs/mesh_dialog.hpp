#pragma once
// Chooses a mesh file, says what is in it, and adds it to the scene as a bone or a muscle.

#include "editor/dialogs/dialog.hpp"
#include "editor/widgets/file_browser.hpp"
#include "fascicle/document/actions/mesh_actions.hpp"

#include <deque>
#include <future>

namespace fascicle::editor {

class MeshDialog : public Dialog {
public:
    MeshDialog();

    void open();
    /// One after the other, e.g. files dropped on the window.
    void open_with(const std::vector<std::filesystem::path>& files);
    bool is_open() const { return open_; }
    void close() override;
    bool busy() const override { return open_; }
    void draw(EditorContext& context) override;

private:
    void start_reading();
    void poll(EditorContext& context);
    void draw_facts(EditorContext& context, ImVec2 size);
    void draw_choices(EditorContext& context);
    void load(EditorContext& context);
    void next();

    FileBrowser browser_;
    std::deque<std::filesystem::path> waiting_;
    bool open_ = false, appears_ = false;
    std::filesystem::path file_; ///< being read, or read
    std::future<MeshFile> reading_;
    std::optional<MeshFile> mesh_;
    std::string problem_;
    actions::MeshRole role_ = actions::MeshRole::muscle;
    bool moving_ = false;
    double scale_ = 1;
};

} // namespace fascicle::editor
