#include "triangle_tree.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <numeric>

namespace fascicle {

namespace {

class Builder {
public:
    Builder(const Points& points, const std::vector<Tri>& triangles, int leaf_size) : leaf_size_(leaf_size) {
        centroids_.reserve(triangles.size());
        for (const Tri& t : triangles) {
            Vec3 sum = Vec3::Zero();
            for (int v : t)
                sum += points[static_cast<std::size_t>(v)];
            centroids_.push_back(sum / 3.0);
        }
        tree_.order.resize(triangles.size());
        std::iota(tree_.order.begin(), tree_.order.end(), 0);
    }

    TriangleTree build() {
        if (!tree_.order.empty())
            add_node({0, static_cast<int>(tree_.order.size()), -1});
        return std::move(tree_);
    }

private:
    using Child = TriangleTree::Child;

    int add_node(const Child& range) {
        const auto node = tree_.nodes.size();
        tree_.nodes.emplace_back();
        std::array<Child, 4> parts{range};
        int count = 1;
        for (int level = 0; level < 2; ++level)
            for (int i = 0, n = count; i < n; ++i)
                if (Child& part = parts[static_cast<std::size_t>(i)]; part.end - part.begin > leaf_size_) {
                    const int middle = split(part);
                    parts[static_cast<std::size_t>(count++)] = {middle, part.end, -1};
                    part.end = middle;
                }
        for (int i = 0; i < count; ++i)
            if (Child& part = parts[static_cast<std::size_t>(i)]; part.end - part.begin > leaf_size_)
                part.node = add_node(part);
        tree_.nodes[node].children = parts;
        tree_.nodes[node].count = count;
        return static_cast<int>(node);
    }

    int split(const Child& range) {
        Vec3 low = centroid(range.begin), high = low;
        for (int i = range.begin + 1; i < range.end; ++i) {
            low = low.cwiseMin(centroid(i));
            high = high.cwiseMax(centroid(i));
        }
        int axis = 0;
        (high - low).maxCoeff(&axis);
        const int leaves = ((range.end - range.begin) / 2 + leaf_size_ - 1) / leaf_size_;
        const int middle = range.begin + leaves * leaf_size_;
        const auto first = tree_.order.begin();
        std::nth_element(first + range.begin, first + middle, first + range.end, [&](int a, int b) {
            const double x = centroids_[static_cast<std::size_t>(a)][axis];
            const double y = centroids_[static_cast<std::size_t>(b)][axis];
            return x < y || (x == y && a < b);
        });
        return middle;
    }

    const Vec3& centroid(int i) const {
        return centroids_[static_cast<std::size_t>(tree_.order[static_cast<std::size_t>(i)])];
    }

    int leaf_size_;
    Points centroids_;
    TriangleTree tree_;
};

} // namespace

TriangleTree build_triangle_tree(const Points& points, const std::vector<Tri>& triangles, int leaf_size) {
    FASCICLE_ASSERT(leaf_size >= 1);
    return Builder(points, triangles, leaf_size).build();
}

} // namespace fascicle
