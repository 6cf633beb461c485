#include "bench/bench_cases.hpp"

#include <cstdlib>

namespace fascicle::bench {

namespace {

namespace fs = std::filesystem;

/// One muscle of the right hip between pelvis and femur; the femur flexes by 1 rad about the centre of its head and comes
/// back.
BenchCase hip_muscle(const std::string& name, const std::optional<fs::path>& data) {
    BenchCase result;
    result.name = name;
    if (!data) {
        result.missing = "no real data: give --data DIR or set FASCICLE_DATA";
        return result;
    }
    const fs::path folder = *data / "lhdl";
    SceneRequest& request = result.request;
    request.muscles = {folder / (name + ".vtk")};
    request.bones = {folder / "pelvis.obj"};
    request.moving_bones = {folder / "femur.vtk"};
    request.attachments = {{name, folder / (name + "_attachments.csv")}};
    request.hinge = HingeRequest{Vec3(143.86, 243.37, -432.53), Vec3::UnitX()};
    request.angle_deg = -57.29578;
    for (const fs::path& file :
         {request.muscles[0], request.bones[0], request.moving_bones[0], request.attachments[0].second})
        if (std::error_code error; result.missing.empty() && !fs::exists(file, error))
            result.missing = file.string() + ": no such file";
    return result;
}

BenchCase embedded(const std::string& name) {
    BenchCase result;
    result.name = name;
    result.request.embedded = name;
    return result;
}

} // namespace

std::vector<BenchCase> bench_cases(const std::optional<fs::path>& data) {
    std::vector<BenchCase> cases{hip_muscle("gluteus_maximus", data), hip_muscle("iliacus", data),
                                 embedded("squish-box"), embedded("hip")};
    cases.front().published = true;
    return cases;
}

std::optional<fs::path> default_data_folder() {
    std::error_code error;
    if (const char* set = std::getenv("FASCICLE_DATA"); set != nullptr && fs::is_directory(set, error))
        return fs::path(set);
    const fs::path beside = fs::path("..") / "shared" / "data";
    if (fs::is_directory(beside, error))
        return beside;
    return std::nullopt;
}

} // namespace fascicle::bench
