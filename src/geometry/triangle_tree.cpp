#include "triangle_tree.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle {

namespace {

class Builder {
public:
    Builder(const Points& points, const std::vector<Tri>& triangles, int leaf_size) : leaf_size_(leaf_size) {
        entries_.reserve(triangles.size());
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            Vec3 sum = Vec3::Zero();
            for (int v : triangles[t])
                sum += points[static_cast<std::size_t>(v)];
            const Vec3 centroid = sum / 3.0;
            entries_.push_back({{centroid.x(), centroid.y(), centroid.z()}, static_cast<int>(t)});
        }
    }

    TriangleTree build() {
        tree_.nodes.reserve(entries_.size() / static_cast<std::size_t>(2 * leaf_size_) + 1);
        if (!entries_.empty())
            add_node({0, static_cast<int>(entries_.size()), -1});
        tree_.order.reserve(entries_.size());
        for (const Entry& e : entries_)
            tree_.order.push_back(e.triangle);
        return std::move(tree_);
    }

private:
    using Child = TriangleTree::Child;
    /// The centroid travels with its triangle: splitting walks through memory in order.
    struct Entry {
        std::array<double, 3> centroid;
        int triangle;
    };

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
        const auto first = entries_.begin() + range.begin, last = entries_.begin() + range.end;
        std::array<double, 3> low = first->centroid, high = low;
        for (auto it = first + 1; it != last; ++it)
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], it->centroid[k]);
                high[k] = std::max(high[k], it->centroid[k]);
            }
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (high[k] - low[k] > high[axis] - low[axis])
                axis = k;
        const int leaves = ((range.end - range.begin) / 2 + leaf_size_ - 1) / leaf_size_;
        const int middle = range.begin + leaves * leaf_size_;
        if (axis == 0)
            part_at<0>(first, entries_.begin() + middle, last);
        else if (axis == 1)
            part_at<1>(first, entries_.begin() + middle, last);
        else
            part_at<2>(first, entries_.begin() + middle, last);
        return middle;
    }

    using Place = std::vector<Entry>::iterator;
    template <std::size_t axis>
    static void part_at(Place first, Place middle, Place last) {
        std::nth_element(first, middle, last, [](const Entry& a, const Entry& b) {
            const double x = a.centroid[axis], y = b.centroid[axis];
            return x < y || (x == y && a.triangle < b.triangle);
        });
    }

    int leaf_size_;
    std::vector<Entry> entries_;
    TriangleTree tree_;
};

} // namespace

TriangleTree build_triangle_tree(const Points& points, const std::vector<Tri>& triangles, int leaf_size) {
    FASCICLE_ASSERT(leaf_size >= 1);
    return Builder(points, triangles, leaf_size).build();
}

} // namespace fascicle
