#pragma once
// The presets on offer: those of the program and the user's own in context.user_folder/presets.

#include "editor/feature.hpp"
#include "fascicle/io/preset_file.hpp"

namespace fascicle::editor {

class PresetStore : public Feature {
public:
    /// Built-in ones first, then the user's own by file name. Read when first asked for, and after each change.
    const std::vector<Preset>& all(EditorContext& context);
    /// Sets the preset's values as one undo step; the log says how many values changed.
    void apply(EditorContext& context, const Preset& preset);
    /// Keeps the edited values under a name; one of that name is replaced. False, with a line in the log, when it cannot be kept.
    bool save(EditorContext& context, const std::string& name);
    /// Deletes the file of one of the user's own.
    void remove(EditorContext& context, const Preset& preset);
    /// Why a name cannot be used; empty when it can.
    std::string fault_of(const EditorContext& context, const std::string& name) const;
    bool replaces(const std::string& name) const; ///< one of the user's own

private:
    void read(EditorContext& context);
    std::vector<Preset> presets_;
    bool read_ = false;
};

} // namespace fascicle::editor
