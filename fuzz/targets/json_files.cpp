// Small files in JSON that name no parameters.

#include "fascicle/io/fibre_template_file.hpp"
#include "fascicle/io/recent_projects.hpp"
#include "fascicle/io/settings_file.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>

namespace fascicle::fuzz {
namespace {

void fuzz_fibre_template(std::string_view bytes) {
    FibreTemplate read;
    if (!reads("fuzz.json", [&] { read = parse_fibre_template(bytes, "fuzz.json"); }))
        return;
    FUZZ_CHECK(!read.key.empty() && read.front.size() >= 2);
    for (const double r : {0.0, 0.5, 1.0})
        for (const double s : {0.0, 0.3, 1.0})
            for (const double t : {0.0, 0.5, 1.0}) {
                const Vec3 p = read.point(r, s, t);
                FUZZ_CHECK(p.allFinite() && p.minCoeff() >= -1e-9 && p.maxCoeff() <= 1 + 1e-9);
            }
}

void fuzz_settings(std::string_view bytes) {
    reads("fuzz.json", [&] {
        for (const auto& [key, value] : parse_settings(bytes, "fuzz.json"))
            FUZZ_CHECK(!std::holds_alternative<double>(value) || std::isfinite(std::get<double>(value)));
        std::vector<std::string> bad;
        const auto lists = parse_text_lists(bytes, "fuzz.json", bad);
        for (const std::string& key : bad)
            FUZZ_CHECK(lists.at(key).empty());
    });
}

void fuzz_recent_projects(std::string_view bytes) {
    reads("fuzz.json", [&] {
        const auto projects = parse_recent_projects(bytes, "fuzz.json");
        FUZZ_CHECK(projects.size() <= recent_projects_kept);
        for (const RecentProject& project : projects)
            FUZZ_CHECK(!project.path.empty());
    });
}

} // namespace

std::vector<Target> json_targets() {
    return {
        {"fibre_template", fuzz_fibre_template, 2 * kB, "fibre_template", "fibre_template", 400, MB},
        {"settings", fuzz_settings, 1 * kB, "json", "settings", 400, MB},
        {"recent_projects", fuzz_recent_projects, 1 * kB, "json", "recent_projects", 400, MB},
    };
}

} // namespace fascicle::fuzz
