#include "editor/plot_table.hpp"

#include "editor/frame_axis.hpp"
#include "fascicle/base/build_info.hpp"
#include "fascicle/io/csv.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

namespace fascicle::editor {

namespace {

/// Lower case, only what every program takes in a column's name.
std::string column_name(const std::string& text) {
    std::string name;
    for (const char c : text)
        name += std::isalnum(static_cast<unsigned char>(c)) != 0
                    ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                    : '_';
    return name;
}

std::string json_text(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
            result += code;
        } else {
            result += c;
        }
    }
    return result + '"';
}

class TableMaker {
public:
    TableMaker(const EditorContext& context, PlotData& data) : context_(context), data_(data) {
        for (int k = 0; k <= context.last_frame(); ++k) {
            frames_.push_back(k);
            seconds_.push_back(k * frame_seconds(context.document.scene()));
        }
        table_.columns.push_back({"frame", frames_});
        table_.columns.push_back({"time_s", seconds_});
        if (context.document.scene().timeline.hinge)
            table_.columns.push_back({"angle_deg", data.planned().degrees});
        table_.last = frames_.size() - 1;
    }

    void add(const PlotRow& row) {
        const EditorState& state = context_.state;
        const PlotContent& content = data_.content(context_, row);
        for (const std::shared_ptr<const PlotSeries>& series : content.series) {
            using Role = PlotSeries::Role;
            const std::string& entry = series->role == Role::line ? lines_name_ : series->name;
            if (state.hidden_curves.count(entry) != 0 || (series->ghost && !state.plots.ghosts) ||
                (series->role == Role::extreme && !state.plots.extremes))
                continue;
            std::string prefix;
            if (series->ghost)
                if (const MetricValues* run = context_.metrics.find(series->run))
                    prefix = run->name + "_";
            column(prefix + series->key, series->y);
            if (!series->ghost && !series->low_key.empty()) {
                column(series->low_key, series->low);
                column(series->high_key, series->high);
            }
        }
        if (!state.plots.single_fibres || row.of_fibres == nullptr)
            return;
        const char* const what = row.of_fibres == &FibreValues::lengths_mm ? "length_mm" : "moment_arm_mm";
        for (const PlotFibres& fibres : content.fibres) {
            if (state.hidden_curves.count(fibres.muscle) != 0)
                continue;
            for (std::size_t f = 0; f < fibres.count; ++f) {
                std::vector<double> values;
                for (std::size_t k = 0; k < fibres.frames; ++k)
                    values.push_back(fibres.value(k, f));
                char name[32];
                std::snprintf(name, sizeof name, "fibre_%03zu_", f + 1);
                column((content.fibres.size() > 1 ? fibres.muscle + "_" : std::string()) + name + what,
                       values);
            }
        }
    }

    PlotTable take() { return std::move(table_); }

private:
    void column(const std::string& key, const std::vector<double>& values) {
        const std::string base = column_name(key);
        std::string name = base;
        for (int i = 2; !names_.insert(name).second; ++i)
            name = base + "_" + std::to_string(i);
        table_.columns.push_back({name, values});
    }

    const EditorContext& context_;
    PlotData& data_;
    PlotTable table_;
    std::vector<double> frames_, seconds_;
    std::set<std::string> names_;
    const std::string lines_name_ = all_lines;
};

} // namespace

PlotTable plot_table(const EditorContext& context, PlotData& data, const std::vector<const PlotRow*>& rows,
                     bool visible_only) {
    TableMaker maker(context, data);
    for (const PlotRow* row : rows)
        maker.add(*row);
    PlotTable table = maker.take();
    if (!visible_only)
        return table;
    const bool angles = axis_of_angles(context);
    const PlotRange range =
        angles ? context.state.plots.angles.value_or(PlotRange{-1e9, 1e9}) : context.state.plot_range;
    if (!angles) {
        table.first = static_cast<std::size_t>(std::clamp(std::ceil(range.low), 0.0, double(table.last)));
        table.last = static_cast<std::size_t>(
            std::clamp(std::floor(range.high), double(table.first), double(table.last)));
        return table;
    }
    // On an axis of angles the visible frames need not follow each other.
    const std::vector<double>& degrees = data.planned().degrees;
    for (PlotTable::Column& column : table.columns) {
        std::vector<double> kept;
        for (std::size_t k = 0; k < degrees.size(); ++k)
            if (degrees[k] >= range.low && degrees[k] <= range.high)
                kept.push_back(k < column.values.size() ? column.values[k] : std::nan(""));
        column.values = std::move(kept);
    }
    table.last = table.columns[0].values.empty() ? 0 : table.columns[0].values.size() - 1;
    return table;
}

std::string to_csv(const PlotTable& table) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    CsvWriter csv(out);
    for (const PlotTable::Column& column : table.columns)
        csv.text(column.key);
    csv.end_row();
    for (std::size_t k = table.first; k <= table.last && k < table.columns[0].values.size(); ++k) {
        for (const PlotTable::Column& column : table.columns) {
            if (k >= column.values.size() || !std::isfinite(column.values[k]))
                csv.text("");
            else
                csv.number(column.values[k]);
        }
        csv.end_row();
    }
    return out.str();
}

std::string provenance_json(const EditorContext& context, const PlotTable& table, const std::string& file) {
    const auto parameters = [](const ParamSet& set) {
        std::string text;
        for (const ParamRow& row : set.table().rows())
            text += (text.empty() ? "" : ", ") + json_text(row.key) + ": " + json_text(set.text(row.key));
        return "{" + text + "}";
    };
    std::string text = "{\n  \"program\": \"fascicle " + std::string(program_version()) + "\",\n";
    text += "  \"file\": " + json_text(file) + ",\n";
    text += "  \"scene\": " + json_text(context.document.scene().name) + ",\n";
    text += "  \"unit_of_the_scene\": " + json_text(to_text(context.document.scene().unit)) + ",\n";
    text += "  \"columns\": [";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += (c > 0 ? ", " : "") + json_text(table.columns[c].key);
    text += "],\n  \"runs\": [";
    const auto run = [&](const MetricValues& values, bool first) {
        text += std::string(first ? "" : ",") + "\n    {\"name\": " + json_text(values.name) +
                ", \"frames\": " + std::to_string(values.frame_count()) +
                ", \"parameters\": " + parameters(values.scene->parameters) + "}";
    };
    bool first = true;
    if (context.metrics.current().scene != nullptr) {
        run(context.metrics.current(), first);
        first = false;
    }
    for (const MetricValues& values : context.metrics.earlier()) {
        run(values, first);
        first = false;
    }
    return text + "\n  ]\n}\n";
}

} // namespace fascicle::editor
