#pragma once
// A model, a trial and meshes on their way to become a scene: what is read ahead in the background, what was guessed and chosen.

#include "fascicle/io/load_scene.hpp"

#include <future>

namespace fascicle::editor {

class OsimChoice {
public:
    /// A mesh file, or a line muscle of the model for which a spindle stands in (mesh: its name).
    struct Row {
        std::filesystem::path mesh;
        bool stand_in = false;
        bool bone = false;
        std::string origin, insertion; ///< bodies; of a bone the first alone
        bool guessed = true;           ///< bodies come from names, nobody chose them
    };

    /// By extension: .osim is the model, .mot and .sto the trial, anything else a mesh.
    void take(const std::filesystem::path& file);
    void add_stand_in(const std::string& muscle);
    void remove(std::size_t row);
    void clear();

    /// Starts and ends reading; true when something has changed.
    bool poll();
    bool reading() const { return reading_.valid(); }
    const std::optional<OsimPreview>& preview() const { return preview_; }
    const std::string& problem() const { return problem_; }

    std::vector<Row>& rows() { return rows_; }
    const std::filesystem::path& model() const { return request_.osim.model; }
    const std::filesystem::path& trial() const { return request_.motion; }
    /// Units, axes, mesh frame, coordinate and part of the trial, to be set directly.
    SceneRequest& request() { return request_; }
    /// What to open; `why`: why it cannot be yet, one sentence, else empty.
    SceneRequest finished(std::string& why) const;

private:
    void read_again();
    void guess(Row& row) const;
    SceneRequest request_; ///< without muscles and bones: those are the rows
    std::vector<Row> rows_;
    std::optional<OsimPreview> preview_;
    std::string problem_;
    bool stale_ = false;
    std::future<OsimPreview> reading_;
    std::vector<std::future<OsimPreview>> given_up_; ///< waited for without blocking
};

} // namespace fascicle::editor
