#include "editor/widgets/orientation_cube.hpp"

#include "editor/widgets/item_recorder.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace fascicle::editor {

namespace {

struct Face {
    const char* letter;
    view::StandardView standard;
    Vec3 normal, side, up;
};

std::array<Face, 6> faces(const view::Camera& camera) {
    using S = view::StandardView;
    const view::AnatomicalFrame f = view::anatomical_frame(camera.axes());
    const Vec3 &a = f.anterior, &l = f.left, &s = f.superior;
    return {{{"A", S::anterior, a, l, s},
             {"P", S::posterior, -a, -l, s},
             {"L", S::left, l, -a, s},
             {"R", S::right, -l, a, s},
             {"S", S::superior, s, l, a},
             {"I", S::inferior, -s, l, -a}}};
}

bool inside(const std::array<ImVec2, 4>& corners, ImVec2 p) {
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const ImVec2 a = corners[i], b = corners[(i + 1) % 4];
        const float side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        left += side > 0 ? 1 : 0;
        right += side < 0 ? 1 : 0;
    }
    return left == 0 || right == 0;
}

} // namespace

CubeResult draw_orientation_cube(ImDrawList& list, const view::Camera& camera, ImVec2 middle, float radius,
                                 ImVec2 pointer, bool may_act, bool clicked, const Theme& theme) {
    CubeResult result;
    const Vec3 right = camera.right(), up = camera.up(), towards = camera.backward();
    const auto half = static_cast<double>(radius) / std::sqrt(3.0); // corners stay within the radius
    const auto place = [&](const Vec3& p) {
        return ImVec2(middle.x + static_cast<float>(p.dot(right) * half),
                      middle.y - static_cast<float>(p.dot(up) * half));
    };
    list.AddCircleFilled(middle, radius * 1.12f, with_alpha(theme.badge, 0.35f), 48);
    for (const Face& face : faces(camera)) {
        const double facing = face.normal.dot(towards);
        if (facing <= 0.02)
            continue;
        const std::array<ImVec2, 4> corners{
            place(face.normal - face.side - face.up), place(face.normal + face.side - face.up),
            place(face.normal + face.side + face.up), place(face.normal - face.side + face.up)};
        const bool hovered = may_act && inside(corners, pointer);
        if (hovered) {
            result.hovered = true;
            if (clicked)
                result.clicked = face.standard;
        }
        const ImU32 plate = hovered ? theme.accent : theme.dark ? theme.field_active : theme.panel;
        list.AddConvexPolyFilled(corners.data(), 4,
                                 with_alpha(plate, 0.55f + 0.45f * static_cast<float>(facing)));
        list.AddPolyline(corners.data(), 4, theme.line, ImDrawFlags_Closed, 1.0f);
        const ImVec2 at = place(face.normal);
        record_item(std::string("viewport/cube/") + face.letter,
                    {{at.x - 2, at.y - 2}, {at.x + 2, at.y + 2}});
        if (facing > 0.3) {
            const ImVec2 size = text_size(face.letter);
            draw_text(list, {at.x - size.x / 2, at.y - size.y / 2},
                      with_alpha(hovered ? theme.on_accent : theme.text,
                                 static_cast<float>(std::min(1.0, facing * 1.4))),
                      face.letter);
        }
    }
    return result;
}

} // namespace fascicle::editor
