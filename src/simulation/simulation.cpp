#include "fascicle/simulation/simulation.hpp"

#include "fascicle/simulation/prepare.hpp"
#include "fascicle/simulation/scene_solver.hpp"

#include <algorithm>
#include <chrono>

namespace fascicle {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class Runner {
public:
    Runner(Recording& recording, const SimulationOptions& options, const JobControl& control)
        : recording_(recording), scene_(recording.scene()), options_(options), control_(control) {}

    void run() {
        const auto start = Clock::now();
        recording_.set_threads(options_.threads);
        for (const std::string& note : options_.notes)
            recording_.add_note(note);
        PreparedScene prepared = prepare_scene(scene_, options_.threads, control_, options_.cache.get());
        solver_ = std::make_unique<SceneSolver>(scene_, prepared, options_.threads);
        released_.assign(solver_->muscle_count(), 0);
        publish_attachments(prepared);
        std::vector<FibreModelPtr> fibres;
        for (const PreparedMuscle& muscle : prepared.muscles)
            fibres.push_back(muscle.fibres);
        recording_.set_fibres(std::move(fibres));
        for (std::string& note : prepared.notes)
            recording_.add_note(std::move(note));
        recording_.set_prepare_seconds(seconds_since(start));
        append_frame(0, bone_poses(scene_, 0), {});
        for (int frame = 1; frame <= scene_.timeline.last_frame; ++frame) {
            control_.checkpoint("solve", double(frame - 1) / scene_.timeline.last_frame);
            solve_frame(frame);
        }
        control_.checkpoint("solve", 1.0);
        note_contact();
        note_unconverged();
    }

private:
    /// What the bones asked for that had no plain answer.
    void note_contact() {
        if (first_ejected_ >= 0)
            recording_.add_note("contact: a place outside of all bones had to be searched for " +
                                std::to_string(before_.ejected) +
                                " vertices (summed over substeps), first in frame " +
                                std::to_string(first_ejected_));
        if (first_impossible_ >= 0)
            recording_.add_note("contact: from frame " + std::to_string(first_impossible_) +
                                " on the bones leave some vertices no place outside of all of them: the "
                                "motion is not possible as it is");
    }

    void note_unconverged() {
        if (unconverged_frames_ > 0)
            recording_.add_note(scene_.parameters.get_choice("solver.method") + ": " +
                                std::to_string(unconverged_frames_) + " of " +
                                std::to_string(scene_.timeline.last_frame) +
                                " frames ended before forces and volume were in balance, first in frame " +
                                std::to_string(first_unconverged_) + "; smaller steps between frames help");
    }

    void solve_frame(int frame) {
        const std::vector<Pose> from = bone_poses(scene_, frame - 1), to = bone_poses(scene_, frame);
        const auto start = Clock::now();
        solver_->advance(from, to);
        FrameReport report;
        report.solve_seconds = seconds_since(start);
        note_released(frame);
        append_frame(frame, to, std::move(report));
    }

    /// Attachments that the solver gave up for this frame: a sentence, and no longer part of what the run says is attached.
    void note_released(int frame) {
        std::vector<std::vector<Attachment>> all;
        for (std::size_t m = 0; m < solver_->muscle_count(); ++m) {
            const std::size_t count = solver_->released(m).size() - released_[m];
            if (count == 0)
                continue;
            if (all.empty())
                all = recording_.attachments();
            const auto first = solver_->released(m).begin() + static_cast<std::ptrdiff_t>(released_[m]);
            for (Attachment& attachment : all[m])
                std::erase_if(attachment.vertices, [&](int v) {
                    return std::find(first, solver_->released(m).end(), v) != solver_->released(m).end();
                });
            std::erase_if(all[m], [](const Attachment& a) { return a.vertices.empty(); });
            released_[m] += count;
            recording_.add_note(scene_.muscles[m].name + ": " + std::to_string(count) +
                                " attached vertices released in frame " + std::to_string(frame) +
                                ", another bone came nearer than 0.5 mm to them");
        }
        if (!all.empty())
            recording_.set_attachments(std::move(all));
    }

    void append_frame(int index, const std::vector<Pose>& poses, FrameReport report) {
        auto frame = std::make_shared<Frame>();
        frame->index = index;
        frame->angle_rad = scene_.timeline.angle_rad(index);
        frame->bone_poses = poses;
        for (std::size_t m = 0; m < solver_->muscle_count(); ++m)
            frame->muscle_positions.push_back(std::make_shared<Points>(solver_->muscle(m).positions()));
        StepReport total = solver_->report();
        report.contacts = total.contacts - before_.contacts;
        report.unresolved = total.unresolved - before_.unresolved;
        report.non_finite = total.non_finite - before_.non_finite;
        report.ejected = total.ejected - before_.ejected;
        report.impossible = total.impossible - before_.impossible;
        report.samples_held = total.samples_held - before_.samples_held;
        report.unconverged = total.unconverged - before_.unconverged;
        if (report.unconverged > 0 && unconverged_frames_++ == 0)
            first_unconverged_ = index;
        if (report.ejected > 0 && first_ejected_ < 0)
            first_ejected_ = index;
        if (report.impossible > 0 && first_impossible_ < 0)
            first_impossible_ = index;
        for (const auto& [stage, seconds] : total.stage_seconds)
            report.stage_seconds[stage] = seconds - before_.stage_seconds[stage];
        before_ = std::move(total);
        frame->report = std::move(report);
        recording_.append(std::move(frame));
    }

    /// Attachments in force: the method has the last word (classic fixes what collides at the start).
    void publish_attachments(const PreparedScene& prepared) {
        std::vector<std::vector<Attachment>> all;
        for (std::size_t m = 0; m < solver_->muscle_count(); ++m) {
            all.push_back(prepared.muscles[m].attachments);
            if (!all.back().empty())
                continue;
            const std::vector<int>& body = solver_->muscle(m).body_of_vertex();
            for (std::size_t b = 0; b < scene_.bones.size(); ++b) {
                Attachment attachment{AttachmentKind::unknown, static_cast<int>(b), {}};
                for (std::size_t i = 0; i < body.size(); ++i)
                    if (body[i] == static_cast<int>(b))
                        attachment.vertices.push_back(static_cast<int>(i));
                if (!attachment.vertices.empty()) {
                    recording_.add_note(scene_.muscles[m].name + ": " +
                                        std::to_string(attachment.vertices.size()) + " vertices fixed to '" +
                                        scene_.bones[b].name + "' by the method at the start");
                    all.back().push_back(std::move(attachment));
                }
            }
        }
        recording_.set_attachments(std::move(all));
    }

    Recording& recording_;
    const Scene& scene_;
    const SimulationOptions& options_;
    const JobControl& control_;
    std::unique_ptr<SceneSolver> solver_;
    StepReport before_;
    std::vector<std::size_t> released_; ///< by muscle: attached vertices given up so far
    int first_ejected_ = -1, first_impossible_ = -1, first_unconverged_ = -1; ///< frames
    int unconverged_frames_ = 0;
};

} // namespace

void run_simulation(Recording& recording, const SimulationOptions& options, const JobControl& control) {
    try {
        Runner(recording, options, control).run();
        recording.finish(RunState::finished);
    } catch (const Cancelled&) {
        recording.finish(RunState::cancelled);
    } catch (const std::bad_alloc&) {
        recording.finish(RunState::failed, "not enough memory");
        throw_error(recording.scene().name, "not enough memory for this scene");
    } catch (const std::exception& error) {
        recording.finish(RunState::failed, error.what());
        throw;
    }
}

SimulationThread::SimulationThread(ScenePtr scene, SimulationOptions options)
    : recording_(std::make_shared<Recording>(std::move(scene))) {
    thread_ = std::thread([this, options] {
        JobControl control;
        control.cancel = &cancel_;
        control.report = [this](std::string_view stage, double fraction) {
            const std::lock_guard lock(mutex_);
            stage_ = stage;
            fraction_ = fraction;
        };
        try {
            run_simulation(*recording_, options, control);
        } catch (const std::exception&) {
            // The recording holds the message; whoever shows it reads it there.
        }
        done_ = true;
    });
}

SimulationThread::~SimulationThread() {
    cancel_ = true;
    thread_.join();
}

std::pair<std::string, double> SimulationThread::progress() const {
    const std::lock_guard lock(mutex_);
    return {stage_, fraction_};
}

} // namespace fascicle
