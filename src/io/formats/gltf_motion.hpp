#pragma once
// How the nodes of a glTF move: their places in the tree, and the samplers of its first animation.

#include "io/formats/gltf_document.hpp"

#include <Eigen/Geometry>
#include <array>

namespace fascicle::io {

/// What moves nodes. Plain data; const calls may run on several threads.
class GltfMotion {
public:
    /// Nodes and the first animation. Error for cycles, for trees deeper than 100, and for bad samplers.
    explicit GltfMotion(GltfDocument& document);

    /// Times of all samplers together, ascending; one time 0 when nothing moves.
    const std::vector<double>& times() const { return times_; }
    /// Nodes below the scene that is shown.
    const std::vector<int>& nodes() const { return nodes_; }
    /// Whether the node or one above it moves.
    bool moves(int node) const;
    Eigen::Affine3d place(int node, double time) const;
    /// Weights of the node's morph targets; `weights` holds those it has at rest.
    void weigh(int node, double time, std::vector<double>& weights) const;
    bool has_weights(int node) const { return data_[static_cast<std::size_t>(node)].samplers[weight] >= 0; }

private:
    enum Path { translation, rotation, scale, weight };
    struct Node {
        int parent = -1;
        Eigen::Affine3d matrix = Eigen::Affine3d::Identity(); ///< where there is one
        bool has_matrix = false;
        std::array<double, 3> shift{0, 0, 0}, stretch{1, 1, 1};
        std::array<double, 4> turn{0, 0, 0, 1};
        std::array<int, 4> samplers{-1, -1, -1, -1}; ///< by Path
    };
    struct Sampler {
        GltfDocument::Floats times, values;
        std::size_t width = 1; ///< numbers of one key
        bool step = false, cubic = false;
    };
    void read_nodes(GltfDocument& document);
    void read_animation(GltfDocument& document);
    /// Keys before and after the time, and the share of the second.
    static std::pair<std::size_t, double> key_at(const Sampler& sampler, double time);
    static double value(const Sampler& sampler, std::size_t key, std::size_t c);

    std::vector<Node> data_;
    std::vector<int> nodes_;
    std::vector<Sampler> samplers_;
    std::vector<double> times_;
};

} // namespace fascicle::io
