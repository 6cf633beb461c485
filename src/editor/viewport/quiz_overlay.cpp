#include "editor/features.hpp"
#include "editor/viewport_tool.hpp"
#include "editor/widgets/item_recorder.hpp"

namespace fascicle::editor {

void draw_quiz_truth(EditorContext& context, ImDrawList& list, const Rect& area) {
    const LessonPlayer& player = context.features.lessons;
    if (!player.active() || player.quiz() == nullptr || !player.last_score())
        return;
    const Quiz& quiz = *player.quiz();
    const ShownFrame shown = context.shown();
    const int bone = context.shown_scene().bone_index(quiz.bone);
    if (bone < 0)
        return;
    const Pose pose =
        shown.frame != nullptr ? shown.frame->bone_poses[static_cast<std::size_t>(bone)] : Pose{};
    const view::Camera& camera = context.state.camera;
    const view::ViewSize size{double(area.width()), double(area.height())};
    const auto on_screen = [&](const Vec3& p) -> std::optional<ImVec2> {
        const std::optional<Vec2> at = camera.project(pose.apply(p), size);
        if (!at)
            return std::nullopt;
        return ImVec2{area.min.x + static_cast<float>(at->x()), area.min.y + static_cast<float>(at->y())};
    };
    list.PushClipRect(area.min, area.max, true);
    ImVec2 low{area.max}, high{area.min};
    // Dark under light, so that the line is seen on bone and on paint; what faces away is left faint.
    for (const bool under : {true, false})
        for (std::size_t i = 0; i < quiz.border.size(); ++i) {
            const auto a = on_screen(quiz.border[i].first), b = on_screen(quiz.border[i].second);
            if (!a || !b)
                continue;
            const Vec3 normal = pose.rotation * quiz.border_normals[i];
            const bool faces = normal.dot(camera.eye() - pose.apply(quiz.border[i].first)) > 0;
            const ImU32 colour = under ? IM_COL32(0, 0, 0, 160) : context.theme.good;
            list.AddLine(*a, *b, with_alpha(colour, (under ? 0.6f : 1.0f) * (faces ? 1.0f : 0.25f)),
                         context.px(under ? 4.0f : 2.0f));
            low = {std::min(low.x, a->x), std::min(low.y, a->y)};
            high = {std::max(high.x, a->x), std::max(high.y, a->y)};
        }
    list.PopClipRect();
    if (low.x <= high.x && low.y <= high.y)
        record_item("viewport/quiz", Rect{low, high});
}

} // namespace fascicle::editor
