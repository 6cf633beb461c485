#pragma once
// What the plots show, made once per change of the measured values and shared by panel, view and exports.

#include "editor/feature.hpp"
#include "editor/plot_overlay.hpp"
#include "editor/plot_rows.hpp"
#include "editor/widgets/plot.hpp"

#include <future>

namespace fascicle::editor {

/// Positions of the frames of a run on an axis of angles. degrees[k]: frame k. turns: first frames of the branches after the
/// first, e.g. of the way back.
struct AnglePath {
    std::vector<double> degrees;
    std::vector<std::size_t> turns;
};
AnglePath angle_path(std::span<const double> angles_rad);

/// One curve. y, low, high: per frame.
struct PlotSeries {
    enum class Role { muscle, extreme, line, stage };
    Role role = Role::muscle;
    std::string name; ///< of muscle, line muscle or stage
    std::string key;  ///< of the columns in a csv, unit as suffix; low_key, high_key: of the band
    std::string low_key, high_key;
    int colour = 0;        ///< index for curve_colour()
    std::uint64_t run = 0; ///< 0: of the scene, no run
    bool ghost = false;    ///< of an earlier run
    std::vector<double> y, low, high;
    std::shared_ptr<const AnglePath> path;
};

/// A line for each fibre of a muscle of the present run, frame-major.
struct PlotFibres {
    std::string muscle;
    int colour = 0;
    std::size_t count = 0, frames = 0;
    std::shared_ptr<const std::vector<double>> values;
    std::vector<double> least, most; ///< per frame, over the fibres
    std::shared_ptr<const AnglePath> path;
    double value(std::size_t frame, std::size_t fibre) const { return (*values)[frame * count + fibre]; }
};

struct PlotContent {
    std::vector<std::shared_ptr<const PlotSeries>> series; ///< ghosts first, oldest first
    std::vector<PlotFibres> fibres;
    std::uint64_t version = 0; ///< differs after every change
};

class PlotData : public Feature {
public:
    ~PlotData() override;
    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

    /// In the order of the table. Plots of fibres only where a run has some, or the scene line muscles.
    std::vector<const PlotRow*> rows(const EditorContext& context);
    const PlotContent& content(const EditorContext& context, const PlotRow& row);
    /// Layouts of single lines, kept from frame to frame.
    PlotInk& ink() { return ink_; }
    const LineSeries& lines() const { return lines_; }
    /// Of the timeline as planned: frame to degrees.
    const AnglePath& planned() const { return *planned_; }

    /// Curves from files, per plot.
    const std::vector<PlotOverlay>& overlays() const { return overlays_; }
    /// Reads on a thread; an error goes to the log.
    void read_overlay(const std::filesystem::path& file, const std::string& plot);
    void remove_overlays(const std::string& plot);
    /// Waits for the reader; for pictures and tests.
    void finish();

private:
    using Curves = std::vector<std::shared_ptr<const PlotSeries>>;
    Curves curves_of(const EditorContext& context, const PlotRow& row, const MetricValues& values, bool ghost,
                     const std::shared_ptr<const AnglePath>& path) const;
    void place(PlotOverlay& overlay) const;
    void add_lines(const PlotRow& row, Curves& curves) const;
    std::shared_ptr<const AnglePath> path_of(const MetricValues& values);

    ScenePtr scene_; ///< that what follows was made for
    LineSeries lines_;
    std::shared_ptr<const AnglePath> planned_ = std::make_shared<const AnglePath>(), lines_path_ = planned_;
    std::uint64_t version_ = 0, values_version_ = 0;
    std::map<std::string, PlotContent> contents_; ///< by row
    std::map<std::pair<std::uint64_t, std::string>, Curves> ghosts_;
    std::map<std::uint64_t, std::shared_ptr<const AnglePath>> paths_; ///< of runs
    std::map<std::uint64_t, std::size_t> path_frames_;
    std::vector<PlotOverlay> overlays_;
    PlotInk ink_;
    std::vector<std::future<PlotOverlay>> reading_;
};

} // namespace fascicle::editor
