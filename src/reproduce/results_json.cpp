#include "reproduce/results_json.hpp"

#include "fascicle/base/build_info.hpp"
#include "reproduce/published.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace fascicle::reproduce {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double v : values)
        list.push_back(number(v));
    return list;
}

Json span_json(const Span3& span) {
    return {{"least", number(span.least)}, {"mean", number(span.mean)}, {"greatest", number(span.greatest)}};
}

/// Of every metric: over all frames, at the end of the way out, and at the last frame.
Json metrics_json(const RunData& run) {
    Json json = Json::object();
    for (const auto& [key, values] : run.metrics) {
        const Span3 span = span_of(values);
        if (!std::isfinite(span.mean) || values.empty())
            continue;
        Json row = span_json(span);
        row["flexed"] = number(values[run.flexed()]);
        row["end"] = number(values.back());
        json[key] = std::move(row);
    }
    return json;
}

Json run_json(const MethodRun& row) {
    Json json{{"method", row.method}};
    if (!row.done()) {
        json["failed"] = row.failure;
        return json;
    }
    const RunData& run = row.run;
    json["frames"] = run.last_frame;
    json["vertices"] = run.vertices;
    json["triangles"] = run.triangles;
    json["fibres"] = run.fibres.count();
    json["state_hash"] = run.state_hash;
    json["metrics"] = metrics_json(run);
    if (row.to_reference)
        json["distance_to_reference_mm"] = {{"mean", number(row.to_reference->mean)},
                                            {"max", number(row.to_reference->max)}};
    json["notes"] = run.notes;
    return json;
}

Json experiment_json(const ExperimentResult& result) {
    const Experiment& e = *result.experiment;
    Json json{{"key", e.key}, {"title", e.title}, {"figures", e.figures}};
    if (!result.missing.empty()) {
        json["left_out"] = result.missing;
        return json;
    }
    json["data"] = result.real ? "public data" : "embedded scene " + e.stand_in;
    json["notes"] = result.notes;
    json["motion"] = to_text(e.motion);
    json["reference"] = result.reference.empty() ? Json(nullptr) : Json(result.reference);
    json["runs"] = Json::array();
    for (const MethodRun& row : result.runs)
        json["runs"].push_back(run_json(row));
    json["moment_arms"] = Json::array();
    for (const ArmShare& share : result.arms) {
        Json table = Json::array();
        for (const TableShare& row : share.table)
            table.push_back({{"model", row.model},
                             {"arm_mm", span_json(row.arm_mm)},
                             {"poses_inside_percent", number(row.poses_percent)},
                             {"fibres_inside_percent", number(row.arms_percent)}});
        json["moment_arms"].push_back({{"who", share.who},
                                       {"poses_inside_percent", number(share.inside_percent)},
                                       {"fibres_inside_percent", number(share.fibres_inside_percent)},
                                       {"arm_mm", span_json(share.arm_mm)},
                                       {"poses_and_fibres_mm", span_json(share.all_mm)},
                                       {"published_ranges", table}});
    }
    json["published_program"] = Json::array();
    for (const PublishedFrame& mark : published_marks(e.published))
        json["published_program"].push_back({{"frame", mark.frame},
                                             {"volume_ratio", mark.volume_ratio},
                                             {"edge_extension_mean", mark.edge_mean},
                                             {"edge_extension_p99", mark.edge_p99},
                                             {"dihedral_change_unsigned_mean_deg", mark.dihedral_deg},
                                             {"displacement_mean_mm", number(mark.displacement_mm)}});
    json["findings"] = Json::array();
    for (const Finding& finding : result.findings)
        json["findings"].push_back({{"figure", finding.figure},
                                    {"about", finding.about},
                                    {"verdict", to_text(finding.verdict)},
                                    {"text", finding.text}});
    return json;
}

Json sensitivity_json(const SensitivityResult& s) {
    if (!s.missing.empty())
        return {{"left_out", s.missing}};
    Json json{{"experiment", s.experiment},
              {"data", s.real ? "public data" : "embedded scene"},
              {"method", s.method},
              {"quantities", s.quantities},
              {"parameters_lowered_by_a_fifth", s.parameters}};
    json["variants"] = Json::array();
    for (const SensitivityVariant& v : s.variants) {
        Json row{{"variant", v.key},
                 {"held_against", s.variants[v.base].key},
                 {"triangles", v.triangles},
                 {"passes", v.passes},
                 {"values", numbers(v.values)}};
        row["effects"] = Json::array();
        for (const std::vector<double>& effect : v.effects)
            row["effects"].push_back(numbers(effect));
        if (!v.failure.empty())
            row["failed"] = v.failure;
        json["variants"].push_back(std::move(row));
    }
    json["dependences"] = Json::array();
    for (const SensitivityResult::Dependence& d : s.dependences)
        json["dependences"].push_back({{"parameter", d.parameter},
                                       {"quantity", d.quantity},
                                       {"variant", d.variant},
                                       {"effect", number(d.effect)},
                                       {"effect_at_base", number(d.effect_at_base)}});
    return json;
}

// Names come from files of the user's and may hold anything.
std::string text_of(const Json& json) {
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

std::string results_json(const Results& results) {
    Json json{{"program", std::string("fascicle ") + program_version()},
              {"data", results.data},
              {"short", results.is_short},
              {"methods", results.methods}};
    json["experiments"] = Json::array();
    for (const ExperimentResult& result : results.experiments)
        json["experiments"].push_back(experiment_json(result));
    json["sensitivity"] = sensitivity_json(results.sensitivity);
    return text_of(json);
}

std::string timings_json(const Results& results) {
    Json json{{"seconds", results.seconds}};
    json["runs"] = Json::array();
    for (const ExperimentResult& result : results.experiments)
        for (const MethodRun& row : result.runs)
            if (row.done())
                json["runs"].push_back({{"experiment", result.experiment->key},
                                        {"method", row.method},
                                        {"frames", row.run.last_frame},
                                        {"threads", row.run.times.threads},
                                        {"prepare_seconds", row.run.times.prepare_seconds},
                                        {"solve_seconds", row.run.times.solve_seconds},
                                        {"frames_per_second", row.run.times.frames_per_second},
                                        {"reused", row.reused}});
    json["speed"] = Json::array();
    for (const SpeedRow& row : results.speed.rows)
        json["speed"].push_back({{"object", row.object},
                                 {"data", row.real ? "public data" : "embedded scene"},
                                 {"method", row.method},
                                 {"triangles", row.triangles},
                                 {"threads", row.threads},
                                 {"passes", row.passes},
                                 {"frames_per_second", row.frames_per_second}});
    json["published_speed"] = Json::array();
    for (const PublishedSpeed& row : published_speeds())
        json["published_speed"].push_back(
            {{"object", row.object},
             {"triangles", row.triangles},
             {"paper_frames_per_second", row.frames_per_second},
             {"public_program_frames_per_second", row.program_frames_per_second}});
    json["rank_correlation"] = Json::array();
    for (const SpeedResult::Correlation& c : results.speed.correlations)
        json["rank_correlation"].push_back(
            {{"method", c.method}, {"threads", c.threads}, {"objects", c.objects}, {"rho", number(c.rho)}});
    return text_of(json);
}

} // namespace fascicle::reproduce
