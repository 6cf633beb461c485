// An exported model as XML, element by element as OpenSim 4.0 writes it.

#include "io/osim_export/baked_model.hpp"

#include "io/osim_export/xml_text.hpp"

namespace fascicle::io {
namespace {

std::string body_path(const BakedModel& model, int body) {
    return body == 0 ? "/ground" : "/bodyset/" + model.bodies[static_cast<std::size_t>(body)].name;
}

void write_frame_geometry(XmlText& xml) {
    xml.open("FrameGeometry", "name", "frame_geometry")
        .text("socket_frame", "..")
        .text("scale_factors", "0.05 0.05 0.05")
        .close();
}

void write_body(XmlText& xml, const BakedBody& body) {
    xml.open("Body", "name", body.name);
    write_frame_geometry(xml);
    xml.open("attached_geometry")
        .open("Mesh", "name", body.name + "_geom_1")
        .text("socket_frame", "..")
        .text("scale_factors", "1 1 1")
        .open("Appearance")
        .number("opacity", 1)
        .text("color", "0.93 0.9 0.82")
        .close()
        .text("mesh_file", body.mesh_file)
        .close()
        .close();
    xml.number("mass", body.mass_kg).vector("mass_center", body.mass_centre).numbers("inertia", body.inertia);
    xml.close();
}

void write_function(XmlText& xml, const BakedFunction& f, std::string_view name = {}) {
    const std::string_view attribute = name.empty() ? std::string_view{} : "name";
    if (f.x.empty())
        xml.open("Constant", attribute, name).number("value", f.y.front()).close();
    else
        xml.open("SimmSpline", attribute, name).numbers("x", f.x).numbers("y", f.y).close();
}

void write_transform(XmlText& xml, const BakedJoint& joint, const std::string& coordinate) {
    xml.open("SpatialTransform");
    for (std::size_t i = 0; i < 6; ++i) {
        xml.open("TransformAxis", "name", (i < 3 ? "rotation" : "translation") + std::to_string(i % 3 + 1));
        const BakedFunction& f = joint.functions[i];
        const bool linear = joint.hinge && i == 0, constant = joint.hinge ? i > 0 : f.x.empty();
        xml.text("coordinates", constant ? "" : coordinate);
        xml.vector("axis", joint.axes.col(static_cast<Eigen::Index>(i % 3)));
        if (linear)
            xml.open("LinearFunction", "name", "function").text("coefficients", "1 0").close();
        else
            write_function(xml, constant && f.y.empty() ? BakedFunction{{}, {0}} : f, "function");
        xml.close();
    }
    xml.close();
}

void write_joint(XmlText& xml, const BakedModel& model, const BakedJoint& joint) {
    const auto offset = [&](int body) {
        return (body == 0 ? "ground" : model.bodies[static_cast<std::size_t>(body)].name) +
               std::string("_offset");
    };
    xml.open(joint.coordinate < 0 ? "WeldJoint" : "CustomJoint", "name", joint.name);
    xml.text("socket_parent_frame", offset(joint.parent)).text("socket_child_frame", offset(joint.child));
    if (joint.coordinate >= 0) {
        const BakedCoordinate& c = model.coordinates[static_cast<std::size_t>(joint.coordinate)];
        xml.open("coordinates").open("Coordinate", "name", c.name);
        xml.number("default_value", c.default_value).number("default_speed_value", 0);
        const double range[2] = {c.range_min, c.range_max};
        xml.numbers("range", range).flag("clamped", true).flag("locked", false).flag("prescribed", false);
        xml.close().close();
    }
    xml.open("frames");
    for (const int body : {joint.parent, joint.child}) {
        xml.open("PhysicalOffsetFrame", "name", offset(body));
        write_frame_geometry(xml);
        xml.text("socket_parent", body_path(model, body))
            .vector("translation", joint.centre)
            .text("orientation", "0 0 0")
            .close();
    }
    xml.close();
    if (joint.coordinate >= 0)
        write_transform(xml, joint, model.coordinates[static_cast<std::size_t>(joint.coordinate)].name);
    xml.close();
}

void write_point(XmlText& xml, const BakedModel& model, const BakedFibre& fibre, std::size_t i) {
    const BakedPoint& point = fibre.points[i];
    xml.open(point.moving ? "MovingPathPoint" : "PathPoint", "name",
             fibre.name + "-P" + std::to_string(i + 1));
    xml.text("socket_parent_frame", body_path(model, point.body));
    if (point.moving) {
        const std::string coordinate = model.coordinates.front().path();
        for (const char* socket : {"socket_x_coordinate", "socket_y_coordinate", "socket_z_coordinate"})
            xml.text(socket, coordinate);
        const char* const places[3] = {"x_location", "y_location", "z_location"};
        for (std::size_t c = 0; c < 3; ++c) {
            xml.open(places[c]);
            write_function(xml, {fibre.knots, point.at_knots[c]});
            xml.close();
        }
    } else {
        xml.vector("location", point.location);
    }
    xml.close();
}

void write_muscle(XmlText& xml, const BakedModel& model, const BakedFibre& fibre) {
    xml.open("Millard2012EquilibriumMuscle", "name", fibre.name);
    xml.flag("appliesForce", true).number("min_control", 0.01).number("max_control", 1);
    xml.open("GeometryPath", "name", "geometrypath").open("PathPointSet").open("objects");
    for (std::size_t i = 0; i < fibre.points.size(); ++i)
        write_point(xml, model, fibre, i);
    xml.close().close();
    xml.open("Appearance").text("color", "0.8 0.1 0.1").close();
    xml.close();
    xml.number("optimal_force", 1)
        .number("max_isometric_force", fibre.max_force_n)
        .number("optimal_fiber_length", fibre.optimal_length_m)
        .number("tendon_slack_length", fibre.tendon_length_m)
        .number("pennation_angle_at_optimal", 0)
        .number("max_contraction_velocity", 10)
        .flag("ignore_tendon_compliance", true)
        .flag("ignore_activation_dynamics", false);
    xml.close();
}

void write_couplers(XmlText& xml, const BakedModel& model) {
    xml.open("ConstraintSet", "name", "constraintset").open("objects");
    for (std::size_t c = 1; c < model.coordinates.size(); ++c)
        xml.open("CoordinateCouplerConstraint", "name", model.coordinates[c].name + "_follows")
            .flag("isEnforced", true)
            .open("coupled_coordinates_function")
            .open("LinearFunction")
            .text("coefficients", "1 0")
            .close()
            .close()
            .text("independent_coordinate_names", model.coordinates.front().name)
            .text("dependent_coordinate_name", model.coordinates[c].name)
            .number("scale_factor", 1)
            .close();
    xml.close().close();
}

} // namespace

std::string osim_text(const BakedModel& model) {
    XmlText xml;
    xml.open("OpenSimDocument", "Version", "40000").open("Model", "name", model.name);
    xml.open("Ground", "name", "ground");
    write_frame_geometry(xml);
    xml.close();
    xml.text("gravity", "0 -9.80665 0")
        .text("credits", model.credits)
        .text("publications", model.publications);
    xml.text("length_units", "meters").text("force_units", "N");
    xml.open("BodySet", "name", "bodyset").open("objects");
    for (std::size_t b = 1; b < model.bodies.size(); ++b)
        write_body(xml, model.bodies[b]);
    xml.close().close();
    xml.open("JointSet", "name", "jointset").open("objects");
    for (const BakedJoint& joint : model.joints)
        write_joint(xml, model, joint);
    xml.close().close();
    write_couplers(xml, model);
    xml.open("ForceSet", "name", "forceset").open("objects");
    for (const BakedFibre& fibre : model.fibres)
        write_muscle(xml, model, fibre);
    xml.close().close();
    xml.close().close();
    return xml.finished();
}

} // namespace fascicle::io
