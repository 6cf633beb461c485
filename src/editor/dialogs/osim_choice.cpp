#include "editor/dialogs/osim_choice.hpp"

#include "editor/dialogs/mesh_batch.hpp"

#include <algorithm>
#include <chrono>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

/// "femur_r" of "femur", "right_femur" or "LHDL_femur_r": the body whose name without its side is in the file's name.
std::string body_like(const OsimPreview& preview, const std::string& stem) {
    const std::string name = lower(stem);
    for (const OsimPreview::BodyRow& body : preview.bodies)
        if (lower(body.name) == name)
            return body.name;
    for (const OsimPreview::BodyRow& body : preview.bodies) {
        std::string plain = lower(body.name);
        if (plain.ends_with("_r") || plain.ends_with("_l"))
            plain.erase(plain.size() - 2);
        if (!plain.empty() && name.find(plain) != std::string::npos)
            return body.name;
    }
    return {};
}

} // namespace

void OsimChoice::take(const fs::path& file) {
    const std::string extension = lower(file.extension().string());
    if (extension == ".osim") {
        request_.osim.model = file;
        std::erase_if(rows_, [](const Row& row) { return row.stand_in; }); // of another model
        stale_ = true;
    } else if (extension == ".mot" || extension == ".sto") {
        request_.motion = file;
        stale_ = true;
    } else if (std::none_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.mesh == file; })) {
        Row row;
        row.mesh = file;
        row.bone = sounds_like_bone(file.stem().string());
        guess(row);
        rows_.push_back(std::move(row));
    }
}

void OsimChoice::add_stand_in(const std::string& muscle) {
    if (!preview_ ||
        std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.mesh == muscle; }))
        return;
    for (const OsimPreview::MuscleRow& known : preview_->muscles)
        if (known.name == muscle)
            rows_.push_back({muscle, true, false, known.origin, known.insertion, false});
}

void OsimChoice::remove(std::size_t row) {
    rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(row));
}

void OsimChoice::clear() {
    if (reading_.valid())
        given_up_.push_back(std::move(reading_));
    request_ = {};
    rows_.clear();
    preview_.reset();
    problem_.clear();
    stale_ = false;
}

void OsimChoice::guess(Row& row) const {
    if (!preview_ || !row.guessed || row.stand_in)
        return;
    const std::string stem = row.mesh.stem().string();
    if (row.bone || row.origin.empty())
        row.origin = body_like(*preview_, stem);
    if (row.bone)
        return;
    // A line muscle of the same name tells its bodies; else the first two that have a bone, for the user to look at.
    for (const OsimPreview::MuscleRow& muscle : preview_->muscles)
        if (lower(muscle.name).starts_with(lower(stem))) {
            row.origin = muscle.origin;
            row.insertion = muscle.insertion;
            return;
        }
    std::vector<std::string> with_bone;
    for (const OsimPreview::BodyRow& body : preview_->bodies)
        if (body.meshes_found > 0 || std::any_of(rows_.begin(), rows_.end(), [&](const Row& other) {
                return other.bone && other.origin == body.name;
            }))
            with_bone.push_back(body.name);
    row.origin = with_bone.empty() ? std::string() : with_bone[0];
    row.insertion = with_bone.size() < 2 ? std::string() : with_bone[1];
}

bool OsimChoice::poll() {
    const auto finished = [](const std::future<OsimPreview>& f) {
        return f.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    std::erase_if(given_up_, finished);
    bool changed = false;
    if (stale_) {
        read_again();
        changed = true;
    }
    if (!reading_.valid() || !finished(reading_))
        return changed;
    try {
        preview_ = reading_.get();
        for (Row& row : rows_) // bones first: muscles look at them
            if (row.bone)
                guess(row);
        for (Row& row : rows_)
            if (!row.bone)
                guess(row);
    } catch (const std::exception& error) {
        preview_.reset();
        problem_ = error.what();
    }
    return true;
}

void OsimChoice::read_again() {
    stale_ = false;
    problem_.clear();
    if (reading_.valid())
        given_up_.push_back(std::move(reading_));
    if (request_.osim.model.empty())
        return;
    reading_ = std::async(std::launch::async, [model = request_.osim.model, trial = request_.motion] {
        return preview_osim(model, trial);
    });
}

SceneRequest OsimChoice::finished(std::string& why) const {
    why.clear();
    SceneRequest out = request_;
    bool own_bones = false;
    for (const Row& row : rows_) {
        const std::string name = row.stand_in ? row.mesh.string() : row.mesh.filename().string();
        if (row.origin.empty())
            why = "Say which body " + name + " belongs to.";
        own_bones = own_bones || row.bone;
        (row.bone ? out.bones : out.muscles)
            .push_back(row.mesh.string() + "=" + row.origin +
                       (row.bone || row.insertion.empty() || row.insertion == row.origin
                            ? ""
                            : "," + row.insertion));
    }
    if (out.osim.model.empty())
        why = "Choose a model (.osim) first.";
    else if (reading_.valid())
        why = "Files are still being read.";
    else if (!preview_)
        why = "The model or the trial cannot be read.";
    else if (out.motion.empty())
        why = "Choose a trial (.mot, .sto) that moves it.";
    else if (why.empty() && !own_bones &&
             std::all_of(preview_->bodies.begin(), preview_->bodies.end(),
                         [](const OsimPreview::BodyRow& body) { return body.meshes_found == 0; }))
        why = "No mesh of the model was found: add meshes of bones.";
    return out;
}

} // namespace fascicle::editor
