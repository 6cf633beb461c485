#include "fascicle/anatomy/anisotropy.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace fascicle;

namespace {

Points constant_tangents(const MeshTopology& topology, const Vec3& tangent) {
    return Points(topology.edges().size(), tangent);
}

double softness_of_edge(const Vec3& edge, const Vec3& tangent, double exponent) {
    const TriMesh mesh{{Vec3::Zero(), edge, Vec3(0.3, 5, 7)}, {{0, 1, 2}}};
    const MeshTopology topology(3, mesh.triangles);
    const auto k = edge_softness(mesh, topology, constant_tangents(topology, tangent), exponent);
    for (std::size_t e = 0; e < k.size(); ++e)
        if (topology.edges()[e] == Edge{0, 1})
            return k[e];
    return -1;
}

} // namespace

TEST_CASE("anisotropy: k = (1 - |cos|)^a in closed form", "[anatomy][anisotropy]") {
    const double angle = GENERATE(0.1, 0.5, 1.0, 1.5), a = GENERATE(0.0, 0.5, 1.0, 2.0);
    const Vec3 edge(3 * std::cos(angle), 3 * std::sin(angle), 0);
    const double expected = std::max(min_edge_softness, std::pow(1 - std::cos(angle), a));
    CHECK(softness_of_edge(edge, Vec3::UnitX(), a) == Approx(expected));
    CHECK(softness_of_edge(-edge, Vec3::UnitX(), a) == Approx(expected));
    CHECK(softness_of_edge(edge, -Vec3::UnitX(), a) == Approx(expected));
}

TEST_CASE("anisotropy: along, across, and without a fibre", "[anatomy][anisotropy]") {
    CHECK(softness_of_edge(Vec3(2, 0, 0), Vec3::UnitX(), 1) == min_edge_softness);
    CHECK(softness_of_edge(Vec3(2, 0, 0), Vec3::UnitX(), 0) == 1.0);
    CHECK(softness_of_edge(Vec3(2, 0, 0), Vec3::UnitY(), 2) == 1.0);
    CHECK(softness_of_edge(Vec3(2, 0, 0), Vec3::Zero(), 1) == 1.0);
    CHECK(softness_of_edge(Vec3::Zero(), Vec3::UnitX(), 1) == 1.0); // an edge without length
}

TEST_CASE("anisotropy: unchanged by rigid motion of mesh and fibres", "[anatomy][anisotropy]") {
    TriMesh mesh = test::sphere(10, 2);
    Polylines fibres{{Vec3(-10, 0, 0), Vec3(0, 3, 9), Vec3(10, 1, 0)}, {{0, 1, 2}}};
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const auto before = edge_softness(mesh, topology, edge_tangents_from_fibres(mesh, topology, fibres), 1);
    const Mat3 turn = Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Points* points : {&mesh.positions, &fibres.points})
        for (Vec3& p : *points)
            p = turn * p + Vec3(100, -20, 5);
    const auto after = edge_softness(mesh, topology, edge_tangents_from_fibres(mesh, topology, fibres), 1);
    for (std::size_t e = 0; e < before.size(); ++e)
        CHECK(after[e] == Approx(before[e]).margin(1e-9));
}

TEST_CASE("fibre tangents: nearest segment wins, and turn smoothly from one to the next",
          "[anatomy][anisotropy]") {
    const TriMesh mesh{{Vec3(0.9, -1, 0), Vec3(1.1, -1, 0), Vec3(1, -2, 0), Vec3(5, 7.9, 0), Vec3(5, 8.1, 0)},
                       {{0, 1, 2}, {3, 4, 2}}};
    const MeshTopology topology(5, mesh.triangles);
    const Polylines fibres{{Vec3(-3, 0, 0), Vec3(5, 0, 0), Vec3(5, 10, 0), Vec3(99, 0, 50)},
                           {{0, 1, 2}, {3}, {3, 3}}};
    const Points tangents = edge_tangents_from_fibres(mesh, topology, fibres);
    for (std::size_t e = 0; e < tangents.size(); ++e) {
        CHECK(tangents[e].norm() == Approx(1));
        if (topology.edges()[e] ==
            Edge{0, 1}) // half way along the first segment: half way to the corner's 45 degrees
            CHECK(std::atan2(tangents[e].y(), tangents[e].x()) > 0.0);
        if (topology.edges()[e] == Edge{3, 4})
            CHECK(tangents[e].y() > 0.9);
    }
    const Points none = edge_tangents_from_fibres(mesh, topology, Polylines{{Vec3(1, 1, 1)}, {{0}}});
    CHECK(none.front() == Vec3::Zero());
}

TEST_CASE("field tangents follow the gradient on a plane and vanish where the field is flat",
          "[anatomy][anisotropy]") {
    const TriMesh mesh = test::sheet(6, 4);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<double> field;
    for (const Vec3& p : mesh.positions)
        field.push_back(p.x() < 2 ? 2.0 : p.x());
    const Points tangents = edge_tangents_from_field(mesh, topology, field);
    for (std::size_t e = 0; e < tangents.size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const double x =
            0.5 * (mesh.positions[std::size_t(edge.a)].x() + mesh.positions[std::size_t(edge.b)].x());
        if (x > 2.1)
            CHECK((tangents[e] - Vec3::UnitX()).norm() < 1e-9);
        if (x < 1.9)
            CHECK(tangents[e] == Vec3::Zero());
    }
}

TEST_CASE("the nearest fibre found by the tree is that of all segments looked at", "[anatomy][anisotropy]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> between(-3.0, 3.0);
    Polylines fibres;
    for (int line = 0; line < 12; ++line) {
        std::vector<int>& points = fibres.lines.emplace_back();
        for (int k = 0; k < 6; ++k) {
            points.push_back(static_cast<int>(fibres.points.size()));
            fibres.points.emplace_back(between(random), between(random), between(random));
        }
    }
    const TriMesh mesh = test::sphere(2.5, 3);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const Points tangents = edge_tangents_from_fibres(mesh, topology, fibres);
    for (std::size_t e = 0; e < tangents.size(); ++e) {
        const Vec3 middle = 0.5 * (mesh.positions[static_cast<std::size_t>(topology.edges()[e].a)] +
                                   mesh.positions[static_cast<std::size_t>(topology.edges()[e].b)]);
        double best = 1e300;
        Vec3 expected = Vec3::Zero();
        for (const std::vector<int>& line : fibres.lines)
            for (std::size_t k = 0; k + 1 < line.size(); ++k) {
                const auto at = [&](std::size_t i) {
                    return fibres.points[static_cast<std::size_t>(line[std::min(i, line.size() - 1)])];
                };
                const auto tangent = [&](std::size_t i) {
                    Vec3 sum = Vec3::Zero();
                    if (i > 0)
                        sum += (at(i) - at(i - 1)).normalized();
                    if (i + 1 < line.size())
                        sum += (at(i + 1) - at(i)).normalized();
                    return Vec3(sum.normalized());
                };
                const Vec3 d = at(k + 1) - at(k);
                const double s = std::clamp((middle - at(k)).dot(d) / d.squaredNorm(), 0.0, 1.0);
                if (const double far = (at(k) + s * d - middle).norm(); far < best) {
                    best = far;
                    expected = ((1 - s) * tangent(k) + s * tangent(k + 1)).normalized();
                }
            }
        CHECK((tangents[e] - expected).norm() < 1e-9);
    }
}
