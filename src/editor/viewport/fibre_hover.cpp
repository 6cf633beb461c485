#include "editor/viewport/fibre_hover.hpp"

#include "editor/scene_view.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace fascicle::editor {

namespace {

constexpr ImU32 bright = IM_COL32(255, 226, 64, 255), rim = IM_COL32(20, 16, 8, 210);

/// Squared distance of p to the segment from a to b; infinite when an end is not on the screen.
double squared_distance(const Vec2& p, const ImVec2& a, const ImVec2& b) {
    if (std::isnan(a.x) || std::isnan(b.x))
        return std::numeric_limits<double>::infinity();
    const Vec2 start(double(a.x), double(a.y)), way(double(b.x) - double(a.x), double(b.y) - double(a.y));
    const double length = way.squaredNorm();
    const double t = length > 0 ? std::clamp((p - start).dot(way) / length, 0.0, 1.0) : 0.0;
    return (p - start - t * way).squaredNorm();
}

double length_of(std::span<const Vec3> points) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        length += (points[i + 1] - points[i]).norm();
    return length;
}

} // namespace

bool FibreHover::Lens::operator==(const Lens& other) const {
    return eye == other.eye && right == other.right && up == other.up && backward == other.backward &&
           units_per_pixel == other.units_per_pixel && distance == other.distance && width == other.width &&
           height == other.height && orthographic == other.orthographic && section == other.section;
}

void FibreHover::use_lens(const EditorContext& context, const view::ViewSize& size) {
    const view::Camera& camera = context.state.camera;
    Lens lens{camera.eye(),
              camera.right(),
              camera.up(),
              camera.backward(),
              camera.units_per_pixel(size),
              camera.distance(),
              size.width,
              size.height,
              camera.orthographic(),
              section_plane(context.state.section)};
    if (lens_number_ == 0 || !(lens == lens_)) {
        lens_ = lens;
        ++lens_number_;
    }
}

FibreHover::Lines* FibreHover::lines(const EditorContext& context, const ShownFrame& shown,
                                     std::size_t muscle) {
    static_cast<void>(context);
    if (shown.recording == nullptr || shown.frame == nullptr)
        return nullptr;
    if (shown.recording.get() != models_of_) { // a run's fibres are there before its first frame and stay
        models_of_ = shown.recording.get();
        models_ = shown.recording->fibres();
    }
    if (muscle >= models_.size() || models_[muscle] == nullptr)
        return nullptr;
    if (muscle >= lines_.size())
        lines_.resize(models_.size());
    Lines& entry = lines_[muscle];
    const PointsPtr& surface = shown.frame->muscle_positions[muscle];
    if (entry.model != models_[muscle] || entry.surface != surface) {
        entry.model = models_[muscle];
        entry.surface = surface;
        entry.points.resize(entry.model->rest.points.size());
        entry.model->carrier.carry(*surface, entry.points);
        entry.places_for = 0;
        ++carried_;
    }
    if (entry.places_for != lens_number_) {
        entry.places.resize(entry.points.size());
        for (std::size_t i = 0; i < entry.points.size(); ++i) {
            const Vec3 seen = entry.points[i] - lens_.eye;
            const double depth = -seen.dot(lens_.backward);
            // Pixels per unit: at the pivot's distance, in perspective in inverse proportion to the depth.
            const double scale = lens_.orthographic ? 1 / lens_.units_per_pixel
                                                    : lens_.distance / (lens_.units_per_pixel * depth);
            const bool hidden = (!lens_.orthographic && depth <= 0) ||
                                (lens_.section && !lens_.section->keeps(entry.points[i]));
            const double x = lens_.width / 2 + seen.dot(lens_.right) * scale,
                         y = lens_.height / 2 - seen.dot(lens_.up) * scale;
            entry.places[i] = {hidden ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(x),
                               static_cast<float>(y)};
        }
        entry.places_for = lens_number_;
        ++projected_;
    }
    return &entry;
}

void FibreHover::point_at(EditorContext& context, const Vec2& pointer, const view::ViewSize& size) {
    pointer_ = pointer;
    const EditorState& state = context.state;
    if (!state.fibres || (state.muscle_opacity >= 1 && state.colouring != view::Colouring::fibres))
        return;
    const ShownFrame shown = context.shown();
    if (shown.recording == nullptr)
        return;
    use_lens(context, size);
    double best = std::pow(reach_px * double(context.scale()), 2);
    std::size_t nearest_muscle = 0;
    int nearest_fibre = -1;
    const std::vector<Muscle>& muscles = shown.recording->scene().muscles;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
        if (!state.visible(muscles[m].name))
            continue;
        const Lines* entry = lines(context, shown, m);
        if (entry == nullptr)
            continue;
        const std::size_t n = entry->model->rest.points_per_fibre();
        for (std::size_t i = 0; i + 1 < entry->places.size(); ++i) {
            if (i % n == n - 1)
                continue; // from the end of one fibre to the start of the next
            const double distance = squared_distance(pointer, entry->places[i], entry->places[i + 1]);
            if (distance < best) {
                best = distance;
                nearest_muscle = m;
                nearest_fibre = static_cast<int>(i / n);
            }
        }
    }
    if (nearest_fibre < 0)
        return;
    points_at_ = FibreRef{muscles[nearest_muscle].name, nearest_fibre};
    context.state.next_hover_fibre = points_at_;
}

void FibreHover::draw(EditorContext& context, ImDrawList& list, const Rect& area) {
    const std::optional<Vec2> pointer = std::exchange(pointer_, std::nullopt);
    // What is shown as hovered was pointed at in the frame before.
    const std::optional<FibreRef> pointed = std::exchange(pointed_, std::exchange(points_at_, std::nullopt));
    const std::optional<FibreRef>& hovered = context.state.hover_fibre;
    if (!hovered || !context.state.visible(hovered->muscle))
        return;
    const ShownFrame shown = context.shown();
    const int muscle = context.shown_scene().muscle_index(hovered->muscle);
    if (muscle < 0)
        return;
    use_lens(context, {double(area.width()), double(area.height())});
    const Lines* entry = lines(context, shown, static_cast<std::size_t>(muscle));
    if (entry == nullptr || hovered->fibre < 0 || hovered->fibre >= entry->model->rest.count)
        return;
    const std::size_t n = entry->model->rest.points_per_fibre(),
                      first = static_cast<std::size_t>(hovered->fibre) * n;
    list.PushClipRect(area.min, area.max, true);
    const auto stroke = [&] {
        if (strip_.size() > 1)
            for (const auto& [colour, width] : {std::pair{rim, 6.0f}, {bright, 3.2f}})
                list.AddPolyline(strip_.data(), static_cast<int>(strip_.size()), colour, 0,
                                 width * context.scale());
        strip_.clear();
    };
    Rect box{area.max, area.min};
    for (std::size_t i = first; i < first + n; ++i) {
        if (std::isnan(entry->places[i].x)) {
            stroke();
            continue;
        }
        const ImVec2 at{area.min.x + entry->places[i].x, area.min.y + entry->places[i].y};
        strip_.push_back(at);
        box = {{std::min(box.min.x, at.x), std::min(box.min.y, at.y)},
               {std::max(box.max.x, at.x), std::max(box.max.y, at.y)}};
    }
    stroke();
    record_item("viewport/fibre", box);
    if (pointer && pointed == hovered) {
        const double length = length_of({entry->points.data() + first, n}),
                     rest = length_of(entry->model->rest.fibre(hovered->fibre)),
                     mm = millimetres_per_unit(context.shown_scene().unit);
        char text[160];
        std::snprintf(text, sizeof text, "%s, fibre %d: %.1f mm, stretch %.3f", hovered->muscle.c_str(),
                      hovered->fibre + 1, length * mm, rest > 0 ? length / rest : 1.0);
        const ImVec2 at{area.min.x + static_cast<float>(pointer->x()) + context.px(14),
                        area.min.y + static_cast<float>(pointer->y()) + context.px(14)};
        const float width = text_size(text).x + context.px(20);
        const bool left = at.x + width > area.max.x;
        record_item("viewport/fibre/label", draw_badge(list, {left ? at.x - context.px(28) : at.x, at.y},
                                                       left ? Align::right : Align::left, text,
                                                       context.theme.text, context.theme.badge));
    }
    list.PopClipRect();
}

void FibreHover::document_replaced(EditorContext&) {
    models_of_ = nullptr;
    models_.clear();
    lines_.clear();
    pointer_.reset();
}

} // namespace fascicle::editor
