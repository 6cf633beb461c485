#pragma once
// Keeps copies of unsaved work in the user's folder while there are changes, and asks after a crash what to do with them.

#include "editor/feature.hpp"
#include "fascicle/io/autosave.hpp"

#include <future>

namespace fascicle::editor {

class AutosaveKeeper : public Feature {
public:
    ~AutosaveKeeper() override;
    /// Seconds from a change to its copy: what a crash loses at most.
    double interval = 60;

    /// The session goes on with what another one left: its copies go when this one has its own, or has saved.
    void restored(std::filesystem::path folder);
    /// The program ends; `nothing_lost`: the user has saved or does not want it.
    void close(bool nothing_lost);
    /// Waits for the writer.
    void finish();
    const AutosaveFolder* folder() const { return folder_.get(); }

    void update(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    void ask_about_crashes(EditorContext& context);
    void start(EditorContext& context);
    void poll(EditorContext& context);
    void forget_restored();
    void forget_copies();

    std::unique_ptr<AutosaveFolder> folder_; ///< null: nothing is kept, or not yet
    std::future<void> writing_;
    ScenePtr safe_;                    ///< the scene that is in a file, in the user's or in a copy
    std::optional<double> changed_at_; ///< when the head first was another
    std::filesystem::path restored_;   ///< folder of the session that this one goes on with; empty: none
    double now_ = 0;
    bool asked_ = false, has_copies_ = false;
};

} // namespace fascicle::editor
