#pragma once
// The functions of the table in targets.cpp, by file. Each reads bytes as one kind of file and checks what came of it.

#include "fascicle/io/format_registry.hpp"

#include <string_view>

namespace fascicle::fuzz {

// targets/meshes.cpp
void fuzz_mesh_format(const MeshFormat& format, std::string_view bytes);
void fuzz_mesh_any(std::string_view bytes);
void fuzz_area_mesh(std::string_view bytes);
void fuzz_xml(std::string_view bytes);
// targets/animations.cpp
void fuzz_glb(std::string_view bytes);
void fuzz_usda(std::string_view bytes);
void fuzz_point_cache(std::string_view bytes);
void fuzz_series(std::string_view bytes);
// targets/tables.cpp
void fuzz_csv(std::string_view bytes);
void fuzz_motion_csv(std::string_view bytes);
void fuzz_attachment_csv(std::string_view bytes);
void fuzz_attachment_areas(std::string_view bytes);
// targets/opensim.cpp
void fuzz_osim(std::string_view bytes);
void fuzz_storage(std::string_view bytes);
// targets/json_files.cpp
void fuzz_fibre_template(std::string_view bytes);
void fuzz_preset(std::string_view bytes);
void fuzz_lesson(std::string_view bytes);
void fuzz_settings(std::string_view bytes);
void fuzz_recent_projects(std::string_view bytes);
// targets/projects.cpp
void fuzz_project(std::string_view bytes);
// targets/runs.cpp
void fuzz_run_folder(std::string_view bytes);
// targets/codecs.cpp
void fuzz_mesh_codec(std::string_view bytes);
void fuzz_base64(std::string_view bytes);
void fuzz_grid(std::string_view bytes);
void fuzz_cache_entry(std::string_view bytes);
void fuzz_png(std::string_view bytes);
// targets/options.cpp
void fuzz_command_line(std::string_view bytes);
void fuzz_options(std::string_view bytes);
void fuzz_parameters(std::string_view bytes);

} // namespace fascicle::fuzz
