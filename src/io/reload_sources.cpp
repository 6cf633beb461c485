#include "fascicle/io/reload_sources.hpp"

#include "fascicle/io/load_scene.hpp"
#include "fascicle/scene/line_muscles.hpp"

#include <algorithm>

namespace fascicle {

std::vector<MeshSource> scene_sources(const Scene& scene) {
    std::vector<MeshSource> all;
    const auto add = [&](const MeshSource& source) {
        const auto same = [&](const MeshSource& s) { return s.path == source.path; };
        if (!source.path.empty() && !source.hash.empty() && std::none_of(all.begin(), all.end(), same))
            all.push_back(source);
    };
    for (const Bone& bone : scene.bones)
        add(bone.source);
    for (const Muscle& muscle : scene.muscles) {
        add(muscle.source);
        for (const MeshSource& file : muscle.outline_files)
            add(file);
        add(muscle.surface_fibres_source);
        add(muscle.fibre_template_source);
    }
    if (scene.line_muscles != nullptr)
        add(scene.line_muscles->source);
    return all;
}

Scene reload_sources(const Scene& scene, const std::vector<std::string>& paths,
                     std::vector<std::string>& notes) {
    Scene out = scene;
    const auto wanted = [&](const MeshSource& source) {
        return !source.path.empty() && !source.hash.empty() &&
               std::find(paths.begin(), paths.end(), source.path) != paths.end();
    };
    for (std::size_t b = 0; b < out.bones.size(); ++b) {
        Bone& bone = out.bones[b];
        if (!wanted(bone.source))
            continue;
        Bone fresh = load_bone(bone.source.path, notes);
        if (fresh.mesh->vertex_count() != bone.mesh->vertex_count())
            for (Muscle& muscle : out.muscles)
                if (std::erase_if(muscle.areas, [&](const AttachmentArea& area) {
                        return area.bone == static_cast<int>(b);
                    }) > 0)
                    notes.push_back(muscle.name + ": its areas on " + bone.name +
                                    " are left out: they were made for another mesh");
        bone.mesh = fresh.mesh;
        bone.source = fresh.source;
    }
    for (Muscle& muscle : out.muscles) {
        if (wanted(muscle.source)) {
            const Muscle fresh = load_muscle(muscle.source.path, notes);
            if (fresh.mesh->vertex_count() != muscle.mesh->vertex_count() && !muscle.attachments.empty()) {
                muscle.attachments.clear();
                notes.push_back(muscle.name +
                                ": its attached vertices are left out: they were another mesh's");
            }
            muscle.mesh = fresh.mesh;
            muscle.source = fresh.source;
        }
        if (std::any_of(muscle.outline_files.begin(), muscle.outline_files.end(), wanted)) {
            const std::vector<MeshSource> files = std::move(muscle.outline_files);
            muscle.outlines.clear();
            muscle.outline_files.clear();
            for (const MeshSource& file : files) {
                Muscle one;
                load_attachments(one, file.path, scene.unit);
                muscle.outlines.insert(muscle.outlines.end(), one.outlines.begin(), one.outlines.end());
                muscle.outline_files.push_back(one.outline_files[0]);
            }
        }
        if (wanted(muscle.surface_fibres_source))
            load_surface_fibres(muscle, std::string(muscle.surface_fibres_source.path), notes);
        if (wanted(muscle.fibre_template_source))
            load_fibre_template(muscle, std::string(muscle.fibre_template_source.path));
    }
    if (out.line_muscles != nullptr && wanted(out.line_muscles->source))
        load_line_muscles(out, std::string(out.line_muscles->source.path), notes);
    return out;
}

} // namespace fascicle
