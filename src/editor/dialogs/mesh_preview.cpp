#include "editor/dialogs/mesh_preview.hpp"

#include "editor/pointer_input.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "render/imgui_renderer.hpp"

namespace fascicle::editor {

namespace {

constexpr float faint = 0.3f; ///< alpha of what is in the scene already
constexpr render::Rgba border_colour{1.0f, 0.78f, 0.10f, 1.0f}, crowded_colour{1.0f, 0.25f, 0.85f, 1.0f},
    crossing_colour{0.25f, 0.85f, 1.0f, 1.0f};

std::shared_ptr<const std::vector<render::Vec3f>> placed_segments(const MeshEntry& entry,
                                                                  const Points& ends) {
    const Mat3 m = entry.scale * axis_matrix(entry.axes);
    auto points = std::make_shared<std::vector<render::Vec3f>>();
    points->reserve(ends.size());
    for (const Vec3& p : ends) {
        const Vec3 q = m * p;
        points->push_back({static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z())});
    }
    return points;
}

void add_defects(render::DrawList& list, const MeshEntry& entry) {
    const std::pair<const Points*, render::Rgba> kinds[] = {{&entry.surface().border, border_colour},
                                                            {&entry.surface().crowded, crowded_colour},
                                                            {&entry.surface().crossing, crossing_colour}};
    for (const auto& [ends, colour] : kinds) {
        if (ends->empty())
            continue;
        render::LineItem line;
        line.points = placed_segments(entry, *ends);
        line.colour = colour;
        line.width_px = 3;
        list.lines.push_back(line);
        line.colour[3] = 0.45f; // behind surfaces it shows through
        line.on_top = true;
        list.lines.push_back(std::move(line));
    }
}

} // namespace

void MeshPreview::release() {
    gpu_.reset();
    cache_ = {};
    scene_ = scene_for_ = nullptr;
    key_.reset();
    frame_pending_ = true;
}

void MeshPreview::rebuild(const EditorContext& context, const MeshBatch& batch) {
    if (scene_ != nullptr && scene_for_ == context.document.head() && revision_ == batch.revision())
        return;
    scene_for_ = context.document.head();
    revision_ = batch.revision();
    auto scene = std::make_shared<Scene>(*scene_for_);
    scene->timeline = {};
    scene->line_muscles = nullptr;
    const auto hide = [&](auto& list, const std::string& name) {
        for (auto& object : list) // an empty mesh in its place: numbers of items stay
            if (!name.empty() && object.name == name)
                object.mesh = std::make_shared<const TriMesh>();
    };
    for (const MeshEntry& entry : batch.entries()) {
        if (entry.placed == nullptr)
            continue;
        hide(scene->bones, entry.stands_for);
        hide(scene->muscles, entry.stands_for);
        if (entry.role == actions::MeshRole::bone) {
            scene->bones.push_back({entry.name, entry.placed, {}});
        } else {
            scene->muscles.emplace_back();
            scene->muscles.back().mesh = entry.placed;
        }
    }
    scene_ = std::move(scene);
    bounds_ = view::visible_bounds(view::subject_of(scene_));
}

render::DrawList MeshPreview::build(const EditorContext& context, const MeshBatch& batch, int selected,
                                    double aspect) {
    view::ViewOptions options;
    options.attachments = false;
    const Scene& head = *scene_for_;
    int bone = static_cast<int>(head.bones.size()), muscle = static_cast<int>(head.muscles.size());
    for (int i = 0; i < static_cast<int>(batch.entries().size()); ++i) {
        const MeshEntry& entry = batch.entries()[static_cast<std::size_t>(i)];
        if (entry.placed == nullptr)
            continue;
        const bool is_bone = entry.role == actions::MeshRole::bone;
        if (i == selected)
            (is_bone ? options.selected_bone : options.selected_muscle) = is_bone ? bone : muscle;
        ++(is_bone ? bone : muscle);
    }
    const view::ViewSubject subject = view::subject_of(scene_);
    render::DrawList list = view::build_draw_list(subject, options, camera_.pose(aspect), cache_);
    const auto in_scene = [&](std::uint64_t id) {
        for (std::size_t i = 0; i < head.bones.size(); ++i)
            if (id == view::bone_item_id(i))
                return true;
        for (std::size_t i = 0; i < head.muscles.size(); ++i)
            if (id == view::muscle_item_id(i))
                return true;
        return false;
    };
    for (render::SurfaceItem& item : list.surfaces)
        if (in_scene(item.id))
            item.colour[3] = faint;
    for (const MeshEntry& entry : batch.entries())
        if (entry.placed != nullptr)
            add_defects(list, entry);
    list.background_top = context.theme.view_top;
    list.background_bottom = context.theme.view_bottom;
    return list;
}

unsigned MeshPreview::texture(const EditorContext& context, const MeshBatch& batch, int selected, int width,
                              int height) {
    rebuild(context, batch);
    const double aspect = double(width) / double(height);
    if (frame_pending_) {
        camera_ = view::picture_camera(view::subject_of(scene_), aspect, {}, std::nullopt,
                                       context.state.camera.axes());
        frame_pending_ = false;
    }
    camera_.set_scene_bounds(bounds_);
    const int samples = pointer_.dragging() ? 1 : 2; // quick while it turns
    const Key key{batch.revision(), scene_for_, selected,           width,
                  height,           samples,    context.theme.dark, camera_.pose(aspect)};
    const bool same = key_ && key_->revision == key.revision && key_->head == key.head &&
                      key_->selected == key.selected && key_->width == key.width &&
                      key_->height == key.height && key_->dark == key.dark && key_->samples == key.samples &&
                      key_->camera.view == key.camera.view &&
                      key_->camera.projection == key.camera.projection;
    if (gpu_ == nullptr)
        gpu_ = std::make_unique<Gpu>();
    if (same)
        return gpu_->target->texture();
    if (gpu_->target == nullptr || gpu_->target->width() != width || gpu_->target->height() != height ||
        gpu_->target->supersampling() != samples)
        gpu_->target = std::make_unique<render::OffscreenTarget>(width, height, samples);
    gpu_->renderer.draw(build(context, batch, selected, aspect), *gpu_->target,
                        context.scale() * static_cast<float>(samples));
    key_ = key;
    ++drawn_;
    return gpu_->target->texture();
}

void MeshPreview::handle_pointer(const EditorContext& context, const Rect& area) {
    const PointerInput input = pointer_input(context, area, ImGui::IsItemHovered());
    const view::ViewSize size{double(area.width()), double(area.height())};
    pointer_.update(input, size, double(context.scale()), camera_);
    if (input.inside && ImGui::IsMouseDoubleClicked(0) && scene_ != nullptr)
        camera_.frame(view::visible_points(view::subject_of(scene_)), size.aspect());
}

void MeshPreview::draw(EditorContext& context, const MeshBatch& batch, int selected, const Rect& area) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const int width = static_cast<int>(area.width()), height = static_cast<int>(area.height());
    if (width < 8 || height < 8)
        return;
    ImGui::SetCursorScreenPos(area.min);
    ImGui::InvisibleButton("preview", {area.width(), area.height()},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    record_item("mesh/preview");
    handle_pointer(context, area);
    list.AddRectFilled(area.min, area.max, context.theme.plot, context.px(4));
    const bool something = batch.ready_count() > 0;
    if (!something || context.view == nullptr) {
        const std::string text = something         ? "No preview: there is no OpenGL"
                                 : batch.reading() ? "Reading..."
                                                   : "The chosen meshes appear here, beside the scene.";
        draw_text_in(list,
                     {{area.min.x + context.px(8), area.min.y}, {area.max.x - context.px(8), area.max.y}},
                     context.theme.text_faint, text, Align::centre);
        return;
    }
    const unsigned picture = texture(context, batch, selected, width, height);
    list.AddImageRounded(render::texture_id(picture), area.min, area.max, {0, 1}, {1, 0}, 0xffffffff,
                         context.px(4));
    bool border = false, crowded = false, crossing = false;
    for (const MeshEntry& entry : batch.entries())
        if (entry.read != nullptr) {
            border |= !entry.surface().border.empty();
            crowded |= !entry.surface().crowded.empty();
            crossing |= !entry.surface().crossing.empty();
        }
    float y = area.max.y - context.px(26);
    const auto legend = [&](bool there, const render::Rgba& colour, const char* text) {
        if (!there)
            return;
        const Rect plate = draw_badge(list, {area.min.x + context.px(24), y}, Align::left, text,
                                      context.theme.text, context.theme.badge);
        list.AddLine({area.min.x + context.px(8), (plate.min.y + plate.max.y) / 2},
                     {area.min.x + context.px(20), (plate.min.y + plate.max.y) / 2},
                     ImGui::ColorConvertFloat4ToU32({colour[0], colour[1], colour[2], 1}), context.px(3));
        y -= context.px(26);
    };
    legend(crossing, crossing_colour, "Crossing triangles");
    legend(crowded, crowded_colour, "More than two triangles");
    legend(border, border_colour, "Open border");
}

} // namespace fascicle::editor
