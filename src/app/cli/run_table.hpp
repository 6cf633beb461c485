#pragma once
// The few numbers of a run that a person wants first, gathered while frames pass by.

#include "fascicle/scene/recording.hpp"

#include <iosfwd>

namespace fascicle::app {

class RunTable {
public:
    explicit RunTable(const Scene& scene);

    /// metrics: one list per muscle, in the order of metric_table(). The first frame is rest.
    void add(const Frame& frame, const std::vector<std::vector<double>>& metrics);

    /// A row per muscle: greatest departure of the volume ratio from 1 in %, rms distance of the last frame's vertices
    /// from rest in mm, most penetrating vertices of any frame; then the speed.
    void print(std::ostream& out, const Recording& recording) const;

private:
    struct Row {
        double volume_error = 0;
        double penetrating = 0;
    };
    const Scene& scene_;
    std::size_t volume_column_, penetrating_column_;
    std::vector<Row> rows_;
};

} // namespace fascicle::app
