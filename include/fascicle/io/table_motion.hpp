#pragma once
// Motions of a scene's bones from tables over time (.mot, .sto): one column as the angle of a hinge, or all coordinates of a model.

#include "fascicle/io/storage_file.hpp"
#include "fascicle/scene/line_muscles.hpp"

namespace fascicle {

/// How rows become frames. Frame lead_in is the first row, and each frame after it frame_seconds later, linear between rows.
struct TableTiming {
    double frame_seconds = 0.02;
    /// Frames from rest (frame 0) to the first row. 0: the first row is rest itself, and values count from it.
    int lead_in = 0;
};

/// Number of frames after frame 0 that the table makes. Error naming the file: no time column, times that do not ascend, less than one
/// frame, more than 100,000.
int frame_count(const StorageTable& table, const TableTiming& timing);

/// Column as angles. factor: radians per number of the table, with its sign (pi / 180 for degrees). Error naming file and line for a value
/// that is not finite, or as frame_count().
std::vector<AngleKey> column_angles(const StorageTable& table, int column, double factor,
                                    const TableTiming& timing);

/// A model's coordinates move the bones. bone_of_body: one per body of the model, a name or empty, of bones of the scene. The bodies of the first bone
/// that no joint of the model moves against the scene, `fixed` (its index), stays; the others move as they do against that body:
///   pose = rest_fixed X(q) X(q_rest)^-1 rest_fixed^-1,  X: pose of the body in the fixed body,
/// q_rest: lines.rest_values, or the first row with lead_in 0. Of several bodies of one bone the first counts. Error
/// naming the file: no coordinate of the model, nothing that moves, half a turn or more in a frame, or as above.
Timeline model_timeline(const StorageTable& table, const LineMuscles& lines,
                        const std::vector<std::string>& bone_of_body, int fixed_body, const Scene& scene,
                        const TableTiming& timing, std::vector<std::string>& notes);

} // namespace fascicle
