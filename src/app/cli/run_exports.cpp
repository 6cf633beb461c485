#include "app/cli/run_exports.hpp"

#include "app/cli/options.hpp"
#include "app/cli/run_scene.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/io/animation.hpp"
#include "output/data_export.hpp"
#ifdef FASCICLE_HAS_VIEW
#include "app/cli/run_film.hpp"
#endif

#include <algorithm>

namespace fascicle::app {

namespace {

#ifdef FASCICLE_HAS_VIEW
constexpr bool can_draw = true;
#else
constexpr bool can_draw = false;
#endif

/// In the order of help: what has always been there first.
std::vector<std::string> known_keys() {
    std::vector<std::string> keys{"vtp", "csv"};
    if (can_draw)
        keys.emplace_back("png");
    for (const output::ExportKindRow& row : output::export_kinds())
        if (row.in_run != nullptr && (can_draw || !row.traits.draws))
            keys.emplace_back(row.key);
    return keys;
}

std::filesystem::path target_in(const std::filesystem::path& folder, const output::ExportKindRow& row,
                                const Scene& scene) {
    if (*row.in_run != 0)
        return folder / row.in_run;
    return folder / (unique_file_names({scene.name})[0] + row.extension);
}

} // namespace

std::string export_keys() {
    std::string text;
    for (const std::string& key : known_keys())
        text += (text.empty() ? "" : ",") + key;
    return text;
}

void add_export_options(CLI::App& app, ExportOptions& options) {
    add_whole(app, "--morph-targets", options.morph_targets, 1, 1000, "N",
              "Shapes of a .glb beside the first, at most; frames are left out evenly (default: 64)");
    add_choice(app, "--up", options.up, {"z", "y"},
               "Axis that points up, for other programs (default: z, as in LPS)");
}

Exports read_exports(const std::vector<std::string>& lists) {
    Exports exports;
    const std::vector<std::string> known = known_keys();
    for (const std::string& list : lists)
        for (const std::string& word : split(list, ',')) {
            const output::ExportKindRow* row = output::find_export_kind(word);
            if (!can_draw && (word == "png" || (row != nullptr && row->traits.draws)))
                throw_error("--export", "got '" + word + "', and this program was built without drawing",
                            export_keys(), ErrorKind::usage);
            if (std::find(known.begin(), known.end(), word) == known.end())
                throw_error("--export", "got '" + word + "'" + did_you_mean(word, known), export_keys(),
                            ErrorKind::usage);
            exports.vtp = exports.vtp || word == "vtp";
            exports.png = exports.png || word == "png";
            if (row == nullptr ||
                std::find(exports.kinds.begin(), exports.kinds.end(), row) != exports.kinds.end())
                continue;
            if (row->reason_here != nullptr)
                if (const std::string reason = row->reason_here(); !reason.empty())
                    throw_error("--export", "cannot write '" + word + "': " + reason, {}, ErrorKind::usage);
            exports.kinds.push_back(row);
        }
    return exports;
}

std::vector<std::string> write_export(output::ExportRequest request, const RecordingPtr& recording,
                                      ProgressDisplay& progress) {
#ifdef FASCICLE_HAS_VIEW
    if (output::export_kind(request.kind).traits.draws) {
        write_drawn(request, recording, progress);
        return {};
    }
#endif
    request.told = std::make_shared<std::vector<std::string>>();
    JobControl control;
    control.cancel = &watch_interrupts();
    control.report = [&](std::string_view stage, double fraction) {
        progress.update({std::string(stage), fraction, 0, 0}, steady_seconds());
    };
    try {
        output::export_data(request, *recording, control);
    } catch (const Cancelled&) {
        progress.finish();
        throw_error(request.target.string(), "cancelled, nothing was written");
    }
    progress.finish();
    return *request.told;
}

std::vector<std::string> write_exports(const Exports& exports, const ExportOptions& options,
                                       const RecordingPtr& recording, const std::filesystem::path& folder,
                                       int every, int threads, ProgressDisplay& progress) {
    std::vector<std::string> told;
    for (const output::ExportKindRow* row : exports.kinds) {
        output::ExportRequest request;
        request.kind = row->key;
        request.target = target_in(folder, *row, recording->scene());
        request.last = recording->last_frame()->index;
        request.frame = request.last;
        request.step = every;
        request.morph_targets = options.morph_targets;
        request.up = options.up.empty() ? 'z' : options.up[0];
        request.threads = threads;
        for (std::string& sentence : write_export(request, recording, progress))
            told.push_back(std::move(sentence));
    }
    return told;
}

} // namespace fascicle::app
