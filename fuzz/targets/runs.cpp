// Folders of runs. The input is all files of one, each after a line "@ path".

#include "fascicle/io/run_reader.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <map>

namespace fascicle::fuzz {
namespace {

constexpr std::string_view mark = "@ ";
constexpr const char* folder = "fuzz";

std::map<std::string, std::string_view> files_of(std::string_view bytes) {
    std::map<std::string, std::string_view> files;
    std::string_view name;
    while (!bytes.empty()) {
        std::size_t end = 0; // of the part without a mark
        while (end < bytes.size() && !bytes.substr(end).starts_with(mark))
            end = std::min(bytes.find('\n', end), bytes.size() - 1) + 1;
        if (!name.empty())
            files[std::string(folder) + "/" + std::string(name)] = bytes.substr(0, end);
        bytes.remove_prefix(end);
        if (bytes.empty())
            break;
        const std::size_t line = std::min(bytes.find('\n'), bytes.size());
        name = bytes.substr(mark.size(), line - mark.size());
        bytes.remove_prefix(std::min(line + 1, bytes.size()));
    }
    return files;
}

void fuzz_run_folder(std::string_view bytes) {
    const std::map<std::string, std::string_view> files = files_of(bytes);
    const RunFiles source{[&](const std::filesystem::path& path) {
                              const auto found = files.find(path.string());
                              if (found == files.end())
                                  throw_error(path.string(), "cannot read: no such file");
                              return std::string(found->second);
                          },
                          [&](const std::filesystem::path& path) { return files.count(path.string()) > 0; }};
    reads(folder, [&] {
        const RunReader reader(folder, source);
        const Scene& scene = *reader.scene();
        FUZZ_CHECK(!reader.frames().empty() && reader.frames().front() == 0);
        FUZZ_CHECK(reader.attachments().size() == scene.muscles.size());
        for (std::size_t m = 0; m < scene.muscles.size(); ++m)
            for (const Attachment& a : reader.attachments()[m]) {
                FUZZ_CHECK(a.bone >= -1 && a.bone < static_cast<int>(scene.bones.size()));
                for (const int v : a.vertices)
                    FUZZ_CHECK(v >= 0 && v < scene.muscles[m].mesh->vertex_count());
            }
        const RecordingPtr run = reader.read_recording();
        FUZZ_CHECK(run->frame_count() == static_cast<int>(reader.frames().size()));
        for (int k = 0; k < run->frame_count(); ++k) {
            const FramePtr frame = run->frame(k);
            FUZZ_CHECK(std::isfinite(frame->angle_rad) && frame->bone_poses.size() == scene.bones.size());
            for (const PointsPtr& points : frame->muscle_positions)
                for (const Vec3& p : *points)
                    FUZZ_CHECK(p.allFinite());
        }
    });
}

} // namespace

std::vector<Target> run_targets() {
    return {
        {"run_folder", fuzz_run_folder, 8 * kB, "run_folder", "run_folder", 400,
         400 * MB}, // packed data of VTP
    };
}

} // namespace fascicle::fuzz
