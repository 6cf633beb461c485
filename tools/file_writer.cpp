// file_writer WHAT RUN FOLDER: writes one of the editor's files into FOLDER, from the run in RUN, as the editor does;
// "file_writer kinds" lists the exports of data. For
// test_faults.py, which lets its writes fail, kills it, and starts two at once.

#include "fascicle/base/error.hpp"
#include "fascicle/io/autosave.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/io/settings_file.hpp"
#ifdef FASCICLE_HAS_VIEW
#include "output/data_export.hpp"
#endif

#include <iostream>

using namespace fascicle;
namespace fs = std::filesystem;

namespace {

PngImage picture() {
    return {8, 8, std::vector<std::uint8_t>(256, 100)};
}

void write(const std::string& what, const fs::path& run, const fs::path& folder) {
    const RunReader reader(run);
    if (what == "project") {
        write_project_file(folder / "my.fascicle", *reader.scene(), ProjectSaving{"", true});
    } else if (what == "settings") {
        write_settings(folder / "settings.json",
                       {{"dark", true}, {"scale", 1.5}, {"name", std::string("a")}});
    } else if (what == "preset") {
        write_preset(folder / "presets" / "mine.json", preset_of(reader.scene()->parameters, "mine"));
    } else if (what == "recent") {
        add_recent_project(folder, {folder / "my.fascicle", "mine", 1}, picture());
    } else if (what == "autosave") {
        AutosaveFolder copies(folder);
        Autosave copy;
        copy.scene = reader.scene();
        copy.picture = picture();
        try {
            for (int k = 0; k < 2; ++k)
                copies.write(copy);
        } catch (const Error&) {
            copies.clear(); // the editor tries again; what it closes with is nothing
            throw;
        }
        copies.clear();
    } else if (what == "cache") {
        DiskCache cache(folder);
        const std::string key(32, 'a'), bytes(20000, 'x');
        cache.keep(key, bytes);
        if (const auto found = cache.find(key); found && *found != bytes)
            throw_error(folder.string(), "the cache gave what nobody put into it");
#ifdef FASCICLE_HAS_VIEW
    } else {
        const RecordingPtr recording = reader.read_recording();
        output::ExportRequest request;
        request.last = recording->last_frame()->index;
        for (const output::ExportKindRow& row : output::export_kinds())
            if (what == row.key && !row.traits.draws) {
                request.kind = row.key;
                request.target = output::with_extension(folder / "export", row.key);
                return output::export_data(request, *recording, {});
            }
        throw_error(what, "is nothing that can be written here");
#endif
    }
}

} // namespace

int main(int argc, char** argv) {
    try {
#ifdef FASCICLE_HAS_VIEW
        if (argc == 2 && std::string(argv[1]) == "kinds") {
            for (const output::ExportKindRow& row : output::export_kinds())
                if (!row.traits.draws)
                    std::cout << row.key << "\n";
            return 0;
        }
#endif
        if (argc != 4)
            throw_error("file_writer", "needs WHAT RUN FOLDER");
        write(argv[1], argv[2], argv[3]);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "fascicle: " << error.what() << "\n";
        return 1;
    }
}
