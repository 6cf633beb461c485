#pragma once
// Runs of this session that are kept for comparing, and those read from folders.

#include "editor/feature.hpp"

#include <filesystem>

namespace fascicle::editor {

struct KeptRun {
    int id = 0; ///< from 1, of this run alone as long as the editor is open
    std::string name;
    std::string time;             ///< of day when it was kept, "14:32"
    std::filesystem::path folder; ///< that it was read from; empty: made here
    RecordingPtr recording;
    bool pinned = false;   ///< stays whatever comes
    std::size_t bytes = 0; ///< of its frames
};

/// Bytes of the positions in a recording's frames; arrays that several frames share count once.
std::size_t frame_bytes(const Recording& recording);

class RunShelf : public Feature {
public:
    RunShelf();
    ~RunShelf() override;

    /// Runs that are kept by themselves; the oldest goes first, pinned ones do not count.
    static constexpr std::size_t kept_runs = 6;
    /// A run that did not end by itself is kept from this many frames on.
    static constexpr int usefully_long = 10;
    /// All runs together, pinned ones included; unpinned ones go before more is used.
    static constexpr std::size_t byte_limit = std::size_t{1} << 30;

    const std::vector<KeptRun>& runs() const { return runs_; } ///< newest first
    /// Null when there is none (any more). Valid until the next change.
    const KeptRun* find(int id) const;
    const KeptRun* find(const RecordingPtr& recording) const;
    std::size_t bytes() const;
    /// Another number after every change of runs().
    int version() const { return version_; }

    void rename(int id, const std::string& name); ///< an empty name changes nothing
    void set_pinned(int id, bool pinned);
    void remove(int id);
    /// These are looked at: they do not go by themselves.
    void hold(std::vector<int> ids) { held_ = std::move(ids); }
    void set_byte_limit(std::size_t limit) { limit_ = limit; }

    /// Reads a run's folder on a thread of its own; it is kept, pinned, when it is there. One at a time: an earlier request
    /// is given up.
    void load(const std::filesystem::path& folder);
    bool loading() const { return job_ != nullptr; }
    double progress() const;
    const std::string& loading_name() const { return loading_name_; }
    void cancel_loading();
    /// Waits for the reader, for tests.
    void finish_loading() const;
    /// Why the last folder could not be read, one line; empty when it could.
    const std::string& problem() const { return problem_; }
    /// Number of the run that was read last, 0 when none was.
    int loaded() const { return loaded_; }

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    struct Job;
    void offer(const RecordingPtr& recording);
    int keep(RecordingPtr recording, std::string name, std::filesystem::path folder, bool pinned);
    void make_room();
    void poll(EditorContext& context);

    std::vector<KeptRun> runs_;
    std::vector<int> held_;
    std::size_t limit_ = byte_limit;
    int last_id_ = 0, loaded_ = 0, version_ = 0;
    RecordingPtr followed_, offered_; ///< the run under way; the last one that was looked at for keeping
    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> given_up_; ///< told to stop, waited for without blocking
    std::string loading_name_, problem_;
};

} // namespace fascicle::editor
