#pragma once
// What the program remembers of its user between sessions: theme, scale, mouse, sizes of the panels, keys of one's own.

#include "editor/feature.hpp"
#include "fascicle/io/settings_file.hpp"

namespace fascicle::editor {

/// Reads settings.json and keys.json of the user's folder at the first frame, writes settings.json some time after a change.
/// A file that cannot be read gives a line in the log and the defaults.
class SettingsKeeper : public Feature {
public:
    /// Seconds without a change before the file is written.
    static constexpr double settle_seconds = 1.0;

    ~SettingsKeeper() override;
    void update(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    void load(EditorContext& context);
    void save();

    std::filesystem::path file_; ///< empty: nothing is kept
    Settings now_, saved_;
    double changed_ = 0;
    bool loaded_ = false;
};

} // namespace fascicle::editor
