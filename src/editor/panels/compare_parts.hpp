#pragma once
// The parts of the panel Compare, from top to bottom.

#include "editor/features.hpp"
#include "editor/widgets/paint.hpp"

#include <map>

namespace fascicle::editor {

/// How runs are shown, and what that way of showing needs.
void draw_compare_mode(EditorContext& context);

/// The kept runs: which is A, which is B, names, pins.
class CompareRuns {
public:
    void draw(EditorContext& context);

private:
    void draw_present(EditorContext& context, float width);
    void draw_run(EditorContext& context, const KeptRun& run, float width);
    void draw_name(EditorContext& context, const KeptRun& run, const Rect& place);
    const std::string& difference_text(const EditorContext& context, const KeptRun& run);
    static void draw_loading(EditorContext& context, float width);

    int renaming_ = 0; ///< number of the run whose name is being typed
    bool rename_begins_ = false;
    std::string typed_;
    std::pair<int, bool> pin_{}; ///< wishes, met after the list was gone through
    int delete_ = 0;
    std::map<int, std::string> texts_; ///< what differs from the document's parameters
    std::uint64_t texts_version_ = 0;
    int texts_shelf_ = -1;
};

/// Distances between A and B, by muscle.
void draw_distances(EditorContext& context);

/// Parameters that A and B have different values of.
class CompareParameters {
public:
    void draw(EditorContext& context);

private:
    RecordingPtr a_, b_;
    std::vector<ParamDifference> rows_;
};

/// A title with a line to the right border.
void draw_compare_heading(const EditorContext& context, const std::string& title);
/// Wrapped text in one colour.
void draw_compare_text(ImU32 colour, const std::string& text);
/// A parameter's value with its unit.
std::string parameter_text(const ParamRow& row, const std::string& value);

} // namespace fascicle::editor
