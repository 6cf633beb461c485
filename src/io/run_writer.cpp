#include "fascicle/io/run_writer.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/fibre_files.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/line_table.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "fascicle/io/output_folder.hpp"
#include "fascicle/io/series_file.hpp"
#include "fascicle/io/staged_files.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/run_difference.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "io/earlier_exports.hpp"
#include "io/formats/pvd.hpp"
#include "io/run_files.hpp"
#include "io/run_summary.hpp"

#include <algorithm>
#include <exception>
#include <numbers>
#include <set>

namespace fascicle {
namespace fs = std::filesystem;

struct RunWriter::Impl {
    fs::path target; ///< where all is in the end
    StagedFiles staged;
    fs::path folder; ///< where all is meanwhile
    ScenePtr scene;
    RunOutputOptions options;
    AtomicFile metrics_file, motion_file;
    CsvWriter metrics{metrics_file.stream()}, motion{motion_file.stream()};
    std::vector<std::vector<Attachment>> attachments;
    std::vector<int> kept; ///< frames that get files: every K-th, and in the end the last
    struct MetricsLine {
        int frame;
        std::size_t muscle;
        double angle_deg;
        std::vector<double> values;
    };
    std::vector<MetricsLine> lines; ///< written at the end: some columns are decided by the whole run
    FramePtr last;
    std::vector<std::vector<NamedArray>> last_arrays;

    Impl(const fs::path& where, ScenePtr what, RunOutputOptions how)
        : target(without_inputs(where, *what)), staged(target), folder(staged.place()),
          scene(std::move(what)), options(std::move(how)), metrics_file(folder / "metrics.csv"),
          motion_file(folder / "motion.csv") {}

    void headers();
    void write_metrics(const std::vector<const FibreSeries*>& series);
    void write_fibres(const Recording& recording, const std::vector<const FibreSeries*>& series);
    void write_bones() const;
    void write_frame(const Frame& frame, const std::vector<std::vector<NamedArray>>& arrays);
    std::vector<NamedArray> attachment_arrays(std::size_t muscle) const;
    std::set<fs::path> written() const;
    void write_summary(const Recording& recording, const std::vector<io::ExportedFile>& exports = {}) const;
    void remove_stale(bool after_a_run, const std::set<fs::path>& written) const;
    void commit();
};

void RunWriter::Impl::headers() {
    motion.text("frame").text("bone");
    for (const char row : {'0', '1', '2'})
        for (const char column : {'0', '1', '2', '3'})
            motion.text(std::string{'m', row, column});
    motion.end_row();
}

void RunWriter::Impl::write_bones() const {
    for (const Bone& bone : scene->bones) {
        MeshData data;
        data.mesh = *bone.mesh;
        write_stamped_file(folder / io::bone_file(bone.name), data, stamp_of(scene->unit));
    }
}

std::vector<NamedArray> RunWriter::Impl::attachment_arrays(std::size_t muscle) const {
    const auto n = static_cast<std::size_t>(scene->muscles[muscle].mesh->vertex_count());
    NamedArray kind{io::attachment_array, 1, std::vector<double>(n, 0.0)};
    NamedArray bone{io::attached_to_array, 1, std::vector<double>(n, -1.0)};
    if (muscle < attachments.size())
        for (const Attachment& a : attachments[muscle])
            for (const int v : a.vertices) {
                const auto i = static_cast<std::size_t>(v);
                kind.values[i] = a.kind == AttachmentKind::origin      ? 1
                                 : a.kind == AttachmentKind::insertion ? 2
                                                                       : 3;
                bone.values[i] = a.bone;
            }
    return {kind, bone};
}

void RunWriter::Impl::write_frame(const Frame& frame, const std::vector<std::vector<NamedArray>>& arrays) {
    for (std::size_t m = 0; m < scene->muscles.size(); ++m) {
        MeshData data;
        data.mesh.positions = *frame.muscle_positions[m];
        data.mesh.triangles = scene->muscles[m].mesh->triangles;
        data.point_arrays = attachment_arrays(m);
        if (m < arrays.size())
            data.point_arrays.insert(data.point_arrays.end(), arrays[m].begin(), arrays[m].end());
        write_stamped_file(folder / io::frame_file(scene->muscles[m].name, frame.index), data,
                           stamp_of(scene->unit));
    }
}

/// What an earlier run in the same folder left and this one did not replace would pass for its own. Only what has names of ours.
void RunWriter::Impl::remove_stale(bool after_a_run, const std::set<fs::path>& written) const {
    std::error_code ignored;
    std::vector<fs::path> stale;
    if (options.vtp || after_a_run) {
        for (const char* part : {"frames", "fibres"})
            for (fs::directory_iterator it(target / part, ignored), end; !ignored && it != end;
                 it.increment(ignored))
                for (const Muscle& muscle : scene->muscles)
                    if (io::frame_of_file(it->path(), muscle.name) >= 0)
                        stale.push_back(fs::path(part) / it->path().filename());
        for (const Muscle& muscle : scene->muscles)
            stale.push_back(io::series_file(muscle.name));
    }
    if (after_a_run) // pictures of versions that did not say what they exported
        stale.insert(stale.end(), {"rest.png", "flexed.png", "last.png", "film_strip.png"});
    for (const fs::path& file : stale)
        if (written.count(file) == 0)
            fs::remove(target / file, ignored);
    if (written.count("fibres.csv") == 0)
        remove_fibre_table(target / "fibres.csv");
    if (written.count("lines.csv") == 0)
        remove_line_table(target / "lines.csv");
}

RunWriter::RunWriter(fs::path folder, ScenePtr scene, RunOutputOptions options) {
    FASCICLE_ASSERT(scene != nullptr && options.every >= 1);
    if (options.metric_columns.empty())
        for (const MetricRow& row : metric_table())
            options.metric_columns.push_back(row.key);
    impl_ = std::make_unique<Impl>(folder, std::move(scene), std::move(options));
    impl_->headers();
}

RunWriter::~RunWriter() = default;

void RunWriter::set_attachments(std::vector<std::vector<Attachment>> attachments) {
    FASCICLE_ASSERT(impl_->last == nullptr);
    impl_->attachments = std::move(attachments);
}

void RunWriter::add_frame(FramePtr frame, const std::vector<std::vector<double>>& metrics,
                          std::vector<std::vector<NamedArray>> point_arrays) {
    Impl& me = *impl_;
    const std::size_t muscles = me.scene->muscles.size();
    FASCICLE_ASSERT(frame->muscle_positions.size() == muscles && metrics.size() == muscles);
    FASCICLE_ASSERT(frame->bone_poses.size() == me.scene->bones.size());
    FASCICLE_ASSERT(me.last == nullptr || frame->index > me.last->index);
    if (me.last == nullptr && me.options.vtp)
        me.write_bones();
    for (std::size_t m = 0; m < muscles; ++m) {
        FASCICLE_ASSERT(metrics[m].size() == me.options.metric_columns.size());
        me.lines.push_back({frame->index, m, frame->angle_rad * 180.0 / std::numbers::pi, metrics[m]});
    }
    for (std::size_t b = 0; b < frame->bone_poses.size(); ++b) {
        const Pose& pose = frame->bone_poses[b];
        me.motion.integer(frame->index).text(me.scene->bones[b].name);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                me.motion.number(pose.rotation(row, column));
            me.motion.number(pose.translation[row]);
        }
        me.motion.end_row();
    }
    if (!me.metrics_file.stream() || !me.motion_file.stream())
        throw_error(me.folder.string(), "cannot write the tables of the run", "space on the disk");
    if (frame->index % me.options.every == 0) {
        me.kept.push_back(frame->index);
        if (me.options.vtp)
            me.write_frame(*frame, point_arrays);
    }
    me.last = std::move(frame);
    me.last_arrays = std::move(point_arrays);
}

/// One row per frame and muscle.
void RunWriter::Impl::write_metrics(const std::vector<const FibreSeries*>& series) {
    const bool any =
        std::any_of(series.begin(), series.end(), [](const FibreSeries* s) { return s != nullptr; });
    std::vector<const MetricRow*> rows; // by column; null for one that is not in the table
    for (const std::string& key : options.metric_columns) {
        const int index = metric_index(key);
        rows.push_back(index < 0 ? nullptr : &metric_table()[static_cast<std::size_t>(index)]);
    }
    const auto shown = [&](std::size_t c) { return any || rows[c] == nullptr || !rows[c]->of_fibres; };
    metrics.text("frame").text("muscle").text("angle_deg");
    for (std::size_t c = 0; c < rows.size(); ++c)
        if (shown(c))
            metrics.text(options.metric_columns[c]);
    const ModelMotion* trial = model_motion_in_force(*scene);
    const auto coordinate = [&](int c) -> const Coordinate& {
        return trial->model->skeleton.coordinates[static_cast<std::size_t>(c)];
    };
    if (trial != nullptr)
        for (const int c : trial->moving)
            metrics.text(coordinate_column(coordinate(c)));
    metrics.end_row();
    for (const MetricsLine& line : lines) {
        metrics.integer(line.frame).text(scene->muscles[line.muscle].name).number(line.angle_deg);
        const FibreSeries* own = line.muscle < series.size() ? series[line.muscle] : nullptr;
        const int k = own != nullptr ? own->index_of(line.frame) : -1;
        for (std::size_t c = 0; c < rows.size(); ++c)
            if (shown(c))
                metrics.number(k >= 0 && rows[c] != nullptr && rows[c]->over_run ? rows[c]->over_run(*own, k)
                                                                                 : line.values[c]);
        if (trial != nullptr)
            for (const int c : trial->moving)
                metrics.number(
                    coordinate_number(coordinate(c), trial->at(line.frame)[static_cast<std::size_t>(c)]));
        metrics.end_row();
    }
}

/// fibres.csv, and polylines of the frames that are kept.
void RunWriter::Impl::write_fibres(const Recording& recording,
                                   const std::vector<const FibreSeries*>& series) {
    std::vector<const FibreSeries*> present;
    const std::vector<FibreModelPtr> models = recording.fibres();
    for (std::size_t m = 0; m < series.size(); ++m) {
        if (series[m] == nullptr)
            continue;
        present.push_back(series[m]);
        if (!options.polylines)
            continue;
        FibreSet fibres = series[m]->rest();
        std::vector<std::pair<double, std::string>> steps;
        for (const int k : kept) {
            const FramePtr frame =
                frame_not_after(recording, k); // its place is another in what was read from a thinned run
            FASCICLE_ASSERT(frame != nullptr && frame->index == k);
            models.at(m)->carrier.carry(*frame->muscle_positions[m], fibres.points);
            write_stamped_file(folder / fibre_file(scene->muscles[m].name, k),
                               fibre_lines(*series[m], k, fibres), stamp_of(scene->unit));
            steps.emplace_back(k * scene->parameters.get("solver.frame_time"),
                               fibre_file(scene->muscles[m].name, k).filename().string());
        }
        if (!steps.empty())
            write_series_file(folder / "fibres" / io::series_file(scene->muscles[m].name), steps);
    }
    if (!present.empty())
        write_fibre_table(folder / "fibres.csv", present);
}

void RunWriter::Impl::commit() {
    std::error_code ignored;
    const bool after_a_run = fs::is_regular_file(target / "summary.json", ignored);
    const std::set<fs::path> files = written();
    const std::vector<fs::path> earlier = io::earlier_exports(target);
    staged.commit(*scene);
    remove_stale(after_a_run, files);
    io::remove_exports(target, earlier, files, inputs_of(*scene));
}

std::set<fs::path> RunWriter::Impl::written() const {
    std::error_code ignored;
    std::set<fs::path> files;
    for (fs::recursive_directory_iterator it(folder, ignored), end; !ignored && it != end;
         it.increment(ignored))
        if (!it->is_directory(ignored))
            files.insert(it->path().lexically_relative(folder));
    return files;
}

void RunWriter::Impl::write_summary(const Recording& recording,
                                    const std::vector<io::ExportedFile>& exports) const {
    write_file(folder / "summary.json",
               io::run_summary(recording, options, options.vtp ? kept : std::vector<int>{}, exports));
}

void RunWriter::finish(const Recording& recording, const std::vector<const FibreSeries*>& series,
                       const std::function<void(const fs::path&)>& more) {
    Impl& me = *impl_;
    me.write_metrics(series);
    if (!me.metrics_file.stream())
        throw_error(me.folder.string(), "cannot write the tables of the run", "space on the disk");
    if (me.last && (me.kept.empty() || me.kept.back() != me.last->index)) {
        me.kept.push_back(me.last->index);
        if (me.options.vtp)
            me.write_frame(*me.last, me.last_arrays);
    }
    if (me.options.vtp) {
        const double frame_time = me.scene->parameters.get("solver.frame_time");
        for (const Muscle& muscle : me.scene->muscles) {
            std::vector<std::pair<double, std::string>> files;
            for (const int frame : me.kept)
                files.emplace_back(frame * frame_time, io::frame_file(muscle.name, frame).generic_string());
            AtomicFile file(me.folder / io::series_file(muscle.name));
            io::write_pvd(file.stream(), files);
            file.commit();
        }
    }
    me.write_fibres(recording, series);
    if (me.scene->line_muscles != nullptr)
        write_line_table(me.folder / "lines.csv", line_series(recording));
    me.metrics_file.commit();
    me.motion_file.commit();
    me.write_summary(recording);
    if (!more)
        return me.commit();
    std::exception_ptr failure;
    const std::set<fs::path> before = me.written();
    try {
        more(me.folder);
    } catch (...) {
        failure = std::current_exception();
    }
    // What is there of them, all or some: the next run in this folder removes it, since it is of this one.
    std::vector<io::ExportedFile> exports;
    for (const fs::path& file : me.written())
        if (before.count(file) == 0)
            exports.push_back(io::exported_file(me.folder, file));
    try {
        if (!exports.empty() && me.options.list_exports)
            me.write_summary(recording, exports);
    } catch (...) {
        if (!failure)
            failure = std::current_exception();
    }
    me.commit();
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace fascicle
