#pragma once
// What the program tells the user: sentences with a weight, newest last.

#include <cstdint>
#include <deque>
#include <string>

namespace fascicle::editor {

enum class Severity { note, warning, error };

struct Message {
    Severity severity = Severity::note;
    std::string text;
    int repeats = 1; ///< the same sentence in a row is one entry
};

class MessageLog {
public:
    static constexpr std::size_t limit = 500; ///< the oldest go

    void add(Severity severity, std::string text);
    void clear();
    const std::deque<Message>& messages() const { return messages_; }
    /// The latest, or null.
    const Message* latest() const { return messages_.empty() ? nullptr : &messages_.back(); }
    std::uint64_t version() const { return version_; } ///< differs after every change
    int unseen_errors() const { return unseen_errors_; }
    void mark_seen() { unseen_errors_ = 0; }

private:
    std::deque<Message> messages_;
    std::uint64_t version_ = 0;
    int unseen_errors_ = 0;
};

} // namespace fascicle::editor
