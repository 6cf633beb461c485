#include "fascicle/anatomy/assignment.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>
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
                const double reduced = cost[cell(i, static_cast<int>(j), n)] -
                                       row_price[static_cast<std::size_t>(i)] - column_price[j];
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

namespace {

/// Square cost of some rows and columns.
std::vector<double> part_of(const std::vector<double>& cost, std::size_t n,
                            const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns) {
    // The lacking rows or columns are made up, at no cost.
    const std::size_t size = std::max(rows.size(), columns.size());
    std::vector<double> part(size * size, 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns.size(); ++j)
            part[i * size + j] = cost[rows[i] * n + columns[j]];
    return part;
}

std::vector<std::size_t> range(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> list(end - begin);
    std::iota(list.begin(), list.end(), begin);
    return list;
}

/// Each row in turn exchanges its column for one of its cheapest with the row that has it, where that lowers the sum.
void exchange(const std::vector<double>& cost, std::vector<int>& column) {
    constexpr int most_rounds = 30;
    const std::size_t n = column.size(), kept = std::min<std::size_t>(n, 32);
    std::vector<std::size_t> wishes, row(n), owner(n);
    wishes.reserve(n * kept);
    for (std::size_t i = 0; i < n; ++i) {
        owner[static_cast<std::size_t>(column[i])] = i;
        std::iota(row.begin(), row.end(), std::size_t{0});
        std::partial_sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kept), row.end(),
                          [&](std::size_t a, std::size_t b) {
                              const double x = cost[i * n + a], y = cost[i * n + b];
                              return x != y ? x < y : a < b;
                          });
        wishes.insert(wishes.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kept));
    }
    bool changed = true;
    for (int round = 0; round < most_rounds && changed; ++round) {
        changed = false;
        for (std::size_t at = 0; at < wishes.size(); ++at) {
            const std::size_t i = at / kept, wanted = wishes[at], k = owner[wanted];
            const auto has = static_cast<std::size_t>(column[i]);
            const double now = cost[i * n + has] + cost[k * n + wanted];
            const double then = cost[i * n + wanted] + cost[k * n + has];
            if (!(then < now - 1e-12 * std::abs(now)))
                continue;
            std::swap(column[i], column[k]);
            std::swap(owner[has], owner[wanted]);
            changed = true;
        }
    }
}

} // namespace

Assignment assign_in_blocks(const std::vector<double>& cost, int n, int blocks) {
    FASCICLE_ASSERT(n >= 0 && cost.size() == static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    FASCICLE_ASSERT(blocks >= 1);
    const auto size = static_cast<std::size_t>(n), count = std::min(static_cast<std::size_t>(blocks), size);
    const auto border = [&](std::size_t block) { return block * size / count; };
    std::vector<double> coarse(count * count, 0.0);
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t i = border(a); i < border(a + 1); ++i)
            for (std::size_t b = 0; b < count; ++b) {
                double sum = 0;
                for (std::size_t j = border(b); j < border(b + 1); ++j)
                    sum += cost[i * size + j];
                coarse[a * count + b] += sum / static_cast<double>(border(b + 1) - border(b));
            }
    const Assignment pairs = assign_exactly(coarse, static_cast<int>(count));
    Assignment result;
    result.column.assign(size, -1);
    std::vector<std::size_t> spare_rows, spare_columns; // blocks differ by one in size
    const auto assign_part = [&](const std::vector<std::size_t>& rows,
                                 const std::vector<std::size_t>& columns) {
        const std::vector<double> part = part_of(cost, size, rows, columns);
        const std::size_t side = std::max(rows.size(), columns.size());
        const Assignment inner = assign_exactly(part, static_cast<int>(side));
        for (std::size_t i = 0; i < side; ++i) {
            const auto j = static_cast<std::size_t>(inner.column[i]);
            if (i < rows.size() && j < columns.size())
                result.column[rows[i]] = static_cast<int>(columns[j]);
            else if (i < rows.size())
                spare_rows.push_back(rows[i]);
            else if (j < columns.size())
                spare_columns.push_back(columns[j]);
        }
    };
    for (std::size_t a = 0; a < count; ++a) {
        const auto b = static_cast<std::size_t>(pairs.column[a]);
        assign_part(range(border(a), border(a + 1)), range(border(b), border(b + 1)));
    }
    const std::vector<std::size_t> rows = spare_rows, columns = spare_columns;
    assign_part(rows, columns);
    exchange(cost, result.column);
    result.cost = total(cost, result.column);
    return result;
}

Assignment assign(const std::vector<double>& cost, int n) {
    return n <= exact_limit ? assign_exactly(cost, n) : assign_in_blocks(cost, n, exact_limit);
}

} // namespace fascicle
