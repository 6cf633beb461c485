#include "output/data_export.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"

namespace fascicle::output {

namespace {

/// Frames of the recording as it is now, as a recording of its own: one that is still computed would go on growing.
RecordingPtr copy_of(const Recording& recording) {
    auto copy = std::make_shared<Recording>(recording.scene_ptr());
    copy->set_attachments(recording.attachments());
    copy->set_fibres(recording.fibres());
    for (const std::string& note : recording.notes())
        copy->add_note(note);
    copy->set_prepare_seconds(recording.prepare_seconds());
    copy->set_threads(recording.threads());
    const RunState state = recording.state();
    const int count = recording.frame_count();
    for (int k = 0; k < count; ++k)
        copy->append(recording.frame(k));
    copy->finish(state == RunState::running ? RunState::cancelled : state, recording.failure());
    return copy;
}

} // namespace

std::vector<int> chosen_frames(const Recording& recording, const ExportRequest& request) {
    FASCICLE_ASSERT(request.step >= 1);
    std::vector<int> places;
    const int count = recording.frame_count();
    for (int k = 0; k < count; ++k)
        if (const int number = recording.frame(k)->index;
            number >= request.first && number <= request.last &&
            ((number - request.first) % request.step == 0 || number == request.last))
            places.push_back(k);
    if (places.empty())
        throw_error("frames " + std::to_string(request.first) + " to " + std::to_string(request.last),
                    "the run has none of them",
                    count > 0 ? "frames 0 to " + std::to_string(recording.last_frame()->index)
                              : "a run with frames",
                    ErrorKind::usage);
    return places;
}

int place_of_frame(const Recording& recording, int number) {
    const int count = recording.frame_count();
    for (int k = 0; k < count; ++k)
        if (recording.frame(k)->index == number)
            return k;
    throw_error("frame " + std::to_string(number), "the run does not have it",
                count > 0 ? "0 to " + std::to_string(recording.last_frame()->index) : "a run with frames",
                ErrorKind::usage);
}

void export_data(const ExportRequest& request, const Recording& growing, const JobControl& control) {
    const RecordingPtr recording = copy_of(growing);
    if (recording->frame_count() == 0)
        throw_error(request.target.string(), "nothing is computed yet", "a run with at least its rest frame");
    const ExportKindRow& row = export_kind(request.kind);
    FASCICLE_ASSERT(row.write != nullptr);
    row.write(request, *recording, control);
}

} // namespace fascicle::output
