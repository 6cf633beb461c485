#include "output/export_estimates.hpp"

#include <algorithm>
#include <cstdio>

// Bytes a pixel, a vertex with its triangles, a row: measured on the hip scene.

namespace fascicle::output {

namespace {

double vertices_of(const Scene& scene, bool bones) {
    double count = 0;
    for (const Muscle& muscle : scene.muscles)
        count += muscle.mesh->vertex_count();
    for (const Bone& bone : scene.bones)
        count += bones ? bone.mesh->vertex_count() : 0;
    return count;
}

double frame_count(const ExportPlan& plan) {
    return plan.recording == nullptr ? 1 : plan.recording->frame_count();
}

std::string pictures_text(const ExportPlan& plan, double bytes_a_pixel) {
    return count_text(plan.frames, "picture", "pictures") + ", about " +
           bytes_text(plan.pixels * bytes_a_pixel);
}

} // namespace

std::string bytes_text(double bytes) {
    char text[40];
    if (bytes < 1e6)
        std::snprintf(text, sizeof text, "%.0f kB", std::max(1.0, bytes / 1e3));
    else if (bytes < 1e9)
        std::snprintf(text, sizeof text, bytes < 1e7 ? "%.1f MB" : "%.0f MB", bytes / 1e6);
    else
        std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
    return text;
}

std::string count_text(int count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string estimate_picture(const ExportPlan& plan) {
    return pictures_text(plan, 0.25);
}

std::string estimate_frames(const ExportPlan& plan) {
    return pictures_text(plan, 0.25);
}

std::string estimate_gif(const ExportPlan& plan) {
    return pictures_text(plan, 0.05);
}

std::string estimate_video(const ExportPlan& plan) {
    return pictures_text(plan, 0.02);
}

std::string estimate_meshes(const ExportPlan& plan) {
    const auto bodies = static_cast<int>(plan.scene.muscles.size() + plan.scene.bones.size());
    return count_text(plan.frames * bodies, "file", "files") + ", about " +
           bytes_text(vertices_of(plan.scene, true) * plan.frames * 100);
}

std::string estimate_mesh(const ExportPlan& plan) {
    return "1 file, about " + bytes_text(vertices_of(plan.scene, true) * 95);
}

std::string estimate_fibres(const ExportPlan& plan) {
    double points = 0;
    int muscles = 0;
    for (const FibreModelPtr& model :
         plan.recording == nullptr ? std::vector<FibreModelPtr>{} : plan.recording->fibres())
        if (model != nullptr) {
            points += static_cast<double>(model->rest.points.size());
            ++muscles;
        }
    return count_text(plan.frames * muscles + 1, "file", "files") + ", about " +
           bytes_text(points * plan.frames * 170);
}

std::string estimate_metrics(const ExportPlan& plan) {
    const double rows = frame_count(plan) * double(plan.scene.muscles.size());
    return "1 table of " + count_text(static_cast<int>(rows), "row", "rows") + ", about " +
           bytes_text(rows * 1050);
}

std::string estimate_run(const ExportPlan& plan) {
    return "a folder, about " + bytes_text(vertices_of(plan.scene, false) * frame_count(plan) * 140 +
                                           vertices_of(plan.scene, true) * 90);
}

std::string estimate_report(const ExportPlan&) {
    return "1 page with 4 pictures, about " + bytes_text(1.2e6);
}

} // namespace fascicle::output
