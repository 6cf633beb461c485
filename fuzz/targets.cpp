#include "fuzz/targets.hpp"

#include "fuzz/check.hpp"
#include "fuzz/memory_guard.hpp"
#include "fuzz/target.hpp"

#include <chrono>
#include <ctime>

namespace fascicle::fuzz {
namespace {

constexpr double most_seconds = 10;
constexpr std::size_t kB = 1024, MB = 1024 * kB, packed = 400 * MB;

/// Time of the processor, since on a busy machine the clock's says nothing. Asking for it takes longer than many an input:
/// that is done once a second, so that the time of a long input may be one second too long.
class Stopwatch {
public:
    void start() {
        start_ = Clock::now();
        if (start_ - asked_ < std::chrono::seconds(1))
            return;
        asked_ = start_;
        used_ = std::clock();
    }
    /// 0 when it is not long.
    double seconds() const {
        return Clock::now() - start_ < std::chrono::seconds(1)
                   ? 0
                   : double(std::clock() - used_) / CLOCKS_PER_SEC;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_, asked_;
    std::clock_t used_ = 0;
};

Stopwatch& stopwatch() {
    static Stopwatch watch;
    return watch;
}

std::vector<Target> make_targets() {
    std::vector<Target> rows;
    for (const MeshFormat& format : mesh_formats()) {
        const std::string name = "mesh_" + format.extensions.at(0).substr(1);
        const auto run = [&format](std::string_view bytes) { fuzz_mesh_format(format, bytes); };
        // Packed data of VTP: a file of any size is trusted with 4 million numbers.
        const std::size_t base = name == "mesh_vtp" || name == "mesh_glb" ? packed : MB;
        rows.push_back({name, run, 4 * kB, name, name, 400, base});
    }
    // name, function, max length, dictionary, seeds, memory: times the size, plus
    const std::vector<Target> others{
        {"mesh_any", fuzz_mesh_any, 4 * kB, "", "mesh_any", 400, packed},
        {"area_mesh", fuzz_area_mesh, 4 * kB, "mesh_vtp", "area_mesh", 400, packed},
        // glTF may say much with little: up to a million points and numbers are trusted to any file.
        {"animation_glb", fuzz_glb, 4 * kB, "mesh_glb", "animation_glb", 400, packed},
        {"animation_usda", fuzz_usda, 4 * kB, "mesh_usda", "mesh_usda", 400, MB},
        {"point_cache", fuzz_point_cache, 512, "point_cache", "point_cache", 100, MB},
        {"series", fuzz_series, 1 * kB, "series", "series", 400, MB},
        {"xml", fuzz_xml, 2 * kB, "xml", "xml", 100, MB},
        {"csv", fuzz_csv, 1 * kB, "csv", "csv", 400, MB},
        {"motion_csv", fuzz_motion_csv, 2 * kB, "motion_csv", "motion_csv", 400, MB},
        {"attachment_csv", fuzz_attachment_csv, 2 * kB, "attachment_csv", "attachment_csv", 400, MB},
        {"attachment_areas", fuzz_attachment_areas, 2 * kB, "attachment_csv", "attachment_csv", 400, 4 * MB},
        {"osim", fuzz_osim, 8 * kB, "osim", "osim", 400, 4 * MB},
        {"storage", fuzz_storage, 2 * kB, "storage", "storage", 400, 4 * MB},
        {"fibre_template", fuzz_fibre_template, 2 * kB, "fibre_template", "fibre_template", 400, MB},
        {"preset", fuzz_preset, 2 * kB, "preset", "preset", 400, MB},
        {"lesson", fuzz_lesson, 4 * kB, "lesson", "lesson", 400, MB},
        {"settings", fuzz_settings, 1 * kB, "json", "settings", 400, MB},
        {"recent_projects", fuzz_recent_projects, 1 * kB, "json", "recent_projects", 400, MB},
        {"project", fuzz_project, 8 * kB, "project", "project", 400, 4 * MB},
        {"run_folder", fuzz_run_folder, 8 * kB, "run_folder", "run_folder", 400, packed},
        {"mesh_codec", fuzz_mesh_codec, 1 * kB, "mesh_codec", "mesh_codec", 400, MB},
        {"base64", fuzz_base64, 256, "", "base64", 100, MB},
        {"grid", fuzz_grid, 2 * kB, "", "grid", 400, MB},
        {"cache_entry", fuzz_cache_entry, 256, "", "cache_entry", 100, MB},
        // Deflate packs up to 1032 bytes into one, and a pixel of one bit becomes four bytes.
        {"png", fuzz_png, 1 * kB, "png", "png", 2 * 32 * 1032 * 8, MB},
        {"command_line", fuzz_command_line, 512, "command_line", "command_line", 4000, 4 * MB},
        {"options", fuzz_options, 128, "options", "options", 1000, MB},
        {"parameters", fuzz_parameters, 256, "parameters", "parameters", 1000, MB},
    };
    rows.insert(rows.end(), others.begin(), others.end());
    return rows;
}

} // namespace

const std::vector<Target>& targets() {
    static const std::vector<Target> rows = make_targets();
    return rows;
}

const Target* find_target(std::string_view name) {
    for (const Target& target : targets())
        if (target.name == name)
            return &target;
    return nullptr;
}

std::size_t run_guarded(const Target& target, std::string_view bytes) {
    reset_peak_memory();
    const std::size_t before = live_memory();
    Stopwatch& watch = stopwatch();
    watch.start();
    target.run(bytes);
    if (const double seconds = watch.seconds(); seconds > most_seconds)
        failed("an input takes seconds at most", __FILE__, __LINE__, std::to_string(seconds) + " s");
    const std::size_t most = peak_memory() - before;
    if (const std::size_t allowed = target.memory_base + target.memory_per_byte * bytes.size();
        most > allowed)
        failed("memory stays within a small multiple of the file", __FILE__, __LINE__,
               std::to_string(most) + " bytes, allowed are " + std::to_string(allowed));
    return most;
}

} // namespace fascicle::fuzz
