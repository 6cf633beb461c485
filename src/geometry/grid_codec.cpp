#include "fascicle/geometry/grid_codec.hpp"

#include "fascicle/base/content_hash.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace fascicle {

namespace {

// Raise it when a change of the code changes a grid by a single bit, or the bytes below.
constexpr std::uint64_t version = 1;

constexpr std::uint32_t count_bits = 30;
enum class Run : std::uint32_t {
    above = 0,
    below = 1,
    numbers = 2
}; // saturated positive, negative; as they are

struct Header {
    std::uint64_t version = 0;
    std::array<std::int32_t, 3> nodes{};
    std::int32_t reserved = 0;
    double spacing = 0, saturation = 0;
    std::array<double, 3> low{};
    double correction_max = 0, correction_mean = 0;
};
static_assert(sizeof(Header) == 8 + 16 + 7 * 8);
static_assert(std::has_unique_object_representations_v<std::array<std::int32_t, 3>>);

/// Where the runs and numbers of a slab (all nodes of one k) begin.
struct SlabStart {
    std::uint64_t run = 0, number = 0;
};

template <typename T>
void put(std::string& out, const T* from, std::size_t count) {
    out.append(reinterpret_cast<const char*>(from), count * sizeof(T));
}

Run kind_of(float value, float saturated) {
    return value == saturated ? Run::above : value == -saturated ? Run::below : Run::numbers;
}

void encode_row(const float* row, std::size_t size, float saturated, std::vector<std::uint32_t>& runs,
                std::vector<float>& numbers) {
    for (std::size_t i = 0; i < size;) {
        const Run kind = kind_of(row[i], saturated);
        std::size_t end = i + 1;
        while (end < size && kind_of(row[end], saturated) == kind)
            ++end;
        if (kind == Run::numbers)
            numbers.insert(numbers.end(), row + i, row + end);
        runs.push_back(static_cast<std::uint32_t>(kind) << count_bits | static_cast<std::uint32_t>(end - i));
        i = end;
    }
}

/// Fills `out` from runs; false when they do not give just its size.
bool decode_slab(const std::uint32_t* runs, std::size_t run_count, const char* numbers,
                 std::size_t number_count, float saturated, float* out, std::size_t size) {
    for (std::size_t r = 0; r < run_count; ++r) {
        const std::size_t count = runs[r] & ((1u << count_bits) - 1u);
        const std::uint32_t kind = runs[r] >> count_bits;
        if (count > size || kind > static_cast<std::uint32_t>(Run::numbers))
            return false;
        if (kind == static_cast<std::uint32_t>(Run::numbers)) {
            if (count > number_count)
                return false;
            std::memcpy(out, numbers, count * sizeof(float));
            numbers += count * sizeof(float);
            number_count -= count;
        } else {
            std::fill(out, out + count,
                      kind == static_cast<std::uint32_t>(Run::above) ? saturated : -saturated);
        }
        out += count;
        size -= count;
    }
    return size == 0 && number_count == 0;
}

} // namespace

std::string grid_key(const TriMesh& mesh, const DistanceGridOptions& options) {
    ContentHash hash;
    hash.add_number(version);
    hash.add_number(options.spacing);
    hash.add_number(options.saturation);
    hash.add_number(std::uint64_t{options.max_nodes});
    hash.add_number(std::uint64_t{mesh.positions.size()});
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Tri) == 3 * sizeof(int));
    hash.add_bytes(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
    hash.add_bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof(Tri));
    return hash.hex();
}

std::string encode_grid(const DistanceGrid& grid) {
    Header header;
    header.version = version;
    header.nodes = {grid.nodes()[0], grid.nodes()[1], grid.nodes()[2]};
    header.spacing = grid.spacing();
    header.saturation = grid.saturation();
    header.low = {grid.low().x(), grid.low().y(), grid.low().z()};
    header.correction_max = grid.correction_max();
    header.correction_mean = grid.correction_mean();
    std::vector<SlabStart> starts;
    std::vector<std::uint32_t> runs;
    std::vector<float> numbers;
    const auto saturated = static_cast<float>(grid.saturation());
    for (int k = 0; k < grid.nodes()[2]; ++k) {
        starts.push_back({runs.size(), numbers.size()});
        for (int j = 0; j < grid.nodes()[1]; ++j)
            encode_row(grid.data() + static_cast<std::size_t>(j) * grid.step_y() +
                           static_cast<std::size_t>(k) * grid.step_z(),
                       grid.step_y(), saturated, runs, numbers);
    }
    starts.push_back({runs.size(), numbers.size()});
    std::string bytes;
    bytes.reserve(sizeof header + starts.size() * sizeof(SlabStart) + 4 * (runs.size() + numbers.size()));
    put(bytes, &header, 1);
    put(bytes, starts.data(), starts.size());
    put(bytes, runs.data(), runs.size());
    put(bytes, numbers.data(), numbers.size());
    return bytes;
}

std::optional<DistanceGrid> decode_grid(std::string_view bytes, std::size_t max_nodes, int threads) {
    Header header;
    if (bytes.size() < sizeof header)
        return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    bytes.remove_prefix(sizeof header);
    const Vec3 low(header.low[0], header.low[1], header.low[2]);
    if (header.version != version || !low.allFinite() || !(header.spacing > 0.0) ||
        !(header.saturation > 0.0))
        return std::nullopt;
    // Nodes along all axes or, without a surface, along none: rows of no nodes could be two billion, in a few bytes.
    const auto none = std::count(header.nodes.begin(), header.nodes.end(), 0);
    if (none != 0 && none != 3)
        return std::nullopt;
    std::size_t count = 1;
    for (const std::int32_t n : header.nodes) {
        if (n < 0 || (n > 0 && count > max_nodes / static_cast<std::size_t>(n)))
            return std::nullopt;
        count *= static_cast<std::size_t>(n);
    }
    const auto slabs = static_cast<std::size_t>(header.nodes[2]);
    if (bytes.size() / sizeof(SlabStart) < slabs + 1)
        return std::nullopt;
    std::vector<SlabStart> starts(slabs + 1);
    std::memcpy(starts.data(), bytes.data(), starts.size() * sizeof(SlabStart));
    bytes.remove_prefix(starts.size() * sizeof(SlabStart));
    for (std::size_t k = 0; k < slabs; ++k)
        if (starts[k].run > starts[k + 1].run || starts[k].number > starts[k + 1].number)
            return std::nullopt;
    const std::size_t words = bytes.size() / 4;
    if (bytes.size() % 4 != 0 || starts[0].run != 0 || starts[0].number != 0 || starts.back().run > words ||
        starts.back().number != words - starts.back().run)
        return std::nullopt;

    DistanceGrid grid;
    grid.spacing_ = header.spacing;
    grid.per_spacing_ = 1.0 / header.spacing;
    grid.saturation_ = header.saturation;
    grid.low_ = low;
    grid.nodes_ = {header.nodes[0], header.nodes[1], header.nodes[2]};
    grid.step_y_ = static_cast<std::size_t>(header.nodes[0]);
    grid.step_z_ = grid.step_y_ * static_cast<std::size_t>(header.nodes[1]);
    grid.correction_max_ = header.correction_max;
    grid.correction_mean_ = header.correction_mean;
    grid.values_.resize(count);
    std::vector<std::uint32_t> runs(starts.back().run);
    if (!runs.empty())
        std::memcpy(runs.data(), bytes.data(), runs.size() * sizeof(std::uint32_t));
    const char* numbers = bytes.data() + runs.size() * sizeof(std::uint32_t);
    std::atomic<bool> sound = true;
    parallel_for(threads, slabs, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            if (!decode_slab(runs.data() + starts[k].run, starts[k + 1].run - starts[k].run,
                             numbers + starts[k].number * sizeof(float),
                             starts[k + 1].number - starts[k].number, static_cast<float>(header.saturation),
                             grid.values_.data() + k * grid.step_z_, grid.step_z_))
                sound = false;
    });
    if (!sound)
        return std::nullopt;
    return grid;
}

} // namespace fascicle
