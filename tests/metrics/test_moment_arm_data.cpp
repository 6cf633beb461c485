// Moment arms against those that OpenSim printed for a line model of the hip.

#include "fascicle/io/files.hpp"
#include "fascicle/metrics/moment_arm.hpp"
#include "support/data_dir.hpp"
#include "support/fibres.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

using namespace fascicle;
using namespace fascicle::test;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// What stands between <tag> and </tag>, from `from` on.
std::string element(const std::string& text, const std::string& tag, std::size_t from) {
    const std::size_t begin = text.find("<" + tag + ">", from);
    REQUIRE(begin != std::string::npos);
    const std::size_t start = begin + tag.size() + 2;
    return text.substr(start, text.find("</" + tag + ">", start) - start);
}

Vec3 vector_of(const std::string& text) {
    std::istringstream words(text);
    Vec3 v = Vec3::Constant(std::nan(""));
    words >> v.x() >> v.y() >> v.z();
    REQUIRE(v.allFinite());
    return v;
}

/// Body-fixed turns about x, y, z.
Mat3 turned(const Vec3& angles) {
    return (Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
            Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()))
        .toRotationMatrix();
}

struct PathPoint {
    Vec3 place;
    bool on_femur = false;
};

/// Points of a muscle in the model, all of them plain.
std::vector<PathPoint> path_of(const std::string& model, const std::string& muscle) {
    const std::size_t begin = model.find("<Thelen2003Muscle name=\"" + muscle + "\">");
    REQUIRE(begin != std::string::npos);
    const std::size_t end = model.find("</PathPointSet>", begin);
    std::vector<PathPoint> points;
    for (std::size_t at = model.find("<PathPoint name", begin); at < end;
         at = model.find("<PathPoint name", at + 1))
        points.push_back(
            {vector_of(element(model, "location", at)), element(model, "body", at) == "femur_r"});
    return points;
}

/// Columns of OpenSim's table by name.
std::map<std::string, std::vector<double>> table_of(const std::string& text) {
    std::istringstream lines(text.substr(text.find("endheader") + 10));
    std::string line, word;
    std::getline(lines, line);
    std::vector<std::string> names;
    for (std::istringstream words(line); words >> word;)
        names.push_back(word);
    std::map<std::string, std::vector<double>> table;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        double value = 0.0;
        for (const std::string& name : names)
            if (words >> value)
                table[name].push_back(value);
    }
    return table;
}

} // namespace

TEST_CASE("real data: moment arms of lines are those of OpenSim", "[metrics][moment_arm]") {
    FASCICLE_NEED_DATA(data);
    const std::string model = read_file(data / "lhdl/LHDL_hip_r.osim");
    auto table = table_of(read_file(data / "lhdl/LHDL_hip_flexion_moment_arms.mot"));
    const std::size_t joint = model.find("<CustomJoint name=\"hip_r\">");
    REQUIRE(joint != std::string::npos);
    const Vec3 centre = vector_of(element(model, "location_in_parent", joint));
    const Vec3 femur_centre = vector_of(element(model, "location", joint));
    const Mat3 to_pelvis = turned(vector_of(element(model, "orientation_in_parent", joint)));
    const Mat3 to_femur = turned(vector_of(element(model, "orientation", joint)));
    const Hinge hinge{centre, to_pelvis.col(2)}; // flexion is positive about this axis

    std::vector<double> angles;
    for (const double a : table["hip_flexion_r"])
        angles.push_back(a * degree);
    REQUIRE(angles.size() == 100);
    CHECK(flexion_sign(angles) == 1.0);
    for (const std::string muscle :
         {"glut_max1_r", "glut_max2_r", "glut_max3_r", "glut_med1_r", "glut_med3_r"}) {
        INFO(muscle);
        const std::vector<PathPoint> path = path_of(model, muscle);
        REQUIRE(path.size() >= 2);
        std::vector<double> lengths, lines;
        for (const double angle : angles) {
            const Mat3 turn = to_pelvis * Eigen::AngleAxisd(angle, Vec3::UnitZ()) * to_femur.transpose();
            Points points;
            std::size_t crossing = 0; // points up to the first on the femur: the segment that spans the joint
            for (const PathPoint& p : path) {
                points.push_back(p.on_femur ? Vec3(centre + turn * (p.place - femur_centre)) : p.place);
                if (p.on_femur && crossing == 0)
                    crossing = points.size();
            }
            const FibreSet fibre = one_fibre(points);
            lengths.push_back(fibre_lengths(fibre)[0]);
            lines.push_back(line_arm(fibre.fibre(0).first(crossing), FibreEnd::insertion, hinge, 1.0));
        }
        const std::vector<double>& printed = table[muscle];
        const std::vector<double> fit = excursion_arms(angles, lengths, 1, 1.0),
                                  local = excursion_arms(angles, lengths, 1, 1.0,
                                                         {ArmMethod::central_difference});
        double line_error = 0, fit_error = 0, local_error = 0;
        for (std::size_t k = 0; k < angles.size(); ++k) {
            line_error = std::max(line_error, std::abs(lines[k] - printed[k]));
            fit_error = std::max(fit_error, std::abs(fit[k] - printed[k]));
            local_error = std::max(local_error, std::abs(local[k] - printed[k]));
        }
        CAPTURE(line_error, fit_error, local_error);
        CHECK(line_error < 1e-8); // metres, printed with 8 decimals
        CHECK(local_error < 1e-4);
        CHECK(fit_error < 4e-3); // a fourth-order fit over 100 degrees is off by this at the range's ends
    }
}
