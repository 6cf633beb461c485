#include "editor/panels/panels.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <cstdio>

namespace fascicle::editor {

namespace {

/// The step of the lesson that is on: what to read, what to do, how far one is.
class LessonPanel : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        LessonPlayer& player = context.features.lessons;
        if (!player.active()) {
            text(context.theme.text_faint,
                 player.loading() ? "The lesson's scene is being made." : "No lesson is on.");
            return;
        }
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(8)});
        const float foot = 2 * ImGui::GetFrameHeight() + context.px(20);
        const float room = ImGui::GetContentRegionAvail().y;
        static_cast<void>(area);
        if (ImGui::BeginChild("lesson text", {0, std::max(context.px(60), room - foot)})) {
            text(context.theme.text_dim, player.lesson().title);
            draw_progress(context, player);
            text(context.theme.text, player.step().title, "lesson/title");
            text(context.theme.text_dim, player.step().text);
            if (!player.step().task.empty())
                draw_task(context, player);
            if (player.quiz() != nullptr && wants_score(player.step()))
                draw_quiz(context, player);
        }
        if (shown_step_ != player.step_index()) {
            ImGui::SetScrollY(0);
            shown_step_ = player.step_index();
        }
        ImGui::EndChild();
        draw_buttons(context, player);
        ImGui::PopStyleVar();
    }

private:
    static void text(ImU32 colour, const std::string& words, const char* name = nullptr) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(words.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        if (name != nullptr)
            record_item(name);
    }

    static bool wants_score(const LessonStep& step) {
        for (const LessonCheck& check : step.checks)
            if (check.what == "quiz")
                return true;
        return false;
    }

    /// A dot a step: full where it is done, ringed where one is. A click goes to a step that was reached before.
    static void draw_progress(EditorContext& context, LessonPlayer& player) {
        const Theme& theme = context.theme;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const int count = static_cast<int>(player.lesson().steps.size());
        const float step = std::min(context.px(24),
                                    ImGui::GetContentRegionAvail().x / static_cast<float>(count)),
                    height = context.px(18);
        for (int i = 0; i < count; ++i) {
            ImGui::PushID(i);
            const bool reached = i <= player.furthest();
            ImGui::BeginDisabled(!reached);
            if (ImGui::InvisibleButton("dot", {step, height}))
                player.go_to(i);
            ImGui::EndDisabled();
            record_item("lesson/step/" + std::to_string(i));
            const ImVec2 min = ImGui::GetItemRectMin();
            const ImVec2 middle{min.x + context.px(7), min.y + height / 2};
            if (i + 1 < count)
                list.AddLine({middle.x + context.px(8), middle.y}, {min.x + step - context.px(1), middle.y},
                             theme.line, context.px(1.5f));
            if (player.done(i))
                list.AddCircleFilled(middle, context.px(4.5f), theme.accent);
            else
                list.AddCircle(middle, context.px(4.5f), reached ? theme.text_dim : theme.line, 0,
                               context.px(1.5f));
            if (i == player.step_index())
                list.AddCircle(middle, context.px(7), theme.accent, 0, context.px(1.5f));
            item_tooltip("Step " + std::to_string(i + 1) + " of " + std::to_string(count) + "\n" +
                         player.lesson().steps[static_cast<std::size_t>(i)].title +
                         (reached ? "" : "\nNot now: the steps before it come first."));
            ImGui::PopID();
            if (i + 1 < count)
                ImGui::SameLine(0, 0);
        }
    }

    /// A card with a tick as soon as it is done.
    static void draw_task(EditorContext& context, const LessonPlayer& player) {
        const Theme& theme = context.theme;
        const bool done = player.done(player.step_index());
        const std::string standing = done ? std::string() : player.standing(context);
        const float pad = context.px(10), mark = context.px(24), width = ImGui::GetContentRegionAvail().x;
        const float wrap = width - 2 * pad - mark;
        const auto height_of = [&](const std::string& words) {
            return words.empty() ? 0.0f : ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap).y;
        };
        const float line = height_of(player.step().task), below = height_of(standing);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float height = 2 * pad + line + (below > 0 ? below + context.px(4) : 0);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(at, {at.x + width, at.y + height},
                           done ? with_alpha(theme.good, 0.16f) : theme.field, context.px(6));
        list.AddRectFilled(at, {at.x + context.px(3), at.y + height}, done ? theme.good : theme.accent,
                           context.px(2));
        draw_text_in(list,
                     {{at.x + pad, at.y + pad}, {at.x + pad + mark, at.y + pad + ImGui::GetTextLineHeight()}},
                     done ? theme.good : theme.text_faint,
                     fascicle::editor::text(done ? icons::check : icons::circle));
        const float x = at.x + pad + mark;
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, at.y + pad}, theme.text,
                     player.step().task.c_str(), nullptr, wrap);
        if (below > 0)
            list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, at.y + pad + line + context.px(4)},
                         theme.text_dim, standing.c_str(), nullptr, wrap);
        ImGui::Dummy({width, height});
        record_item("lesson/task");
    }

    static void draw_quiz(EditorContext& context, LessonPlayer& player) {
        const float width = ImGui::GetContentRegionAvail().x;
        const float ring = context.px(5); // that a lesson draws round it
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ring);
        if (ImGui::Button(player.last_score() ? "Score it again" : "Score it", {width - 2 * ring, 0}))
            player.score(context);
        record_item("lesson/score");
        item_tooltip("Compares what is painted with the true area, and shows that as a line.");
        if (!player.last_score())
            return;
        const RegionOverlap& score = *player.last_score();
        const double mm = millimetres_per_unit(context.document.scene().unit), mm2 = mm * mm;
        const auto row = [&](const char* label, const char* format, double value, const char* tip) {
            char number[40];
            std::snprintf(number, sizeof number, format, value);
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float height = context.px(20);
            const Rect place{at, {at.x + width, at.y + height}};
            draw_text_in(*ImGui::GetWindowDrawList(), place, context.theme.text_dim, label);
            draw_text_in(*ImGui::GetWindowDrawList(), place, context.theme.text, number, Align::right);
            ImGui::Dummy({width, height});
            item_tooltip(tip);
        };
        row("Overlap (Dice)", "%.0f %%", 100 * score.dice(),
            "Dice\nTwice what is in both areas over the sum of the two: 100 % for the same area, 0 % for "
            "areas apart.");
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float bar = context.px(6);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(at, {at.x + width, at.y + bar}, context.theme.field, bar / 2);
        if (score.dice() > 0.02)
            list.AddRectFilled(at, {at.x + width * static_cast<float>(score.dice()), at.y + bar},
                               context.theme.accent, bar / 2);
        ImGui::Dummy({width, bar});
        record_item("lesson/score/bar");
        row("Overlap (Jaccard)", "%.0f %%", 100 * score.jaccard(),
            "Jaccard\nWhat is in both areas over what is in either.");
        row("Yours", "%.0f mm2", score.first * mm2,
            "Area of what is painted: a third of the triangles of each vertex.");
        row("True", "%.0f mm2", score.second * mm2,
            "Area under the attachment that the scene was made with.");
        row("Both", "%.0f mm2", score.both * mm2, "What is painted rightly.");
    }

    static void draw_buttons(EditorContext& context, LessonPlayer& player) {
        const float width = ImGui::GetContentRegionAvail().x, gap = context.px(8);
        const float half = (width - gap) / 2;
        const bool done = player.done(player.step_index());
        ImGui::BeginDisabled(player.step_index() == 0);
        if (ImGui::Button("Back", {half, 0}))
            player.go_to(player.step_index() - 1);
        ImGui::EndDisabled();
        record_item("lesson/back");
        item_tooltip("The step before, as it begins.");
        ImGui::SameLine(0, gap);
        ImGui::BeginDisabled(!done);
        ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
        if (ImGui::Button(player.on_last_step() ? "Finish" : "Next", {half, 0})) {
            if (player.on_last_step())
                player.leave();
            else
                player.go_to(player.step_index() + 1);
        }
        ImGui::PopStyleColor();
        ImGui::EndDisabled();
        record_item("lesson/next");
        item_tooltip(done ? (player.on_last_step() ? "Leaves the lesson; what was open before comes back."
                                                   : "The next step.")
                          : "Not now: what the step asks for comes first, or skip it.");
        if (ImGui::Button("Leave the lesson", {half, 0}))
            player.leave();
        record_item("lesson/leave");
        item_tooltip("What was open before comes back as it was. Nothing is asked.");
        ImGui::SameLine(0, gap);
        ImGui::BeginDisabled(done || player.on_last_step());
        if (ImGui::Button("Skip", {half, 0}))
            player.go_to(player.step_index() + 1);
        ImGui::EndDisabled();
        record_item("lesson/skip");
        item_tooltip("The next step, without having done this one.");
    }

    int shown_step_ = -1;
};

} // namespace

std::unique_ptr<Panel> make_lesson() {
    return std::make_unique<LessonPanel>();
}

} // namespace fascicle::editor
