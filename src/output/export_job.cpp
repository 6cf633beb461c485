#include "output/export_job.hpp"

#include "fascicle/base/error.hpp"
#include "output/data_export.hpp"
#include "output/film.hpp"
#include "output/report_film.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace fascicle::output {

namespace {

/// Pictures that may wait to be written: memory stays bounded, and the drawing thread seldom waits.
constexpr std::size_t most_waiting = 3;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Drawn {
    render::Image image;
    Shot shot;
    int frame = 0;
};

} // namespace

struct ExportJob::Worker {
    std::atomic<bool> cancel{false};
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::deque<Drawn> waiting; ///< this and what follows: guarded by mutex
    bool all_drawn = false;
    State state = State::running;
    std::string error, stage;
    double fraction = 0;
    std::thread thread;

    JobControl control() {
        JobControl control;
        control.cancel = &cancel;
        control.report = [this](std::string_view what, double share) {
            const std::lock_guard lock(mutex);
            stage = what;
            fraction = share;
        };
        return control;
    }
    void end(State how, std::string why = {}) {
        const std::lock_guard lock(mutex);
        state = how;
        error = std::move(why);
        waiting.clear();
    }
    void run(const std::function<void()>& work) {
        try {
            work();
            end(State::done);
        } catch (const Cancelled&) {
            end(State::cancelled);
        } catch (const std::exception& problem) {
            if (cancel) // what fails because it was told to stop is no failure
                end(State::cancelled);
            else
                end(State::failed, problem.what());
        }
    }
    void write(Film& film) {
        for (;;) {
            Drawn drawn;
            {
                std::unique_lock lock(mutex);
                changed.wait(lock, [&] { return cancel || !waiting.empty() || all_drawn; });
                if (cancel)
                    throw Cancelled();
                if (waiting.empty())
                    break;
                drawn = std::move(waiting.front());
                waiting.pop_front();
            }
            if (drawn.shot.sample)
                film.sample(drawn.image);
            else
                film.add(drawn.image, drawn.frame);
        }
        film.finish(control());
    }
};

ExportJob::ExportJob(ExportRequest request, RecordingPtr recording, PictureLook look,
                     std::shared_ptr<const MeasuredRows> measured)
    : request_(std::move(request)), recording_(std::move(recording)), worker_(std::make_unique<Worker>()) {
    if (export_kind(request_.kind).traits.draws)
        plan(look);
    Worker& worker = *worker_;
    const auto work = [this, &worker, measured = std::move(measured)] {
        worker.run([&] {
            if (request_.kind == "report") {
                std::vector<std::string> titles;
                for (const Shot& shot : shots_)
                    titles.push_back(shot.title);
                ReportFilm film(request_, recording_, std::move(titles), measured);
                worker.write(film);
            } else if (!shots_.empty()) {
                const std::unique_ptr<Film> film =
                    make_film(request_, recording_->scene_ptr(), &worker.cancel);
                worker.write(*film);
            } else {
                export_data(request_, *recording_, worker.control());
            }
        });
    };
    worker.thread = std::thread(work);
}

ExportJob::~ExportJob() {
    cancel();
    worker_->thread.join();
}

/// Which pictures, in which order.
void ExportJob::plan(const PictureLook& look) {
    PictureLook own = look;
    own.width = allowed_side(look.width, request_.kind);
    own.height = allowed_side(look.height, request_.kind);
    own.transparent = look.transparent && export_kind(request_.kind).traits.clear;
    if (request_.kind == "report") {
        shots_ = report_shots(*recording_, look);
    } else if (request_.kind == "picture") {
        shots_.push_back(
            {recording_->frame_count() == 0 ? -1 : place_of_frame(*recording_, request_.frame), own, {}});
    } else {
        for (const int place : chosen_frames(*recording_, request_))
            shots_.push_back({place, own, {}});
    }
    total_ = static_cast<int>(shots_.size());
    if (request_.kind != "gif")
        return;
    // Samples for the palette: small, spread over the film.
    const double shrink = std::min(1.0, 480.0 / std::max(own.width, own.height));
    PictureLook small = own;
    small.width = std::max(1, static_cast<int>(own.width * shrink));
    small.height = std::max(1, static_cast<int>(own.height * shrink));
    small.line_scale = static_cast<float>(own.line_scale * shrink);
    const int count = std::min(total_, 8);
    std::vector<Shot> samples;
    for (int i = 0; i < count; ++i)
        samples.push_back({shots_[static_cast<std::size_t>(i * (total_ - 1) / std::max(1, count - 1))].place,
                           small,
                           {},
                           true});
    shots_.insert(shots_.begin(), samples.begin(), samples.end());
}

void ExportJob::draw(double seconds) {
    Worker& worker = *worker_;
    const auto may_go_on = [&] {
        const std::lock_guard lock(worker.mutex);
        return worker.state == State::running && !worker.cancel && worker.waiting.size() < most_waiting;
    };
    const double start = seconds_now();
    try {
        while (next_ < shots_.size() && may_go_on()) {
            if (painter_ == nullptr)
                painter_ = std::make_unique<FramePainter>();
            const Shot& shot = shots_[next_];
            if (!std::exchange(begun_, true))
                painter_->begin(shot.place < 0 ? view::subject_of(recording_->scene_ptr())
                                               : view::subject_of(*recording_, shot.place),
                                shot.look);
            painter_->step();
            if (painter_->complete()) {
                const FramePtr frame = recording_->frame(shot.place);
                Drawn drawn{painter_->take(), shot, frame == nullptr ? 0 : frame->index};
                begun_ = false;
                ++next_;
                drawn_ += shot.sample ? 0 : 1;
                const std::lock_guard lock(worker.mutex);
                worker.waiting.push_back(std::move(drawn));
                worker.all_drawn = next_ == shots_.size();
                worker.changed.notify_one();
            }
            if (seconds_now() - start >= seconds)
                break;
        }
    } catch (const std::exception& problem) {
        cancel();
        worker.thread.join();
        worker.thread = std::thread([] {}); // what the destructor joins
        worker.end(State::failed, problem.what());
    }
    if (next_ == shots_.size() || state() != State::running)
        painter_.reset(); // its GPU memory is not needed any more
}

void ExportJob::finish(const std::atomic<bool>* stop, const std::function<void(double)>& progress) {
    while (state() == State::running) {
        if (stop != nullptr && *stop)
            cancel();
        draw(0.1);
        if (progress)
            progress(fraction());
        if (next_ == shots_.size() || state() != State::running)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        else
            std::this_thread::yield();
    }
    if (state() == State::failed)
        throw Error(error());
    if (state() == State::cancelled)
        throw Cancelled();
}

void ExportJob::cancel() {
    const std::lock_guard lock(worker_->mutex);
    worker_->cancel = true;
    worker_->changed.notify_all();
}

ExportJob::State ExportJob::state() const {
    const std::lock_guard lock(worker_->mutex);
    return worker_->state;
}

std::string ExportJob::error() const {
    const std::lock_guard lock(worker_->mutex);
    return worker_->error;
}

double ExportJob::fraction() const {
    const std::lock_guard lock(worker_->mutex);
    if (worker_->state == State::done)
        return 1;
    if (shots_.empty())
        return worker_->fraction;
    const double pictures = double(next_) / double(shots_.size());
    // A report's pictures are quick, its measuring takes the time.
    return request_.kind == "report" ? 0.2 * pictures + 0.8 * worker_->fraction : pictures;
}

std::string ExportJob::stage() const {
    const std::lock_guard lock(worker_->mutex);
    if (next_ < shots_.size())
        return "pictures";
    return worker_->stage.empty() ? "writing" : worker_->stage;
}

} // namespace fascicle::output
