#pragma once
// What the program remembers of its user between sessions: theme, scale, mouse, sizes of the panels, keys of one's own.

#include "editor/feature.hpp"

namespace fascicle::editor {

/// Reads settings.json and keys.json of the user's folder at the first frame, writes settings.json some time after a change.
/// A file that cannot be read gives a line in the log and the defaults; fields that this version does not know survive.
class Settings : public Feature {
public:
    /// Seconds without a change before the file is written.
    static constexpr double settle_seconds = 1.0;

    ~Settings() override;
    void update(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    void load(EditorContext& context);
    void save();

    std::filesystem::path folder_;
    std::string text_;  ///< of the settings as they are now
    std::string saved_; ///< of the file
    double changed_ = 0;
    bool loaded_ = false;
};

} // namespace fascicle::editor
