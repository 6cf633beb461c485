#include "editor/message_log.hpp"

namespace fascicle::editor {

void MessageLog::add(Severity severity, std::string text) {
    ++version_;
    if (severity == Severity::error)
        ++unseen_errors_;
    if (!messages_.empty() && messages_.back().text == text && messages_.back().severity == severity) {
        ++messages_.back().repeats;
        return;
    }
    messages_.push_back({severity, std::move(text)});
    if (messages_.size() > limit)
        messages_.pop_front();
}

void MessageLog::clear() {
    messages_.clear();
    unseen_errors_ = 0;
    ++version_;
}

} // namespace fascicle::editor
