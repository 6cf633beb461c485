#pragma once
// How each kind of data is written: what the rows of export_kinds() call.

#include "output/export_kinds.hpp"

namespace fascicle::output {

/// VTP of every body and frame, bones where they are, and a .pvd each.
void write_meshes(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// One OBJ of request.frame.
void write_mesh(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// Polylines of every frame, a .pvd for each muscle, fibres.csv.
void write_fibres(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// An OpenSim model, and beside it a motion, meshes of the bones and a report (io/osim_export.hpp).
void write_osim(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// Whether there is an encoder.
std::string reason_against_video();
std::string reason_against_fibres(const Recording& recording);
/// The table alone, and beside it what was run.
void write_metrics(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// The tables and what was run as one JSON document.
void write_metrics_json(const ExportRequest& request, const Recording& recording, const JobControl& control);
/// What `simulate --export vtp` leaves.
void write_run_folder(const ExportRequest& request, const Recording& recording, const JobControl& control);

} // namespace fascicle::output
