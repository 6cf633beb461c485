#pragma once
// How many files an export makes and about how large they are: what the rows of export_kinds() call.

#include "output/export_kinds.hpp"

namespace fascicle::output {

std::string estimate_picture(const ExportPlan& plan);
std::string estimate_frames(const ExportPlan& plan);
std::string estimate_gif(const ExportPlan& plan);
std::string estimate_video(const ExportPlan& plan);
std::string estimate_meshes(const ExportPlan& plan);
std::string estimate_mesh(const ExportPlan& plan);
std::string estimate_fibres(const ExportPlan& plan);
std::string estimate_glb(const ExportPlan& plan);
std::string estimate_usda(const ExportPlan& plan);
std::string estimate_obj(const ExportPlan& plan);
std::string estimate_cache(const ExportPlan& plan);
std::string estimate_osim(const ExportPlan& plan);
std::string estimate_json(const ExportPlan& plan);
std::string estimate_metrics(const ExportPlan& plan);
std::string estimate_run(const ExportPlan& plan);
std::string estimate_report(const ExportPlan& plan);

/// "2.4 MB".
std::string bytes_text(double bytes);
/// "1 file", "3 files".
std::string count_text(int count, const char* one, const char* many);

} // namespace fascicle::output
