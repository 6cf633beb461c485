#pragma once
// What `fascicle reproduce` finds out, before it is written.

#include "reproduce/experiment.hpp"
#include "reproduce/run_data.hpp"

#include "fascicle/scene/recording.hpp"
#include "render/draw_list.hpp"
#include "reproduce/statistics.hpp"

#include <optional>
#include <set>

namespace fascicle::reproduce {

/// What a figure shows against the paper and the published program.
enum class Verdict { kept, better, worse, shown };
const char* to_text(Verdict verdict); ///< "kept", ...

/// A sentence made from the data.
struct Finding {
    std::string figure; ///< of the paper, e.g. "12"; empty: not in the paper
    std::string about;  ///< key of the quantity, e.g. "volume_ratio"
    Verdict verdict = Verdict::shown;
    std::string text;
};

struct Picture {
    std::string caption;
    render::Image image;
};

/// Distances between the surfaces of two runs on the same mesh at the end of flexion, both ways, mm.
struct SurfaceDistance {
    double mean = 0; ///< of a vertex to the other surface, over the vertices of both
    double max = 0;
};

/// One method in one experiment.
struct MethodRun {
    std::string method;
    RunData run;         ///< meaningless when there is a failure
    std::string failure; ///< why there is no run; empty: there is one
    bool reused = false;
    std::vector<Picture> pictures;       ///< at frames of the paper
    std::vector<Picture> fibre_pictures; ///< where there are fibres
    std::vector<Picture> line_pictures;  ///< of the program's own run, where there is a model of lines
    PointsPtr flexed;                    ///< surface at the end of the way out
    std::optional<SurfaceDistance> to_reference;
    bool done() const { return failure.empty(); }
};

/// Moment arms against the range of a published model over the same motion.
struct TableShare {
    std::string model;
    Span3 arm_mm;             ///< the published range
    double poses_percent = 0; ///< of poses with the mean arm inside
    double arms_percent = 0;  ///< of poses and fibres; of poses for a line
};

/// A method's moment arms against published bands.
struct ArmShare {
    std::string who;                  ///< a method, or a line muscle
    double inside_percent = 0;        ///< of poses with the mean arm inside; NaN: no band
    double fibres_inside_percent = 0; ///< of poses and fibres; NaN for a line
    Span3 arm_mm;                     ///< of the mean over the fibres, over the poses
    Span3 all_mm;                     ///< over poses and fibres, as the published ranges are
    std::vector<TableShare> table;    ///< real data alone
};

struct ExperimentResult {
    const Experiment* experiment = nullptr;
    bool real = false;
    std::string missing; ///< why it was left out; empty: it was run
    std::vector<std::string> notes;
    std::vector<MethodRun> runs;
    std::string reference; ///< method that surfaces are measured against; empty: none
    std::vector<ArmShare> arms;
    std::vector<Finding> findings;

    /// The run of a method that is done, or null.
    const MethodRun* run_of(const std::string& method) const;
};

/// How far a number moves when triangles or passes are halved or doubled, and how much a parameter does there.
struct SensitivityVariant {
    std::string key; ///< "as given", "half the triangles", ...
    std::size_t triangles = 0;
    int passes = 0;
    std::vector<double> values; ///< one per SensitivityResult::quantities, at the end of flexion
    std::size_t base = 0;       ///< place of the variant that this one is held against
    /// By parameter: change of every quantity when the parameter is lowered by a fifth.
    std::vector<std::vector<double>> effects;
    std::string failure;
};
struct SensitivityResult {
    std::string experiment, method;
    bool real = false;
    std::vector<std::string> quantities;      ///< with unit
    std::vector<std::string> parameters;      ///< keys
    std::vector<SensitivityVariant> variants; ///< the first is as given
    struct Dependence {
        std::string parameter, quantity, variant;
        double effect = 0, effect_at_base = 0;
    };
    std::vector<Dependence> dependences;
    std::string missing; ///< why it was not made
};

/// Times: never part of the numbers.
struct SpeedRow {
    std::string object, method;
    bool real = false;
    std::size_t triangles = 0;
    int threads = 1, passes = 0;
    double frames_per_second = 0;
};
struct SpeedResult {
    std::vector<SpeedRow> rows;
    std::vector<std::string> failures; ///< object, method and reason of runs that leave no row
    /// By method and threads: rank correlation of frames a second with triangles, over the rows.
    struct Correlation {
        std::string method;
        int threads = 1;
        std::size_t objects = 0;
        double rho = 0;
    };
    std::vector<Correlation> correlations;
};

struct Results {
    std::string data; ///< where the real data was looked for, for people
    bool is_short = false;
    std::vector<std::string> methods;
    std::vector<ExperimentResult> experiments;
    SensitivityResult sensitivity;
    SpeedResult speed;
    std::set<std::filesystem::path> inputs;
    double seconds = 0; ///< that all of it took
};

} // namespace fascicle::reproduce
