#include "fascicle/anatomy/assignment.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace fascicle {

namespace {

std::size_t cell(int row, int column, int n) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n) + static_cast<std::size_t>(column);
}

double total(const std::vector<double>& cost, const std::vector<int>& column) {
    const int n = static_cast<int>(column.size());
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum += cost[cell(i, column[static_cast<std::size_t>(i)], n)];
    return sum;
}

} // namespace

Assignment assign_exactly(const std::vector<double>& cost, int n) {
    FASCICLE_ASSERT(n >= 0 && cost.size() == static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    const auto size = static_cast<std::size_t>(n);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // Column n is a spare one from which each row's search starts.
    std::vector<double> row_price(size, 0.0), column_price(size + 1, 0.0), slack(size + 1);
    std::vector<int> row_of(size + 1, -1), reached_from(size + 1);
    std::vector<char> done(size + 1);
    for (int row = 0; row < n; ++row) {
        row_of[size] = row;
        std::fill(slack.begin(), slack.end(), infinity);
        std::fill(done.begin(), done.end(), char{0});
        std::size_t at = size;
        do {
            done[at] = 1;
            const int i = row_of[at];
            double step = infinity;
            std::size_t next = size;
            for (std::size_t j = 0; j < size; ++j) {
                if (done[j])
                    continue;
                const double reduced =
                    cost[cell(i, static_cast<int>(j), n)] - row_price[static_cast<std::size_t>(i)] - column_price[j];
                if (reduced < slack[j]) {
                    slack[j] = reduced;
                    reached_from[j] = static_cast<int>(at);
                }
                if (slack[j] < step) {
                    step = slack[j];
                    next = j;
                }
            }
            FASCICLE_ASSERT(next != size); // else a cost was not finite
            for (std::size_t j = 0; j <= size; ++j)
                if (done[j]) {
                    row_price[static_cast<std::size_t>(row_of[j])] += step;
                    column_price[j] -= step;
                } else {
                    slack[j] -= step;
                }
            at = next;
        } while (row_of[at] >= 0);
        while (at != size) {
            const auto from = static_cast<std::size_t>(reached_from[at]);
            row_of[at] = row_of[from];
            at = from;
        }
    }
    Assignment result;
    result.column.resize(size);
    for (std::size_t j = 0; j < size; ++j)
        result.column[static_cast<std::size_t>(row_of[j])] = static_cast<int>(j);
    result.cost = total(cost, result.column);
    return result;
}

Assignment assign_greedily(const std::vector<double>& cost, int n, int rounds) {
    FASCICLE_ASSERT(n >= 0 && cost.size() == static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    const auto size = static_cast<std::size_t>(n);
    // Only the cheapest cells of each row can be taken early; the rest is filled up row by row.
    const std::size_t kept = std::min<std::size_t>(size, 32);
    std::vector<std::size_t> cells, row(size);
    cells.reserve(size * kept);
    const auto cheaper = [&](std::size_t a, std::size_t b) {
        return cost[a] != cost[b] ? cost[a] < cost[b] : a < b;
    };
    for (std::size_t i = 0; i < size; ++i) {
        std::iota(row.begin(), row.end(), i * size);
        std::partial_sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kept), row.end(), cheaper);
        cells.insert(cells.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kept));
    }
    std::sort(cells.begin(), cells.end(), cheaper);
    Assignment result;
    result.column.assign(size, -1);
    std::vector<char> taken(size, 0);
    for (const std::size_t c : cells)
        if (result.column[c / size] < 0 && !taken[c % size]) {
            result.column[c / size] = static_cast<int>(c % size);
            taken[c % size] = 1;
        }
    for (std::size_t i = 0; i < size; ++i) {
        if (result.column[i] >= 0)
            continue;
        std::size_t best = size;
        for (std::size_t j = 0; j < size; ++j)
            if (!taken[j] && (best == size || cost[i * size + j] < cost[i * size + best]))
                best = j;
        result.column[i] = static_cast<int>(best);
        taken[best] = 1;
    }
    for (int round = 0; round < rounds; ++round) {
        bool changed = false;
        for (int i = 0; i < n; ++i)
            for (int k = i + 1; k < n; ++k) {
                int& a = result.column[static_cast<std::size_t>(i)];
                int& b = result.column[static_cast<std::size_t>(k)];
                const double now = cost[cell(i, a, n)] + cost[cell(k, b, n)];
                const double then = cost[cell(i, b, n)] + cost[cell(k, a, n)];
                if (then < now * (1.0 - 1e-12)) {
                    std::swap(a, b);
                    changed = true;
                }
            }
        if (!changed)
            break;
    }
    result.cost = total(cost, result.column);
    return result;
}

Assignment assign(const std::vector<double>& cost, int n) {
    return n <= exact_limit ? assign_exactly(cost, n) : assign_greedily(cost, n);
}

} // namespace fascicle
