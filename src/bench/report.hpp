#pragma once
// Everything that a bench found out, as plain values: the table and the JSON are two views of it.

#include "bench/machine.hpp"
#include "bench/spread.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fascicle::bench {

/// Frames/s of the published C++ program on gluteus maximus (19,752 triangles, 3 iterations, contact with both bones, one
/// thread of a 2.3 GHz server): measured on another machine, so a ratio to it is a rough guide; that to `classic` of
/// the same run is the fair one.
inline constexpr double published_frames_per_second = 52.6;

/// Least share of a processor that a single thread must have got.
inline constexpr double least_share = 0.95;

struct CaseInfo {
    std::string name;
    int muscles = 0;
    int vertices = 0;  ///< of all muscles
    int triangles = 0; ///< of all muscles
    int frames = 0;    ///< of one run
    bool published = false;
};

struct FrameRow {
    std::string case_name;
    std::string method; ///< name of the variant: classic, reference, fast, bullet
    int threads = 1;
    int passes = 0;                ///< substeps, inner loops or iterations a frame
    std::vector<double> run_rates; ///< frames/s of every run, in the order of the runs
    Spread rate;                   ///< frames/s
    double processor_share = 1;    ///< processor time of the program by time of the runs and threads
    std::optional<double> times_published;
    std::optional<double> times_classic;      ///< median against the median of classic on the same case
    double pass_us = 0;                       ///< microseconds a pass, of the median run
    std::map<std::string, double> stage_us;   ///< the same by stage, as far as the method tells
    std::optional<double> bytes_per_triangle; ///< of solver state
    std::string state_hash;                   ///< of the last frame's positions

    /// Runs far apart, or others took the processor away from a single thread: a steady second program slows all runs
    /// alike. Several threads may have reasons of their own to wait.
    bool undecided() const { return rate.undecided() || (threads == 1 && processor_share < least_share); }
};

struct ScalingRow {
    std::string method;
    int level = 0; ///< times subdivided
    int triangles = 0;
    int threads = 1;
    Spread ns; ///< nanoseconds per triangle and substep
    std::optional<double> bytes_per_triangle;
    std::optional<double> growth;  ///< against the smallest subdivided mesh with the same threads
    std::optional<double> speedup; ///< against one thread on the same mesh
};

struct PrepareRow {
    std::string case_name;
    int threads = 1;
    std::string cache;                           ///< "cold", "warm", or "none": nothing is kept on disk
    Spread seconds;                              ///< from reading files to solvers at rest
    std::map<std::string, double> stage_seconds; ///< medians
};

struct LimitRow {
    std::string name;
    std::string unit;
    int threads = 1;
    Spread value;
};

/// Something that was not measured.
struct Skip {
    std::string what;
    std::string reason;
};

struct Report {
    Machine machine;
    int runs = 0;
    std::string main_case; ///< the case of `scaling` and `prepare`, empty when they were not measured
    std::vector<CaseInfo> cases;
    std::vector<FrameRow> frames;
    std::vector<ScalingRow> scaling;
    std::vector<PrepareRow> prepare;
    std::vector<LimitRow> fibres; ///< milliseconds of making and carrying 100 fibres
    std::vector<LimitRow> paint;  ///< milliseconds of painting on a bone
    std::vector<LimitRow> limits;
    std::vector<Skip> skipped;
    std::vector<std::string> warnings;
};

/// Fills times_published and times_classic of every frame row, growth and speedup of every scaling row.
void add_ratios(Report& report);
/// One sentence when any figure of the report is undecided.
void add_spread_warning(Report& report);

} // namespace fascicle::bench
