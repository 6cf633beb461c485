#include "strands.hpp"

#include "curve_tools.hpp"
#include "hash_random.hpp"

#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::chmd {

namespace {

constexpr std::uint64_t depth_seed = 11, shift_seed = 12;

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

struct Column {
    std::vector<Thickness> lines; ///< one per row
    double mean = 0;              ///< thickness, > 0 but for a flat muscle
    int origin_head = 0, insertion_head = 0;
    bool same_side(const Column& other) const {
        return origin_head == other.origin_head && insertion_head == other.insertion_head;
    }
};

std::vector<Column> make_columns(const FibreProblem& problem, const Rows& rows, int s) {
    std::vector<Column> columns(z(rows.spans() * s + 1));
    parallel_for(problem.threads, columns.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const int last = rows.spans() - 1, span = std::min(static_cast<int>(c) / s, last);
            const double share = static_cast<double>(static_cast<int>(c) - span * s) / s;
            for (int j = 0; j < rows.rows(); ++j)
                columns[c].lines.push_back(rows.thickness(j, span, share));
            even_out(columns[c].lines);
            for (const Thickness& line : columns[c].lines)
                columns[c].mean += line.length() / rows.rows();
            const int fibre = share > 0.5 ? span + 1 : span; // the nearer one
            columns[c].origin_head = rows.head(fibre, true);
            columns[c].insertion_head = rows.head(fibre, false);
        }
    });
    return columns;
}

/// The depths of a column's layers, first 0, last 1.
std::vector<double> layer_depths(const Column& column, double thickest, int v) {
    std::vector<double> depths{0.0};
    const double stretch = column.mean > 0.0 ? std::max(1.0, 0.8 * thickest / column.mean) : 2.0 * v;
    for (int i = 1; i < v; ++i)
        if (const double depth = stretch * i / v; depth <= 1.0 - 0.25 / v)
            depths.push_back(depth);
    depths.push_back(1.0);
    return depths;
}

struct Net {
    std::vector<Column> columns;
    std::vector<std::vector<double>> depths; ///< per column
    int v = 1;
    int size() const {
        int sum = 2 * (v - 1);
        for (const auto& d : depths)
            sum += static_cast<int>(d.size());
        return sum;
    }
};

Net make_net(const FibreProblem& problem, const Rows& rows, int s, int v) {
    Net net;
    net.v = v;
    net.columns = make_columns(problem, rows, s);
    double thickest = 0;
    for (const Column& column : net.columns)
        thickest = std::max(thickest, column.mean);
    for (const Column& column : net.columns)
        net.depths.push_back(layer_depths(column, thickest, v));
    return net;
}

/// The coarsest net that holds enough strands.
Net choose_net(const FibreProblem& problem, const Rows& rows) {
    Net net = make_net(problem, rows, 1, 2);
    double width = 0, thickness = 0;
    for (const Column& column : net.columns)
        thickness += column.mean / static_cast<double>(net.columns.size());
    for (int j = 0; j < rows.rows(); ++j) {
        Points row;
        for (const Column& column : net.columns)
            row.push_back(column.lines[z(j)].top);
        width += polyline_length(row) / rows.rows();
    }
    const double spacing = std::sqrt(std::max(width * thickness, 1e-12 * width * width) / problem.count);
    const int v =
        static_cast<int>(std::clamp(spacing > 0.0 ? std::round(thickness / spacing) : 2.0, 2.0, 50.0));
    // Every column gives at least two layers, so the search ends.
    int s = std::max(1, problem.count / (rows.spans() * (v + 1)));
    while (s > 1 && static_cast<int>(rows.spans() * (s - 1)) * (v + 1) >= problem.count)
        --s;
    for (net = make_net(problem, rows, s, v); net.size() < problem.count;) {
        const int short_of = problem.count - net.size();
        s += std::max(1, short_of / (2 * rows.spans() * (v + 1)));
        net = make_net(problem, rows, s, v);
    }
    return net;
}

Strand layer_strand(const Net& net, std::size_t c, std::size_t layer) {
    const Column& column = net.columns[c];
    double depth = net.depths[c][layer], shift = 0;
    if (layer > 0 && layer + 1 < net.depths[c].size()) {
        const std::uint64_t place = 64 * c + layer;
        depth += (hash_uniform(depth_seed, place) - 0.5) / net.v;
        depth = std::clamp(depth, 0.25 / net.v, 1.0 - 0.25 / net.v);
        if (c + 1 < net.columns.size() && column.same_side(net.columns[c + 1]))
            shift = 0.5 * hash_uniform(shift_seed, place);
    }
    Strand strand{depth, column.origin_head, column.insertion_head, {}};
    for (std::size_t j = 0; j < column.lines.size(); ++j) {
        const Thickness& here = column.lines[j];
        Vec3 p = (1.0 - depth) * here.top + depth * here.bottom;
        if (shift > 0.0) {
            const Thickness& next = net.columns[c + 1].lines[j];
            p += shift * ((1.0 - depth) * next.top + depth * next.bottom - p);
        }
        strand.path.push_back(p);
    }
    return strand;
}

/// Strands round the rim of the muscle beside an outermost column: on the curve through the tops and bottoms of the two
/// outermost columns.
Strand side_strand(const Net& net, bool left, int layer) {
    const std::size_t last = net.columns.size() - 1;
    const Column &outer = net.columns[left ? 0 : last], &inner = net.columns[left ? 1 : last - 1];
    const double share = static_cast<double>(layer) / net.v;
    Strand strand{share, outer.origin_head, outer.insertion_head, {}};
    for (std::size_t j = 0; j < outer.lines.size(); ++j)
        strand.path.push_back(CentripetalSpline({inner.lines[j].top, outer.lines[j].top,
                                                 outer.lines[j].bottom, inner.lines[j].bottom})
                                  .at(1, share));
    return strand;
}

} // namespace

void even_out(std::vector<Thickness>& lines) {
    const std::size_t m = lines.size(), window = std::min<std::size_t>(5, m);
    std::vector<double> lengths, near;
    for (const Thickness& line : lines)
        lengths.push_back(line.length());
    for (std::size_t j = 0; j < m; ++j) {
        const std::size_t first = std::min(j < 2 ? 0 : j - 2, m - window);
        near.assign(lengths.begin() + static_cast<std::ptrdiff_t>(first),
                    lengths.begin() + static_cast<std::ptrdiff_t>(first + window));
        std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(window / 2), near.end());
        if (const double median = near[window / 2]; lengths[j] > 1.5 * median)
            lines[j].bottom = lines[j].top + median / lengths[j] * (lines[j].bottom - lines[j].top);
    }
    for (int pass = 0; pass < 2; ++pass) {
        const std::vector<Thickness> old = lines;
        for (std::size_t j = 1; j + 1 < m; ++j) {
            lines[j].top = (old[j - 1].top + 4.0 * old[j].top + old[j + 1].top) / 6.0;
            lines[j].bottom = (old[j - 1].bottom + 4.0 * old[j].bottom + old[j + 1].bottom) / 6.0;
        }
    }
}

std::vector<Strand> make_strands(const FibreProblem& problem, const Rows& rows) {
    const Net net = choose_net(problem, rows);
    std::vector<Strand> all;
    for (int layer = 1; layer < net.v; ++layer)
        all.push_back(side_strand(net, true, layer));
    for (std::size_t c = 0; c < net.columns.size(); ++c) {
        const std::size_t layers = net.depths[c].size();
        for (std::size_t k = 0; k < layers; ++k) // up and down, so that neighbours on the path are neighbours
            all.push_back(layer_strand(net, c, c % 2 == 0 ? k : layers - 1 - k));
    }
    for (int layer = 1; layer < net.v; ++layer)
        all.push_back(side_strand(net, false, layer));
    std::vector<Strand> chosen;
    for (int i = 0; i < problem.count; ++i) {
        const double place = (i + 0.5) * static_cast<double>(all.size()) / problem.count;
        chosen.push_back(std::move(all[static_cast<std::size_t>(place)]));
    }
    return chosen;
}

} // namespace fascicle::chmd
