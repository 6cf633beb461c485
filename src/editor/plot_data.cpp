#include "editor/plot_data.hpp"

#include "editor/frame_axis.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "fascicle/metrics/moment_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fascicle::editor {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// One value per frame of one muscle.
std::vector<double> column(const MetricValues& values, std::size_t muscle, const char* key) {
    std::vector<double> result;
    const int row = key == nullptr ? -1 : metric_index(key);
    if (row < 0)
        return result;
    result.reserve(values.rows.size());
    for (const auto& frame : values.rows)
        result.push_back(muscle < frame.size() ? frame[muscle][static_cast<std::size_t>(row)] : none);
    return result;
}

bool has_fibres(const MetricValues& values) {
    return std::any_of(values.fibres.begin(), values.fibres.end(),
                       [](const FibreValues& fibres) { return fibres.count > 0; });
}

/// Areas one on the other, and the whole as a ghost.
std::vector<std::shared_ptr<const PlotSeries>> stage_curves(const MetricValues& values, bool ghost,
                                                            const std::shared_ptr<const AnglePath>& path) {
    std::vector<std::shared_ptr<const PlotSeries>> curves;
    const auto frames = static_cast<std::size_t>(values.frame_count());
    std::vector<double> below(frames, 0.0);
    int colour = 0;
    for (const auto& [stage, times] : values.stages_ms) {
        auto series = std::make_shared<PlotSeries>();
        series->role = PlotSeries::Role::stage;
        series->name = stage;
        series->key = stage + "_ms";
        series->colour = colour++;
        series->run = values.id;
        series->y = times;
        series->low = below;
        for (std::size_t k = 0; k < frames; ++k)
            below[k] += times[k];
        series->high = below;
        series->path = path;
        if (!ghost)
            curves.push_back(std::move(series));
    }
    if (ghost && !values.stages_ms.empty()) {
        auto whole = std::make_shared<PlotSeries>();
        whole->name = "all stages";
        whole->key = "all_stages_ms";
        whole->colour = 1;
        whole->run = values.id;
        whole->ghost = true;
        whole->y = below;
        whole->path = path;
        curves.push_back(std::move(whole));
    }
    return curves;
}

PlotFibres fibres_of(const std::vector<double>& values, std::size_t count) {
    PlotFibres result;
    result.count = count;
    result.frames = values.size() / count;
    result.values = std::make_shared<const std::vector<double>>(values);
    result.least.assign(result.frames, none);
    result.most = result.least;
    for (std::size_t k = 0; k < result.frames; ++k)
        for (std::size_t f = 0; f < count; ++f) {
            const double v = result.value(k, f);
            if (std::isfinite(v)) { // the comparisons are false for NaN
                result.least[k] = v < result.least[k] || std::isnan(result.least[k]) ? v : result.least[k];
                result.most[k] = v > result.most[k] || std::isnan(result.most[k]) ? v : result.most[k];
            }
        }
    return result;
}

} // namespace

AnglePath angle_path(std::span<const double> angles_rad) {
    AnglePath path;
    for (const double angle : angles_rad)
        path.degrees.push_back(angle * 180 / std::numbers::pi);
    if (std::all_of(angles_rad.begin(), angles_rad.end(), [](double a) { return std::isfinite(a); })) {
        const std::vector<MotionSpan> spans = motion_spans(angles_rad);
        for (std::size_t i = 1; i < spans.size(); ++i)
            path.turns.push_back(spans[i].first);
    }
    return path;
}

PlotData::~PlotData() = default; // a future of std::async waits for its thread

void PlotData::update(EditorContext& context) {
    const ScenePtr head = context.document.head();
    if (head != scene_) {
        // A name or a parameter moves no line muscle; measuring them takes time.
        const auto same_bone = [](const Bone& x, const Bone& y) {
            return x.name == y.name && x.mesh == y.mesh;
        };
        const bool same_lines = scene_ != nullptr && scene_->line_muscles == head->line_muscles &&
                                scene_->unit == head->unit &&
                                actions::same_timeline(scene_->timeline, head->timeline) &&
                                std::equal(scene_->bones.begin(), scene_->bones.end(), head->bones.begin(),
                                           head->bones.end(), same_bone);
        scene_ = head;
        if (!same_lines)
            lines_ = line_series(*head);
        std::vector<double> angles;
        for (int k = 0; k <= head->timeline.last_frame; ++k)
            angles.push_back(head->timeline.angle_rad(k));
        planned_ = std::make_shared<const AnglePath>(angle_path(angles));
        lines_path_ = std::make_shared<const AnglePath>(angle_path(lines_.angles_rad));
        for (PlotOverlay& overlay : overlays_)
            place(overlay);
        contents_.clear();
        ghosts_.clear(); // colours go by the muscles' places
    }
    if (context.metrics.version() != values_version_) {
        values_version_ = context.metrics.version();
        contents_.clear();
        const auto gone = [&](const auto& entry) {
            if constexpr (requires { entry.first.first; })
                return context.metrics.find(entry.first.first) == nullptr;
            else
                return context.metrics.find(entry.first) == nullptr;
        };
        std::erase_if(ghosts_, gone);
        std::erase_if(paths_, gone);
        std::erase_if(path_frames_, gone);
    }
    for (std::size_t i = 0; i < reading_.size();) {
        if (reading_[i].wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            ++i;
            continue;
        }
        try {
            overlays_.push_back(reading_[i].get());
            place(overlays_.back());
            context.log.add(Severity::note, "Overlaid " + overlays_.back().name + ": " +
                                                std::to_string(overlays_.back().curves.size()) +
                                                " curves, dashed.");
        } catch (const std::exception& problem) {
            context.log.add(Severity::error, problem.what());
        }
        reading_.erase(reading_.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

void PlotData::place(PlotOverlay& overlay) const {
    place_overlay(overlay, frame_seconds(*scene_), scene_->timeline, planned_->degrees);
}

void PlotData::document_replaced(EditorContext& context) {
    overlays_.clear();
    contents_.clear();
    ghosts_.clear();
    context.state.plots.y.clear();
    context.state.plots.angles.reset();
    context.state.plots.maximised.clear();
}

std::optional<double> PlotData::redraw_after() const {
    return reading_.empty() ? std::nullopt : std::optional(1.0 / 25);
}

void PlotData::finish() {
    for (std::future<PlotOverlay>& job : reading_)
        job.wait();
}

std::vector<const PlotRow*> PlotData::rows(const EditorContext& context) {
    const bool fibres =
        has_fibres(context.metrics.current()) ||
        std::any_of(context.metrics.earlier().begin(), context.metrics.earlier().end(), has_fibres);
    std::vector<const PlotRow*> result;
    for (const PlotRow& row : plot_rows())
        if (row.of_fibres == nullptr || fibres || !lines_.muscles.empty())
            result.push_back(&row);
    return result;
}

std::shared_ptr<const AnglePath> PlotData::path_of(const MetricValues& values) {
    std::size_t& frames = path_frames_[values.id];
    std::shared_ptr<const AnglePath>& path = paths_[values.id];
    if (path == nullptr || frames != values.angles_rad.size()) {
        frames = values.angles_rad.size();
        path = std::make_shared<const AnglePath>(angle_path(values.angles_rad));
    }
    return path;
}

PlotData::Curves PlotData::curves_of(const EditorContext& context, const PlotRow& row,
                                     const MetricValues& values, bool ghost,
                                     const std::shared_ptr<const AnglePath>& path) const {
    if (row.stages)
        return stage_curves(values, ghost, path);
    Curves curves;
    if (values.scene == nullptr)
        return curves;
    const Scene& scene = context.document.scene();
    const bool many = values.scene->muscles.size() > 1;
    for (std::size_t m = 0; m < values.scene->muscles.size(); ++m) {
        const std::string& name = values.scene->muscles[m].name;
        const int place = scene.muscle_index(name);
        if (place < 0)
            continue; // it is no longer there
        const std::string prefix = many ? name + "_" : std::string();
        auto series = std::make_shared<PlotSeries>();
        series->name = name;
        series->colour = place;
        series->run = values.id;
        series->ghost = ghost;
        series->y = column(values, m, row.key);
        series->key = prefix + row.key;
        series->path = path;
        const bool band = row.low_key != nullptr;
        if (band) {
            series->low = column(values, m, row.low_key);
            series->high = column(values, m, row.high_key);
            series->low_key = prefix + row.low_key;
            series->high_key = prefix + row.high_key;
        }
        curves.push_back(std::move(series));
        if (row.extreme_key != nullptr && !ghost) {
            auto extreme = std::make_shared<PlotSeries>();
            extreme->role = PlotSeries::Role::extreme;
            extreme->name = name;
            extreme->colour = place;
            extreme->run = values.id;
            extreme->y = column(values, m, row.extreme_key);
            extreme->key = prefix + row.extreme_key;
            extreme->path = path;
            curves.push_back(std::move(extreme));
        }
    }
    return curves;
}

/// Line muscles go as the motion is planned, so their curves are there before any run.
void PlotData::add_lines(const PlotRow& row, Curves& curves) const {
    const std::size_t muscles = lines_.muscles.size();
    if (row.of_lines == nullptr)
        return;
    for (std::size_t m = 0; m < muscles; ++m) {
        auto series = std::make_shared<PlotSeries>();
        series->role = PlotSeries::Role::line;
        series->name = lines_.muscles[m];
        series->key =
            lines_.muscles[m] + (row.of_lines == &LineSeries::lengths_mm ? "_length_mm" : "_moment_arm_mm");
        series->colour = static_cast<int>(m);
        series->path = lines_path_;
        series->y.reserve(lines_.frames.size());
        for (std::size_t k = 0; k < lines_.frames.size(); ++k)
            series->y.push_back((lines_.*row.of_lines)[k * muscles + m]);
        curves.push_back(std::move(series));
    }
}

const PlotContent& PlotData::content(const EditorContext& context, const PlotRow& row) {
    if (context.document.head() != scene_ || context.metrics.version() != values_version_)
        contents_.clear();
    const auto found = contents_.find(row.id);
    if (found != contents_.end())
        return found->second;
    PlotContent content;
    content.version = ++version_;
    const auto& earlier = context.metrics.earlier();
    for (auto values = earlier.rbegin(); values != earlier.rend(); ++values) {
        const auto [ghosts, fresh] = ghosts_.try_emplace({values->id, row.id});
        if (fresh)
            ghosts->second = curves_of(context, row, *values, true, path_of(*values));
        content.series.insert(content.series.end(), ghosts->second.begin(), ghosts->second.end());
    }
    const MetricValues& now = context.metrics.current();
    if (now.frame_count() > 0) {
        const auto path = path_of(now);
        const Curves curves = curves_of(context, row, now, false, path);
        content.series.insert(content.series.end(), curves.begin(), curves.end());
        for (std::size_t m = 0; m < now.fibres.size() && row.of_fibres != nullptr; ++m) {
            const std::string& name = now.scene->muscles[m].name;
            const int place = context.document.scene().muscle_index(name);
            const std::vector<double>& values = now.fibres[m].*row.of_fibres;
            if (place < 0 || now.fibres[m].count == 0 || values.empty())
                continue;
            PlotFibres fibres = fibres_of(values, now.fibres[m].count);
            fibres.muscle = name;
            fibres.colour = place;
            fibres.path = path;
            content.fibres.push_back(std::move(fibres));
        }
    }
    add_lines(row, content.series);
    return contents_[row.id] = std::move(content);
}

void PlotData::read_overlay(const std::filesystem::path& file, const std::string& plot) {
    reading_.push_back(
        std::async(std::launch::async, [file, plot] { return fascicle::editor::read_overlay(file, plot); }));
}

void PlotData::remove_overlays(const std::string& plot) {
    std::erase_if(overlays_, [&](const PlotOverlay& overlay) { return overlay.plot == plot; });
}

} // namespace fascicle::editor
