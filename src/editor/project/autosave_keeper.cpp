#include "editor/project/autosave_keeper.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "editor/project/thumbnail.hpp"

#include <algorithm>
#include <chrono>

namespace fascicle::editor {

AutosaveKeeper::~AutosaveKeeper() = default; // the future waits

void AutosaveKeeper::restored(std::filesystem::path folder) {
    if (writing_.valid()) { // a copy of what was open before says nothing of what was restored
        writing_.wait();
        writing_ = {};
    }
    restored_ = std::move(folder);
}

void AutosaveKeeper::finish() {
    if (writing_.valid())
        writing_.wait();
}

void AutosaveKeeper::close(bool nothing_lost) {
    finish();
    if (nothing_lost)
        forget_copies();
}

void AutosaveKeeper::forget_restored() {
    if (!restored_.empty())
        remove_autosaves({restored_, {}, {}, {}, {}, 0, 0});
    restored_.clear();
}

void AutosaveKeeper::forget_copies() {
    forget_restored();
    if (folder_ != nullptr)
        folder_->clear();
    has_copies_ = false;
}

void AutosaveKeeper::ask_about_crashes(EditorContext& context) {
    asked_ = true;
    if (std::vector<AutosaveSession> left = crashed_sessions(context.user_folder); !left.empty())
        context.dialogs.recovery.ask(std::move(left));
}

void AutosaveKeeper::update(EditorContext& context) {
    now_ = context.now;
    if (context.user_folder.empty())
        return;
    if (!asked_)
        ask_about_crashes(context);
    poll(context);
    const Document& work = user_document(context);
    const ScenePtr head = work.head();
    if (!work.dirty()) { // saved, or another one in its place
        safe_ = head;
        changed_at_.reset();
        if ((has_copies_ || !restored_.empty()) && !writing_.valid())
            forget_copies();
        return;
    }
    if (head == safe_) {
        changed_at_.reset();
        return;
    }
    if (!changed_at_)
        changed_at_ =
            !restored_.empty() ? now_ - interval : now_; // what was restored gets a copy of its own at once
    if (!writing_.valid() && now_ - *changed_at_ >= interval)
        start(context);
}

void AutosaveKeeper::start(EditorContext& context) {
    if (folder_ == nullptr)
        folder_ = std::make_unique<AutosaveFolder>(context.user_folder);
    const Document& work = user_document(context);
    Autosave copy{work.head(), work.path(), context.features.project.user_saving(), std::nullopt};
    if (&work == &context.document)
        copy.picture = take_thumbnail(context);
    safe_ = copy.scene;
    changed_at_.reset();
    has_copies_ = true;
    writing_ = std::async(std::launch::async,
                          [folder = folder_.get(), copy = std::move(copy)] { folder->write(copy); });
}

void AutosaveKeeper::poll(EditorContext& context) {
    if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    try {
        writing_.get();
        forget_restored();
    } catch (const std::exception& problem) { // tried again after the next interval
        safe_ = nullptr;
        changed_at_ = now_;
        context.log.add(Severity::warning,
                        std::string("No copy of unsaved work was kept: ") + problem.what());
    }
}

std::optional<double> AutosaveKeeper::redraw_after() const {
    if (writing_.valid())
        return 0.1;
    return changed_at_ ? std::optional<double>(std::max(0.0, *changed_at_ + interval - now_)) : std::nullopt;
}

} // namespace fascicle::editor
