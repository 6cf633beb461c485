#include "fascicle/geometry/axis_mapping.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle {

const std::vector<AxisMappingRow>& axis_mappings() {
    static const std::vector<AxisMappingRow> rows{
        {AxisMapping::as_is, "as_is", "As in the file", "The axes are those of the scene already."},
        {AxisMapping::ras_to_lps, "ras_to_lps", "RAS to LPS", "x and y change sign: half a turn about z."},
        {AxisMapping::opensim_to_lps, "opensim_to_lps", "OpenSim to LPS",
         "From Y up: x = -Z, y = -X, z = Y."},
        {AxisMapping::lps_to_opensim, "lps_to_opensim", "LPS to OpenSim", "To Y up: X = -y, Y = z, Z = -x."},
        {AxisMapping::y_up_to_lps, "y_up_to_lps", "Y up (glTF) to LPS",
         "A quarter turn about x: x = X, y = -Z, z = Y."},
        {AxisMapping::lps_to_y_up, "lps_to_y_up", "LPS to Y up (glTF)",
         "A quarter turn about x: X = x, Y = z, Z = -y."},
    };
    return rows;
}

Mat3 axis_matrix(AxisMapping mapping) {
    Mat3 m = Mat3::Identity();
    switch (mapping) {
    case AxisMapping::as_is:
        break;
    case AxisMapping::ras_to_lps:
        m << -1, 0, 0, 0, -1, 0, 0, 0, 1;
        break;
    case AxisMapping::opensim_to_lps:
        m << 0, 0, -1, -1, 0, 0, 0, 1, 0;
        break;
    case AxisMapping::lps_to_opensim:
        m << 0, -1, 0, 0, 0, 1, -1, 0, 0;
        break;
    case AxisMapping::y_up_to_lps:
        m << 1, 0, 0, 0, 0, -1, 0, 1, 0;
        break;
    case AxisMapping::lps_to_y_up:
        m << 1, 0, 0, 0, 0, 1, 0, -1, 0;
        break;
    }
    return m;
}

TriMesh mapped(TriMesh mesh, AxisMapping mapping, double scale) {
    FASCICLE_ASSERT(scale > 0);
    const Mat3 m = axis_matrix(mapping); // entries are 0 and +-1: the product is exact
    if (mapping != AxisMapping::as_is || scale != 1)
        for (Vec3& p : mesh.positions)
            p = scale * (m * p);
    return mesh;
}

} // namespace fascicle
