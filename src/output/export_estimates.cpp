#include "output/export_estimates.hpp"

#include "fascicle/io/animation.hpp"

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

/// Points of all fibres, and the number of muscles that have some.
std::pair<double, int> fibre_sets(const ExportPlan& plan) {
    std::pair<double, int> sum{0, 0};
    if (plan.recording != nullptr)
        for (const FibreModelPtr& model : plan.recording->fibres())
            if (model != nullptr) {
                sum.first += static_cast<double>(model->rest.points.size());
                ++sum.second;
            }
    return sum;
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
    return count_text(plan.frames * fibre_sets(plan).second + 1, "file", "files") + ", about " +
           bytes_text(fibre_sets(plan).first * plan.frames * 170);
}

std::string estimate_glb(const ExportPlan& plan) {
    const double shapes = static_cast<double>(
        spread_frames(static_cast<std::size_t>(plan.frames), plan.request.morph_targets).size());
    const double bytes = vertices_of(plan.scene, false) * (12 + 24 * shapes) +
                         fibre_sets(plan).first * (8 + 12 * shapes) +
                         (vertices_of(plan.scene, true) - vertices_of(plan.scene, false)) * 36;
    return "1 file with " + count_text(static_cast<int>(shapes), "shape", "shapes") + ", about " +
           bytes_text(bytes);
}

std::string estimate_usda(const ExportPlan& plan) {
    const double bytes = vertices_of(plan.scene, false) * plan.frames * 62 +
                         fibre_sets(plan).first * plan.frames * 34 + vertices_of(plan.scene, true) * 100;
    return "1 file, about " + bytes_text(bytes);
}

std::string estimate_obj(const ExportPlan& plan) {
    return count_text(plan.frames, "file", "files") + ", about " +
           bytes_text((vertices_of(plan.scene, true) * 95 + fibre_sets(plan).first * 65) * plan.frames);
}

std::string estimate_cache(const ExportPlan& plan) {
    const auto bodies =
        static_cast<int>(plan.scene.muscles.size() + plan.scene.bones.size()) + fibre_sets(plan).second;
    const double points = vertices_of(plan.scene, true) + fibre_sets(plan).first;
    return count_text(bodies, "OBJ", "OBJs") + " and a cache for each that moves, up to " +
           bytes_text(points * (90 + 12 * plan.frames));
}

/// A moving point takes about 1,800 bytes.
std::string estimate_osim(const ExportPlan& plan) {
    const auto files = static_cast<int>(plan.scene.bones.size()) + 4;
    const double bones = vertices_of(plan.scene, true) - vertices_of(plan.scene, false);
    return count_text(files, "file", "files") + ", about " +
           bytes_text(fibre_sets(plan).first * 1800 + bones * 160);
}

std::string estimate_metrics(const ExportPlan& plan) {
    const double rows = frame_count(plan) * double(plan.scene.muscles.size());
    return "1 table of " + count_text(static_cast<int>(rows), "row", "rows") + ", about " +
           bytes_text(rows * 1050);
}

std::string estimate_json(const ExportPlan& plan) {
    const double rows = frame_count(plan) * double(plan.scene.muscles.size());
    const double fibre_rows = fibre_sets(plan).first / 20 * frame_count(plan);
    return "1 document of " + count_text(static_cast<int>(rows), "row", "rows") + " of muscles, about " +
           bytes_text(rows * 2400 + fibre_rows * 280);
}

std::string estimate_run(const ExportPlan& plan) {
    return "a folder, about " + bytes_text(vertices_of(plan.scene, false) * frame_count(plan) * 140 +
                                           vertices_of(plan.scene, true) * 90);
}

std::string estimate_report(const ExportPlan&) {
    return "1 page with 4 pictures, about " + bytes_text(1.2e6);
}

} // namespace fascicle::output
