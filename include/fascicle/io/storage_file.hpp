#pragma once
// Tables over time as OpenSim and SIMM write them (.mot, .sto).

#include "fascicle/motion/skeleton.hpp"

#include <filesystem>
#include <string_view>

namespace fascicle {

/// rows x columns numbers as they stand in the file; nan where it says so.
struct StorageTable {
    std::string file;        ///< for messages
    std::string name;        ///< first line of the header
    bool in_degrees = false; ///< angles are in degrees
    std::vector<std::string> columns;
    std::vector<double> values;     ///< row after row
    std::vector<std::size_t> lines; ///< of the file, from 1, one per row
    std::vector<std::string> notes; ///< what the header has wrong, a sentence each

    std::size_t row_count() const { return lines.size(); }
    double value(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
    /// Index, or -1.
    int column_index(const std::string& wanted) const;
};

/// A header up to a line `endheader`, in any case; then column names, then rows. Names and numbers stand between tabs or
/// blanks, any number of them; a line of names that has tabs is cut at tabs alone, so names may have blanks there. Of the
/// header only the name and the unit of angles count: `inDegrees=yes` or `no`; without it, degrees where the header says
/// "Angles are in degrees" or is SIMM's (`datacolumns`), else radians. nRows, nColumns, datarows, datacolumns may be absent
/// or wrong (a note). Without `endheader` the first line that starts with the word "time" holds the names. Empty lines are
/// passed over; of several columns of one name the first one counts (a note). Error naming file and line: no names, a row of
/// another length, a word that is no number, no rows.
StorageTable read_storage(std::string_view bytes, const std::string& file);
StorageTable read_storage_file(const std::filesystem::path& path);

/// Which column holds which coordinate, by name; "/jointset/hip_r/hip_flexion_r/value", as states are named, too.
struct CoordinateColumns {
    std::vector<int> column_of;     ///< per coordinate: a column, or -1
    std::vector<std::string> notes; ///< what the table does not tell, or tells for nobody
};

/// Error naming the file: no column is a coordinate, or two are the same one.
CoordinateColumns match_coordinates(const StorageTable& table, const Skeleton& skeleton);

/// Values of all coordinates in a row: radians, metres; defaults where the table has none. Couplers are not applied.
/// values: resized. Error naming file and line: not a finite number.
void coordinate_values(const StorageTable& table, const CoordinateColumns& columns, std::size_t row,
                       const Skeleton& skeleton, std::vector<double>& values);

} // namespace fascicle
