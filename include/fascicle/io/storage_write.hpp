#pragma once
// Tables over time, written: as OpenSim reads them, and for spreadsheets.

#include "fascicle/io/storage_file.hpp"

#include <ostream>

namespace fascicle {

/// Name, version=1, nRows, nColumns, inDegrees, endheader, names of columns, rows; tabs between, the shortest numbers that read back
/// the same. read_storage gives the same table again. Error naming the table when a name of a column has a tab or line end.
void write_storage(std::ostream& out, const StorageTable& table);

/// The same as CSV: a header row of the names, then the rows. Angles stay in the table's unit, degrees or radians.
void write_storage_csv(std::ostream& out, const StorageTable& table);

} // namespace fascicle
