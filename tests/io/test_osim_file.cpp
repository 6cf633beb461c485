// Models of a few lines, in the spelling of OpenSim 3 and of OpenSim 4, and what is wrong with others.

#include "fascicle/anatomy/line_path.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/osim_file.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

constexpr double pi = std::numbers::pi;

/// Joints (and more) and muscles of a model of OpenSim 4 with the bodies `thigh` and `shank`.
std::string model4(const std::string& joints, const std::string& forces = {}, const std::string& more = {},
                   const std::string& thigh = {}) {
    return "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n<Model name=\"m\">\n"
           "<Ground name=\"ground\"/>\n<BodySet name=\"bodyset\"><objects>\n<Body "
           "name=\"thigh\"><mass>2</mass>" +
           thigh +
           "</Body>\n<Body name=\"shank\"/>\n</objects></BodySet>\n<JointSet name=\"jointset\"><objects>\n" +
           joints + "\n</objects></JointSet>\n<ForceSet><objects>\n" + forces + "\n</objects></ForceSet>\n" +
           more + "\n</Model>\n</OpenSimDocument>\n";
}

std::string joint4(const std::string& type, const std::string& name, const std::string& parent,
                   const std::string& child, const std::string& inside = {}) {
    return "<" + type + " name=\"" + name + "\"><socket_parent_frame>" + parent + "</socket_parent_frame>" +
           "<socket_child_frame>" + child + "</socket_child_frame>" + inside + "</" + type + ">";
}

std::string coordinate(const std::string& name, const std::string& inside = {}) {
    return "<Coordinate name=\"" + name + "\">" + inside + "</Coordinate>";
}

const std::string two_pins = joint4("PinJoint", "hip", "/ground", "/bodyset/thigh",
                                    "<coordinates>" + coordinate("hip_q") + "</coordinates>") +
                             joint4("PinJoint", "knee", "thigh_offset", "../../bodyset/shank",
                                    "<coordinates>" + coordinate("knee_q") +
                                        "</coordinates><frames><PhysicalOffsetFrame "
                                        "name=\"thigh_offset\"><socket_parent>/bodyset/thigh</socket_parent>"
                                        "<translation>0 -0.4 0</translation><orientation>0 0 "
                                        "0</orientation></PhysicalOffsetFrame></frames>");

std::string point4(const std::string& body, const std::string& at, const std::string& type = "PathPoint",
                   const std::string& inside = {}) {
    return "<" + type + " name=\"p\"><socket_parent_frame>" + body + "</socket_parent_frame><location>" + at +
           "</location>" + inside + "</" + type + ">";
}

std::string muscle4(const std::string& points, const std::string& wraps = {}) {
    return "<Thelen2003Muscle name=\"m1\"><GeometryPath name=\"path\"><PathPointSet><objects>" + points +
           "</objects></PathPointSet><PathWrapSet><objects>" + wraps +
           "</objects></PathWrapSet></GeometryPath><max_isometric_force>500</max_isometric_force></"
           "Thelen2003Muscle>";
}

const std::string straight = point4("/ground", "0.1 0 0") + point4("/bodyset/shank", "0 -0.1 0");

std::vector<Pose> poses_of(const OsimModel& file, const std::vector<double>& q) {
    std::vector<Pose> poses;
    place_bodies(file.model.skeleton, q, poses);
    return poses;
}

void fails(const std::string& text, const std::string& part) {
    INFO(part);
    CHECK_THROWS_WITH(read_osim(text, "bad.osim"), Catch::Contains("bad.osim") && Catch::Contains(part));
}

} // namespace

TEST_CASE("osim 4: frames, hinges, a muscle and its numbers", "[io][osim]") {
    const OsimModel file = read_osim(model4(two_pins, muscle4(straight)), "m.osim");
    CHECK(file.version == 40000);
    CHECK(file.notes.empty());
    const Skeleton& s = file.model.skeleton;
    REQUIRE(s.bodies.size() == 3);
    CHECK(s.bodies[1].mass_kg == 2);
    REQUIRE(s.joints.size() == 2);
    CHECK(s.joints[1].parent == 1);
    CHECK(s.joints[1].parent_frame.translation == Vec3(0, -0.4, 0));
    CHECK((poses_of(file, {pi / 2, -pi / 2})[2].apply(Vec3(0, -0.1, 0)) - Vec3(0.4, -0.1, 0)).norm() < 1e-12);
    REQUIRE(file.model.muscles.size() == 1);
    CHECK(file.model.muscles[0].max_isometric_force_n == 500);
    LinePathSolver solver(file.model);
    Posture posture;
    set_posture(s, s.default_values(), posture);
    CHECK(solver.solve(0, posture).length == Approx(std::hypot(0.1, 0.5)));
}

TEST_CASE("osim: every plain joint moves as it should", "[io][osim]") {
    const auto moved = [](const std::string& type, const std::vector<double>& q, const Vec3& x) {
        std::string coordinates;
        for (std::size_t i = 0; i < q.size(); ++i)
            coordinates += coordinate("q" + std::to_string(i));
        const OsimModel file = read_osim(
            model4(joint4(type, "j", "ground", "thigh", "<coordinates>" + coordinates + "</coordinates>") +
                   joint4("WeldJoint", "w", "thigh", "shank")),
            "m.osim");
        REQUIRE(file.model.skeleton.coordinates.size() == q.size());
        return Vec3(poses_of(file, q)[2].apply(x));
    };
    const auto near = [](const Vec3& a, const Vec3& b) {
        INFO(a.transpose() << " | " << b.transpose());
        CHECK((a - b).norm() < 1e-12);
    };
    near(moved("PinJoint", {pi / 2}, Vec3(1, 0, 0)), Vec3(0, 1, 0));
    near(moved("SliderJoint", {2}, Vec3(1, 0, 0)), Vec3(3, 0, 0));
    near(moved("UniversalJoint", {pi / 2, pi / 2}, Vec3(1, 0, 0)), Vec3(0, 1, 0));
    near(moved("BallJoint", {pi / 2, pi / 2, pi / 2}, Vec3(1, 0, 0)), Vec3(0, 0, 1));
    near(moved("GimbalJoint", {0, pi / 2, 0}, Vec3(0, 0, 1)), Vec3(1, 0, 0));
    near(moved("PlanarJoint", {pi / 2, 1, 2}, Vec3(1, 0, 0)), Vec3(1, 3, 0));
    near(moved("FreeJoint", {0, 0, pi / 2, 1, 2, 3}, Vec3(1, 0, 0)), Vec3(1, 3, 3));
    near(moved("WeldJoint", {}, Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

TEST_CASE("osim 4: a custom joint with functions of every kind, and a coupler", "[io][osim]") {
    const std::string axes =
        "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>a</coordinates><axis>0 0 2</axis>"
        "<LinearFunction name=\"function\"><coefficients>2 "
        "0.1</coefficients></LinearFunction></TransformAxis>"
        "<TransformAxis name=\"translation1\"><coordinates>a</coordinates><axis>1 0 0</axis>"
        "<SimmSpline name=\"function\"><x>-1 0 1</x><y>1 0 1</y></SimmSpline></TransformAxis>"
        "<TransformAxis name=\"translation2\"><coordinates>a b</coordinates><axis>0 1 0</axis>"
        "<LinearFunction name=\"function\"><coefficients>1 10 "
        "100</coefficients></LinearFunction></TransformAxis>"
        "<TransformAxis name=\"translation3\"><coordinates>b</coordinates><axis>0 0 "
        "1</axis><function><MultiplierFunction>"
        "<function><PiecewiseLinearFunction><x>0 1</x><y>0 "
        "1</y></PiecewiseLinearFunction></function><scale>3</scale>"
        "</MultiplierFunction></function></TransformAxis></SpatialTransform>";
    const std::string coupler =
        "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"c\">"
        "<coupled_coordinates_function><PolynomialFunction><coefficients>1 0 0</coefficients>"
        "</PolynomialFunction></coupled_coordinates_function>"
        "<independent_coordinate_names>a</independent_coordinate_names>"
        "<dependent_coordinate_name>b</dependent_coordinate_name><scale_factor>0.5</scale_factor>"
        "</CoordinateCouplerConstraint><PointConstraint name=\"d\"/></objects></ConstraintSet>";
    const OsimModel file =
        read_osim(model4(joint4("CustomJoint", "j", "/ground", "thigh",
                                "<coordinates>" +
                                    coordinate("a", "<default_value>0.4</default_value><locked>true</locked>"
                                                    "<range>-1 2</range>") +
                                    coordinate("b") + "</coordinates>" + axes) +
                             joint4("WeldJoint", "w", "thigh", "shank"),
                         {}, coupler),
                  "m.osim");
    const Skeleton& s = file.model.skeleton;
    CHECK(s.coordinates[0].locked);
    CHECK(s.coordinates[0].range_max == 2);
    CHECK(s.coordinates[0].kind == CoordinateKind::rotational);
    CHECK(s.coordinates[1].kind == CoordinateKind::translational);
    const std::vector<double> q = s.default_values();
    CHECK(q[1] == Approx(0.08)); // half the square
    const Pose pose = poses_of(file, q)[1];
    CHECK((pose.translation - Vec3(0.16, 0.4 + 0.8 + 100, 0.24)).norm() < 1e-12);
    CHECK((pose.rotation * Vec3::UnitX() - Vec3(std::cos(0.9), std::sin(0.9), 0)).norm() < 1e-12);
    REQUIRE(file.notes.size() == 1);
    CHECK(file.notes[0].find("PointConstraint") != std::string::npos);
}

TEST_CASE("osim 3: joints inside of bodies, meshes, wraps, defaults", "[io][osim]") {
    const OsimModel file = read_osim(
        "<OpenSimDocument Version=\"30000\"><Model name=\"old\"><defaults><Thelen2003Muscle name=\"default\">"
        "<optimal_fiber_length>0.07</optimal_fiber_length></Thelen2003Muscle></defaults><BodySet><objects>"
        "<Body name=\"ground\"><Joint/></Body><Body name=\"arm\"><Joint><PinJoint "
        "name=\"j\"><parent_body>ground</parent_body>"
        "<location_in_parent>0 1 0</location_in_parent><orientation_in_parent>0 0 "
        "1.5707963267948966</orientation_in_parent>"
        "<location>0 0.2 0</location><orientation>0 0 0</orientation><CoordinateSet><objects><Coordinate "
        "name=\"q\">"
        "<motion_type>rotational</motion_type></Coordinate></objects></CoordinateSet><reverse>false</"
        "reverse></PinJoint></Joint>"
        "<VisibleObject><GeometrySet><objects><DisplayGeometry><geometry_file>.\\geo\\arm.vtp</geometry_file>"
        "<scale_factors>2 2 2</scale_factors><transform>0 0 0 1 2 "
        "3</transform></DisplayGeometry></objects></GeometrySet>"
        "<scale_factors>0.5 1 1</scale_factors></VisibleObject><WrapObjectSet><objects><WrapCylinder "
        "name=\"w\">"
        "<radius>0.03</radius><length>0.2</length><xyz_body_rotation>0 0 0</xyz_body_rotation><translation>0 "
        "0.2 0</translation>"
        "<quadrant>-y</quadrant><active>true</active></WrapCylinder><WrapTorus "
        "name=\"t\"/></objects></WrapObjectSet></Body>"
        "</objects></BodySet><ForceSet><objects><Thelen2003Muscle "
        "name=\"m\"><GeometryPath><PathPointSet><objects>"
        "<PathPoint name=\"a\"><location>0 2 0</location><body>ground</body></PathPoint>"
        "<ConditionalPathPoint name=\"b\"><location>0 1.5 0</location><body>ground</body><range>-1 "
        "0.5</range>"
        "<coordinate>q</coordinate></ConditionalPathPoint>"
        "<MovingPathPoint name=\"c\"><body>arm</body><x_location><SimmSpline><x>0 1</x><y>0 "
        "1</y></SimmSpline></x_location>"
        "<y_location><Constant><value>0.5</value></Constant></y_location><z_location><Constant/></z_location>"
        "<x_coordinate>q</x_coordinate><y_coordinate>q</y_coordinate><z_coordinate>q</z_coordinate></"
        "MovingPathPoint>"
        "</objects></PathPointSet><PathWrapSet><objects><PathWrap name=\"x\"><wrap_object>w</wrap_object>"
        "<method>hybrid</method><range>1 -1</range></PathWrap><PathWrap "
        "name=\"y\"><wrap_object>t</wrap_object></PathWrap>"
        "</objects></PathWrapSet></GeometryPath></Thelen2003Muscle><CoordinateLimitForce "
        "name=\"k\"/></objects></ForceSet>"
        "</Model></OpenSimDocument>",
        "old.osim");
    const Skeleton& s = file.model.skeleton;
    REQUIRE(s.bodies.size() == 2);
    REQUIRE(s.bodies[1].meshes.size() == 1);
    CHECK(s.bodies[1].meshes[0].file == "./geo/arm.vtp");
    CHECK(s.bodies[1].meshes[0].scale == Vec3(1, 2, 2));
    CHECK(s.bodies[1].meshes[0].pose.translation == Vec3(1, 2, 3));
    // The arm's point (0, 0.2, 0) is the hinge, at (0, 1, 0); turned a quarter, 0.2 up is to the left.
    CHECK((poses_of(file, {0})[1].apply(Vec3(0, 0.4, 0)) - Vec3(-0.2, 1, 0)).norm() < 1e-12);
    const LineMuscle& m = file.model.muscles.at(0);
    CHECK(m.optimal_fibre_length_m == 0.07);
    REQUIRE(m.points.size() == 3);
    CHECK(m.points[1].kind == PathPointKind::conditional);
    CHECK(m.points[2].kind == PathPointKind::moving);
    REQUIRE(m.wraps.size() == 1); // not the torus
    CHECK(m.wraps[0].last == 2);
    const WrapObject& w = file.model.wrap_objects.at(0);
    CHECK(w.surface.side_axis == 1);
    CHECK(w.surface.side_sign == -1);
    CHECK(w.body == 1);
    REQUIRE(file.notes.size() == 2);
    CHECK(file.notes[0].find("torus") != std::string::npos);
    CHECK(file.notes[1].find("CoordinateLimitForce") != std::string::npos);
}

TEST_CASE("osim: values that are wrong are told with their line", "[io][osim]") {
    const auto with_muscle = [](const std::string& points, const std::string& wraps = {}) {
        return model4(two_pins, muscle4(points, wraps), {},
                      "<WrapObjectSet><objects><WrapSphere "
                      "name=\"s\"><radius>0.1</radius></WrapSphere></objects></WrapObjectSet>");
    };
    CHECK(
        read_osim(with_muscle(straight, "<PathWrap name=\"w\"><wrap_object>s</wrap_object></PathWrap>"), "x")
            .model.muscles[0]
            .wraps.size() == 1);
    fails(with_muscle(point4("/ground", "0 0 0")), "1 points that are always there");
    fails(with_muscle(point4("/bodyset/foot", "0 0 0") + straight),
          "line 13: there is no body or frame '/bodyset/foot'");
    fails(with_muscle(point4("/ground", "0 0") + straight), "location holds 2 numbers; expected 3");
    fails(with_muscle(point4("/ground", "0 zero 0") + straight), "'zero'");
    fails(with_muscle(point4("/ground", "0 nan 0") + straight), "'nan'");
    fails(with_muscle(point4("/ground", "0 0 0", "GhostPathPoint") + straight), "'GhostPathPoint'");
    fails(with_muscle(point4("/ground", "0 0 0", "ConditionalPathPoint", "<coordinate>hip_p</coordinate>") +
                      straight),
          "there is no coordinate 'hip_p'; did you mean 'hip_q'?");
    fails(with_muscle(straight, "<PathWrap name=\"w\"><wrap_object>r</wrap_object></PathWrap>"),
          "no wrap object 'r'");
    fails(with_muscle(straight,
                      "<PathWrap name=\"w\"><wrap_object>s</wrap_object><range>1 9</range></PathWrap>"),
          "range");
    const auto with_wrap = [](const std::string& wrap) {
        return model4(two_pins, {}, {}, "<WrapObjectSet><objects>" + wrap + "</objects></WrapObjectSet>");
    };
    fails(with_wrap("<WrapSphere name=\"s\"><radius>-1</radius></WrapSphere>"),
          "line 6: wrap object 's' has a bad size");
    fails(with_wrap("<WrapEllipsoid name=\"s\"><dimensions>1 0 1</dimensions></WrapEllipsoid>"), "bad size");
    fails(with_wrap("<WrapSphere name=\"s\"><radius>1</radius><quadrant>up</quadrant></WrapSphere>"),
          "quadrant is 'up'");
    fails(model4(joint4("ScrewJoint", "j", "ground", "thigh")), "'ScrewJoint'; expected one of CustomJoint");
    fails(model4(joint4("PinJoint", "j", "ground", "thigh",
                        "<coordinates>" + coordinate("a") + coordinate("b") + "</coordinates>")),
          "2 coordinates; expected 1");
    fails(model4(joint4("PinJoint", "j", "ground", "thigh") + joint4("PinJoint", "k", "thigh", "ground")),
          "loop");
    fails(model4(joint4("CustomJoint", "j", "ground", "thigh")), "no SpatialTransform");
    const auto with_axis = [](const std::string& axis) {
        return model4(joint4("CustomJoint", "j", "ground", "thigh",
                             "<coordinates>" + coordinate("a") + coordinate("b") +
                                 "</coordinates><SpatialTransform><TransformAxis "
                                 "name=\"rotation1\">" +
                                 axis + "</TransformAxis></SpatialTransform>"));
    };
    fails(with_axis("<axis>0 0 0</axis>"), "no direction");
    fails(with_axis("<coordinates>a</coordinates><axis>1 0 0</axis><GCVSpline name=\"function\"/>"),
          "'GCVSpline'");
    fails(with_axis("<coordinates>a</coordinates><axis>1 0 0</axis><SimmSpline name=\"function\"><x>0 "
                    "0</x><y>1 2</y></SimmSpline>"),
          "do not ascend");
    fails(with_axis("<coordinates>a</coordinates><axis>1 0 0</axis><SimmSpline name=\"function\"><x>0 "
                    "1</x><y>1</y></SimmSpline>"),
          "2 x and 1 y");
    fails(with_axis("<coordinates>a b</coordinates><axis>1 0 0</axis><SimmSpline name=\"function\"><x>0 "
                    "1</x><y>1 1</y></SimmSpline>"),
          "of several coordinates");
    fails(with_axis("<axis>1 0 0</axis><LinearFunction name=\"function\"/>"), "function of no coordinate");
    fails(model4(joint4("PinJoint", "j", "f1", "thigh",
                        "<frames><PhysicalOffsetFrame "
                        "name=\"f1\"><socket_parent>../f2</socket_parent></PhysicalOffsetFrame>"
                        "<PhysicalOffsetFrame "
                        "name=\"f2\"><socket_parent>../f1</socket_parent></PhysicalOffsetFrame></frames>")),
          "in a circle");
    fails(model4("<PinJoint name=\"j\"><socket_child_frame>thigh</socket_child_frame></PinJoint>"),
          "no parent_frame");
}

TEST_CASE("osim: what is no model is told, and takes no memory", "[io][osim]") {
    fails("", "well-formed");
    fails("<a>", "well-formed");
    fails("<OpenSimDocument Version=\"40000\">\n<Model>\n</Modell>\n</OpenSimDocument>", "line 3");
    fails("<html/>", "no OpenSim model");
    fails("<OpenSimDocument Version=\"x\"/>", "no OpenSim model");
    fails("<OpenSimDocument Version=\"10000\"/>", "version is 10000");
    fails("<OpenSimDocument Version=\"40000\"/>", "no Model");
    fails(std::string("<OpenSimDocument>\0</OpenSimDocument>", 36), "zero byte");
    // Entities that grow a thousandfold at each step: no document type is taken.
    std::string bomb = "<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\">";
    for (char c = 'b'; c < 'k'; ++c)
        bomb += std::string("<!ENTITY ") + c + " \"&" + static_cast<char>(c - 1) + ";&" +
                static_cast<char>(c - 1) + ";\">";
    bomb += "]><OpenSimDocument Version=\"40000\"><Model name=\"&j;\"></Model></OpenSimDocument>";
    fails(bomb, "a document type");
    fails("<?xml version=\"1.0\"?>\n\n" + bomb, "line 3");
    // Very deep, and very many.
    std::string deep = "<OpenSimDocument Version=\"40000\"><Model>";
    for (int i = 0; i < 200000; ++i)
        deep += "<x>";
    fails(deep, "well-formed");
    std::string many = "<OpenSimDocument Version=\"40000\"><Model>";
    many.reserve(9000000);
    for (int i = 0; i < 2000001; ++i)
        many += "<x/>";
    fails(many + "</Model></OpenSimDocument>", "two million tags");
    // Every cut and every flipped letter of a good model: an error or a model, never a crash.
    const std::string good = model4(two_pins, muscle4(straight));
    int read = 0;
    for (std::size_t i = 0; i < good.size(); i += 3)
        for (const bool cut : {true, false}) {
            std::string bad = cut ? good.substr(0, i) : good;
            if (!cut)
                bad[i] = bad[i] == '<' ? '>' : '<';
            try {
                read += read_osim(bad, "bad.osim").model.muscles.empty() ? 0 : 1;
            } catch (const Error&) {
            }
        }
    CHECK(read < static_cast<int>(good.size()));
}
