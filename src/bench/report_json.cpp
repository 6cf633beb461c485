#include "bench/bench.hpp"

#include <nlohmann/json.hpp>

namespace fascicle::bench {

namespace {

using Json = nlohmann::ordered_json;

Json spread_json(const Spread& spread) {
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"runs", spread.runs}};
}

template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json machine_json(const Machine& m) {
    return {{"cpu", m.cpu},
            {"threads", m.cores},
            {"instructions", m.instructions},
            {"l1_bytes", m.l1_bytes},
            {"l2_bytes", m.l2_bytes},
            {"l3_bytes", m.l3_bytes},
            {"load_before", m.load >= 0 ? Json(m.load) : Json(nullptr)}};
}

Json case_json(const CaseInfo& info) {
    return {{"name", info.name},
            {"muscles", info.muscles},
            {"vertices", info.vertices},
            {"triangles", info.triangles},
            {"frames", info.frames}};
}

Json frame_json(const FrameRow& row) {
    return {{"case", row.case_name},
            {"method", row.method},
            {"threads", row.threads},
            {"passes", row.passes},
            {"frames_per_second", spread_json(row.rate)},
            {"runs", row.run_rates},
            {"times_published", or_null(row.times_published)},
            {"times_classic", or_null(row.times_classic)},
            {"pass_us", row.pass_us},
            {"stage_us", row.stage_us},
            {"bytes_per_triangle", or_null(row.bytes_per_triangle)},
            {"state_hash", row.state_hash},
            {"processor_share", row.processor_share},
            {"undecided", row.undecided()}};
}

Json scaling_json(const ScalingRow& row) {
    return {{"method", row.method},
            {"level", row.level},
            {"triangles", row.triangles},
            {"threads", row.threads},
            {"ns_per_triangle_substep", spread_json(row.ns)},
            {"growth", or_null(row.growth)},
            {"speedup", or_null(row.speedup)},
            {"bytes_per_triangle", or_null(row.bytes_per_triangle)},
            {"undecided", row.ns.undecided()}};
}

Json prepare_json(const PrepareRow& row) {
    return {{"case", row.case_name},
            {"threads", row.threads},
            {"cache", row.cache},
            {"seconds", spread_json(row.seconds)},
            {"stage_seconds", row.stage_seconds},
            {"undecided", row.seconds.undecided()}};
}

Json limit_json(const LimitRow& row) {
    return {{"name", row.name},
            {"unit", row.unit},
            {"threads", row.threads},
            {"value", spread_json(row.value)},
            {"undecided", row.value.undecided()}};
}

template <typename Row>
Json list(const std::vector<Row>& rows, Json (*to_json)(const Row&)) {
    Json json = Json::array();
    for (const Row& row : rows)
        json.push_back(to_json(row));
    return json;
}

} // namespace

std::string report_json(const Report& report) {
    const Machine& m = report.machine;
    const Json json{{"program", "fascicle " + m.version},
                    {"machine", machine_json(m)},
                    {"compiler", m.compiler},
                    {"flags", m.flags},
                    {"build", m.build},
                    {"runs", report.runs},
                    {"published_frames_per_second", published_frames_per_second},
                    {"cases", list(report.cases, case_json)},
                    {"frames", list(report.frames, frame_json)},
                    {"main_case", report.main_case},
                    {"scaling", list(report.scaling, scaling_json)},
                    {"prepare", list(report.prepare, prepare_json)},
                    {"fibres", list(report.fibres, limit_json)},
                    {"paint", list(report.paint, limit_json)},
                    {"limits", list(report.limits, limit_json)},
                    {"skipped", list(
                                    report.skipped,
                                    +[](const Skip& s) {
                                        return Json{{"what", s.what}, {"reason", s.reason}};
                                    })},
                    {"warnings", report.warnings}};
    // Names come from files of the system and may hold anything.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace fascicle::bench
