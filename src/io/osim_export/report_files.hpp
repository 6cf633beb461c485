#pragma once
// osim_report.csv and osim_report.json.

#include "fascicle/io/osim_export.hpp"
#include "io/osim_export/baked_model.hpp"

namespace fascicle::io {

/// "100 fibres, 2600 path points (2400 moving, 5 to 8 knots): length within 0.71 mm ..."
std::string summary_line(const OsimExportReport& report);
std::string report_table(const OsimExportReport& report);
std::string report_facts(const OsimExportReport& report, const OsimExportOptions& options, const Scene& scene,
                         const BakedModel& model);

} // namespace fascicle::io
