#include "solver/rivals/lines/attachment_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::solver {

namespace {

std::size_t farthest_area(const std::vector<AttachedArea>& areas) {
    constexpr double rounding = 1e-9;
    std::size_t best = 0;
    double best_gap = -1;
    for (std::size_t a = 0; a < areas.size(); ++a) {
        double gap = std::numeric_limits<double>::infinity();
        for (std::size_t b = 0; b < areas.size(); ++b)
            if (b != a)
                gap = std::min(gap, (areas[a].middle - areas[b].middle).norm());
        const bool equal = std::abs(gap - best_gap) <= rounding * gap;
        if (equal ? areas[a].vertices.size() > areas[best].vertices.size() : gap > best_gap) {
            best = a;
            best_gap = gap;
        }
    }
    return best;
}

} // namespace

std::vector<AttachmentPair> pair_attachments(const std::vector<AttachedArea>& areas, int count) {
    if (areas.size() < 2)
        return {};
    std::vector<char> is_end(areas.size(), 0);
    for (std::size_t a = 0; a < areas.size(); ++a)
        is_end[a] = areas[a].moves ? 1 : 0;
    if (std::count(is_end.begin(), is_end.end(), 1) % std::ptrdiff_t(areas.size()) == 0) { // all or none
        is_end.assign(areas.size(), 1);
        is_end[farthest_area(areas)] = 0;
    }
    double begins = 0, ends = 0;
    for (std::size_t a = 0; a < areas.size(); ++a)
        (is_end[a] != 0 ? ends : begins) += double(areas[a].vertices.size());
    std::vector<AttachmentPair> pairs;
    for (std::size_t a = 0; a < areas.size(); ++a)
        for (std::size_t b = 0; b < areas.size(); ++b)
            if (is_end[a] == 0 && is_end[b] != 0) {
                const double share =
                    double(areas[a].vertices.size()) / begins * double(areas[b].vertices.size()) / ends;
                pairs.push_back({a, b, std::max(1, static_cast<int>(std::lround(count * share)))});
            }
    return pairs;
}

} // namespace fascicle::solver
