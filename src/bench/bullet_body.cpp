#include "bench/bullet_body.hpp"

#ifdef FASCICLE_HAS_BULLET

#include "fascicle/geometry/mesh_topology.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

namespace fascicle::bench {

namespace {

class BulletBody final : public BenchBody {
public:
    BulletBody(const PreparedScene& prepared, int iterations);
    ~BulletBody() override;
    void advance(std::span<const Pose> from, std::span<const Pose> to) override;
    std::vector<Points> positions() const override;

private:
    struct FixedNode {
        int node;
        int bone;
        Vec3 rest;
    };
    struct Body {
        std::unique_ptr<btSoftBody> soft;
        std::vector<FixedNode> fixed;
    };
    void add(const SoftBodyProblem& problem, int iterations);
    /// Bullet's thresholds are made for metres.
    btVector3 to_bullet(const Vec3& p) const {
        return {btScalar(p.x() * metres_), btScalar(p.y() * metres_), btScalar(p.z() * metres_)};
    }

    double metres_;
    btScalar frame_time_;
    btSoftBodyRigidBodyCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<Body> bodies_;
};

BulletBody::BulletBody(const PreparedScene& prepared, int iterations)
    : metres_(prepared.muscles.front().problem.unit_mm * 1e-3),
      frame_time_(btScalar(prepared.muscles.front().problem.parameters.get("solver.frame_time"))) {
    world_.setGravity(btVector3(0, 0, 0));
    btSoftBodyWorldInfo& info = world_.getWorldInfo();
    info.m_gravity.setZero();
    info.air_density = 0;
    for (const PreparedMuscle& muscle : prepared.muscles)
        add(muscle.problem, iterations);
}

BulletBody::~BulletBody() {
    for (Body& body : bodies_)
        world_.removeSoftBody(body.soft.get());
}

void BulletBody::add(const SoftBodyProblem& problem, int iterations) {
    const TriMesh& mesh = *problem.surface;
    std::vector<btVector3> points;
    for (const Vec3& p : mesh.positions)
        points.push_back(to_bullet(p));
    Body body;
    body.soft =
        std::make_unique<btSoftBody>(&world_.getWorldInfo(), mesh.vertex_count(), points.data(), nullptr);
    btSoftBody& soft = *body.soft;
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    for (const Edge& edge : topology.edges())
        soft.appendLink(edge.a, edge.b);
    for (const Tri& t : mesh.triangles)
        soft.appendFace(t[0], t[1], t[2]);
    for (int i = 0; i < mesh.vertex_count(); ++i)
        if (const int bone = problem.body_of_vertex[static_cast<std::size_t>(i)]; bone >= 0) {
            soft.setMass(i, 0);
            body.fixed.push_back({i, bone, mesh.positions[static_cast<std::size_t>(i)]});
        }
    soft.m_materials[0]->m_kLST = 1;
    soft.m_cfg.piterations = iterations;
    soft.m_cfg.viterations = 0;
    soft.m_cfg.kVC = 1;
    soft.m_cfg.collisions = 0;
    soft.setPose(true, false);
    soft.setActivationState(DISABLE_DEACTIVATION);
    world_.addSoftBody(&soft, 0, 0);
    bodies_.push_back(std::move(body));
}

void BulletBody::advance(std::span<const Pose>, std::span<const Pose> to) {
    for (Body& body : bodies_)
        for (const FixedNode& fixed : body.fixed) {
            btSoftBody::Node& node = body.soft->m_nodes[fixed.node];
            node.m_x = node.m_q = to_bullet(to[static_cast<std::size_t>(fixed.bone)].apply(fixed.rest));
            node.m_v.setZero();
        }
    world_.stepSimulation(frame_time_, 0); // exactly one step
}

std::vector<Points> BulletBody::positions() const {
    std::vector<Points> all;
    for (const Body& body : bodies_) {
        Points& points = all.emplace_back();
        for (int i = 0; i < body.soft->m_nodes.size(); ++i) {
            const btVector3& p = body.soft->m_nodes[i].m_x;
            points.emplace_back(Vec3(p.x(), p.y(), p.z()) / metres_);
        }
    }
    return all;
}

} // namespace

std::string bullet_missing() {
    return {};
}

std::unique_ptr<BenchBody> make_bullet_body(const PreparedScene& prepared, int iterations) {
    return std::make_unique<BulletBody>(prepared, iterations);
}

} // namespace fascicle::bench

#else

namespace fascicle::bench {

std::string bullet_missing() {
    return "this program was built without Bullet (package libbullet-dev)";
}

std::unique_ptr<BenchBody> make_bullet_body(const PreparedScene&, int) {
    return nullptr;
}

} // namespace fascicle::bench

#endif
