// The tables beside the report.

#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "reproduce/published.hpp"
#include "reproduce/results_json.hpp"

#include <functional>
#include <set>

namespace fascicle::reproduce {

namespace {

namespace fs = std::filesystem;

/// A table that is written when it has rows.
class Table {
public:
    Table(fs::path path, const std::vector<std::string>& columns)
        : path_(std::move(path)), columns_(columns) {}
    ~Table() = default;
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    CsvWriter& row() {
        if (!file_) {
            file_ = std::make_unique<AtomicFile>(path_);
            csv_ = std::make_unique<CsvWriter>(file_->stream());
            for (const std::string& name : columns_)
                csv_->text(name);
            csv_->end_row();
        }
        return *csv_;
    }
    void commit() {
        if (file_)
            file_->commit();
    }

private:
    fs::path path_;
    std::vector<std::string> columns_;
    std::unique_ptr<AtomicFile> file_;
    std::unique_ptr<CsvWriter> csv_;
};

using Each = std::function<void(const ExperimentResult&, const MethodRun&)>;

void for_each_run(const Results& results, const Each& each) {
    for (const ExperimentResult& result : results.experiments)
        for (const MethodRun& row : result.runs)
            if (row.done())
                each(result, row);
}

void write_curves(const Results& results, const fs::path& folder) {
    std::set<std::string> keys;
    for_each_run(results, [&](const ExperimentResult&, const MethodRun& row) {
        for (const auto& [key, values] : row.run.metrics)
            keys.insert(key);
    });
    std::vector<std::string> columns{"experiment", "method", "frame", "angle_deg"};
    columns.insert(columns.end(), keys.begin(), keys.end());
    Table table(folder / "curves.csv", columns);
    for_each_run(results, [&](const ExperimentResult& result, const MethodRun& row) {
        std::vector<std::vector<double>> values;
        for (const std::string& key : keys)
            values.push_back(row.run.metric(key));
        for (std::size_t k = 0; k < row.run.frame.size(); ++k) {
            CsvWriter& csv = table.row();
            csv.text(result.experiment->key)
                .text(row.method)
                .number(row.run.frame[k])
                .number(row.run.angle_deg[k]);
            for (const std::vector<double>& of_key : values)
                csv.number(of_key[k]);
            csv.end_row();
        }
    });
    table.commit();
}

/// A column per fibre.
void write_fibre_lengths(const Results& results, const fs::path& folder) {
    for_each_run(results, [&](const ExperimentResult& result, const MethodRun& row) {
        const LineNumbers& fibres = row.run.fibres;
        std::vector<std::string> columns{"frame", "angle_deg"};
        for (const std::string& name : fibres.names)
            columns.push_back("fibre_" + name + "_mm");
        Table table(folder / ("fibre_lengths-" + result.experiment->key + "-" + row.method + ".csv"),
                    columns);
        for (std::size_t k = 0; fibres.count() > 0 && k < row.run.frame.size(); ++k) {
            CsvWriter& csv = table.row();
            csv.number(row.run.frame[k]).number(row.run.angle_deg[k]);
            for (std::size_t f = 0; f < fibres.count(); ++f)
                csv.number(fibres.length(k, f));
            csv.end_row();
        }
        table.commit();
    });
}

/// A row per method or line; and one per published range beside it.
void write_arms(const Results& results, const fs::path& folder) {
    Table table(folder / "moment_arms.csv",
                {"experiment", "motion", "who", "poses_inside_percent", "fibres_inside_percent",
                 "mean_arm_least_mm", "mean_arm_mean_mm", "mean_arm_greatest_mm", "arm_least_mm",
                 "arm_mean_mm", "arm_greatest_mm"});
    Table ranges(folder / "moment_arm_ranges.csv",
                 {"experiment", "motion", "who", "published_model", "published_least_mm", "published_mean_mm",
                  "published_greatest_mm", "poses_inside_percent", "fibres_inside_percent"});
    for (const ExperimentResult& result : results.experiments)
        for (const ArmShare& share : result.arms) {
            table.row()
                .text(result.experiment->key)
                .text(to_text(result.experiment->motion))
                .text(share.who)
                .number(share.inside_percent)
                .number(share.fibres_inside_percent)
                .number(share.arm_mm.least)
                .number(share.arm_mm.mean)
                .number(share.arm_mm.greatest)
                .number(share.all_mm.least)
                .number(share.all_mm.mean)
                .number(share.all_mm.greatest)
                .end_row();
            for (const TableShare& row : share.table)
                ranges.row()
                    .text(result.experiment->key)
                    .text(to_text(result.experiment->motion))
                    .text(share.who)
                    .text(row.model)
                    .number(row.arm_mm.least)
                    .number(row.arm_mm.mean)
                    .number(row.arm_mm.greatest)
                    .number(row.poses_percent)
                    .number(row.arms_percent)
                    .end_row();
        }
    table.commit();
    ranges.commit();
}

void write_distances(const Results& results, const fs::path& folder) {
    Table table(folder / "surface_distances.csv", {"experiment", "method", "reference", "mean_mm", "max_mm"});
    for_each_run(results, [&](const ExperimentResult& result, const MethodRun& row) {
        if (row.to_reference)
            table.row()
                .text(result.experiment->key)
                .text(row.method)
                .text(result.reference)
                .number(row.to_reference->mean)
                .number(row.to_reference->max)
                .end_row();
    });
    table.commit();
}

void write_published(const Results& results, const fs::path& folder) {
    Table table(folder / "published_program.csv",
                {"experiment", "method", "frame", "volume_ratio", "volume_ratio_published",
                 "edge_extension_mean", "edge_extension_mean_published", "edge_extension_p99",
                 "edge_extension_p99_published", "dihedral_change_unsigned_mean_deg",
                 "dihedral_change_published_deg", "displacement_mean_mm", "displacement_published_mm"});
    for_each_run(results, [&](const ExperimentResult& result, const MethodRun& row) {
        if (!result.real && result.experiment->key != "squish-box")
            return;
        for (const PublishedFrame& mark : published_marks(result.experiment->published)) {
            const std::size_t k = row.run.index_at(mark.frame);
            table.row()
                .text(result.experiment->key)
                .text(row.method)
                .number(mark.frame)
                .number(row.run.metric("volume_ratio")[k])
                .number(mark.volume_ratio)
                .number(row.run.metric("edge_extension_mean")[k])
                .number(mark.edge_mean)
                .number(row.run.metric("edge_extension_p99")[k])
                .number(mark.edge_p99)
                .number(row.run.metric("dihedral_change_unsigned_mean_deg")[k])
                .number(mark.dihedral_deg)
                .number(row.run.metric("displacement_mean_mm")[k])
                .number(mark.displacement_mm)
                .end_row();
        }
    });
    table.commit();
}

void write_sensitivity(const SensitivityResult& s, const fs::path& folder) {
    std::vector<std::string> columns{"variant", "triangles", "passes", "lowered_parameter"};
    columns.insert(columns.end(), s.quantities.begin(), s.quantities.end());
    Table table(folder / "sensitivity.csv", columns);
    for (const SensitivityVariant& v : s.variants) {
        const auto add = [&](const std::string& parameter, const std::vector<double>& values) {
            CsvWriter& csv = table.row();
            csv.text(v.key).integer(static_cast<long long>(v.triangles)).integer(v.passes).text(parameter);
            for (const double value : values)
                csv.number(value);
            csv.end_row();
        };
        if (!v.values.empty())
            add("", v.values);
        for (std::size_t p = 0; p < v.effects.size(); ++p) {
            std::vector<double> values = v.values;
            for (std::size_t q = 0; q < values.size(); ++q)
                values[q] += v.effects[p][q];
            add(s.parameters[p], values);
        }
    }
    table.commit();
}

void write_speed(const SpeedResult& speed, const fs::path& folder) {
    Table table(folder / "speed.csv",
                {"object", "data", "method", "triangles", "threads", "passes", "frames_per_second"});
    for (const SpeedRow& row : speed.rows)
        table.row()
            .text(row.object)
            .text(row.real ? "public" : "embedded")
            .text(row.method)
            .integer(static_cast<long long>(row.triangles))
            .integer(row.threads)
            .integer(row.passes)
            .number(row.frames_per_second)
            .end_row();
    table.commit();
}

} // namespace

bool is_report_file(const std::string& name) {
    static const std::set<std::string> names{"report.html",           "results.json",
                                             "timings.json",          "curves.csv",
                                             "moment_arms.csv",       "moment_arm_ranges.csv",
                                             "surface_distances.csv", "published_program.csv",
                                             "sensitivity.csv",       "speed.csv"};
    return names.contains(name) || (name.starts_with("fibre_lengths-") && name.ends_with(".csv"));
}

void write_tables(const Results& results, const fs::path& folder) {
    write_curves(results, folder);
    write_fibre_lengths(results, folder);
    write_arms(results, folder);
    write_distances(results, folder);
    write_published(results, folder);
    write_sensitivity(results.sensitivity, folder);
    write_speed(results.speed, folder);
}

} // namespace fascicle::reproduce
