#include "reproduce/published.hpp"

#include <limits>
#include <map>

namespace fascicle::reproduce {

namespace {
const double none = std::numeric_limits<double>::quiet_NaN();
}

const std::vector<PublishedFrame>& published_marks(const std::string& key) {
    static const std::map<std::string, std::vector<PublishedFrame>> rows{
        {"gluteus_maximus",
         {{50, .9959, 1.045, 1.46, 2.7, 15.9},
          {100, .9888, 1.105, 2.03, 4.3, 29.0},
          {200, 1.0003, 1.005, 1.09, 1.9, 2.3},
          {300, 1.0001, 1.003, 1.04, 1.2, 0.6}}},
        {"gluteus_maximus_fibres",
         {{50, .9979, 1.037, 1.46, 2.4, 13.7},
          {100, .9922, 1.095, 1.98, 3.7, 28.8},
          {200, 1.0001, 1.007, 1.27, 1.9, 4.5},
          {300, 1.0000, 1.004, 1.12, 1.4, 1.1}}},
        {"gluteus_medius",
         {{50, .9991, 1.029, 1.31, 2.4, 5.3},
          {100, .9968, 1.065, 1.65, 3.5, 9.6},
          {200, 1.0001, 1.020, 1.27, 2.4, 1.5},
          {300, .9998, 1.017, 1.19, 2.0, 0.8}}},
        {"iliacus",
         {{50, .9975, 1.019, 1.29, 2.8, 3.4},
          {100, .9956, 1.129, 4.32, 5.2, 6.9},
          {200, 1.0052, 1.190, 8.85, 3.8, 1.4},
          {300, 1.0047, 1.189, 9.10, 4.0, 1.4}}},
        {"adductor_brevis",
         {{50, .9957, 1.047, 1.84, 10.7, 13.5},
          {100, .9918, 1.077, 2.33, 12.7, 33.1},
          {200, .9999, 1.085, 2.69, 12.8, 5.1},
          {300, 1.0003, 1.011, 1.23, 9.4, 2.3}}},
        {"box",
         {{50, .9890, 1.011, 1.27, 13.1, none},
          {100, .3240, 1.205, 2.57, 22.8, none},
          {200, 1.0016, .997, 1.18, 5.5, 8.7},
          {300, .9999, .996, 1.09, 2.7, 13.3}}},
    };
    static const std::vector<PublishedFrame> nothing;
    const auto it = rows.find(key);
    return it == rows.end() ? nothing : it->second;
}

const std::vector<PublishedSpeed>& published_speeds() {
    static const std::vector<PublishedSpeed> rows{{"gluteus maximus", 19752, 33.85, 52},
                                                  {"adductor brevis", 17124, 35.89, 56},
                                                  {"iliacus", 13858, 47.21, 74},
                                                  {"gluteus medius", 10622, 57.12, 84},
                                                  {"box", 5292, 153.61, 219}};
    return rows;
}

const std::vector<BandPoint>& arm_band(const std::string& muscle) {
    // The sources give extension arms of gluteus maximus; flexion arms are their negatives.
    static const std::map<std::string, std::vector<BandPoint>> rows{
        {"iliacus", {{0, 20.1, 31.5}, {20, 19.1, 34.5}, {40, 22.4, 43.0}, {57, 26.2, 50.2}}},
        {"gluteus_maximus", {{0, -66.2, -9.4}, {20, -71.2, -16.5}, {40, -71.6, -17.3}, {57, -68.9, -14.8}}},
        {"gluteus_medius", {{0, -8.3, 14.4}, {20, -15.5, 16.7}, {40, -19.8, 14.6}, {57, -21.3, 10.5}}},
    };
    static const std::vector<BandPoint> nothing;
    const auto it = rows.find(muscle);
    return it == rows.end() ? nothing : it->second;
}

const std::vector<PublishedArm>& published_arms() {
    using M = MotionKind;
    static const std::vector<PublishedArm> rows{
        {M::flexion, "iliacus", "100 fibres", 13, 46, 30},
        {M::flexion, "iliacus", "lines", 26, 33, 31},
        {M::flexion, "iliacus", "Blemker & Delp 2005", 19, 51, 30},
        {M::flexion, "gluteus_maximus", "100 fibres", -92, -19, -57},
        {M::flexion, "gluteus_maximus", "lines", -77, -29, -55},
        {M::flexion, "gluteus_maximus", "Blemker & Delp 2005", -72, -9, -42},
        {M::flexion, "gluteus_medius", "100 fibres", -35, 15, -15},
        {M::flexion, "gluteus_medius", "lines", -19, 4, -13},
        {M::flexion, "gluteus_medius", "Blemker & Delp 2005", -17, 21, 0},
        {M::adduction, "iliacus", "100 fibres", -10, 16, 2},
        {M::adduction, "iliacus", "lines", -6, 3, -2},
        {M::adduction, "iliacus", "Blemker & Delp 2005", -15, 15, 0},
        {M::adduction, "gluteus_maximus", "100 fibres", -68, 54, -6},
        {M::adduction, "gluteus_maximus", "lines", -35, 64, 8},
        {M::adduction, "gluteus_maximus", "Blemker & Delp 2005", -61, 71, 8},
        {M::adduction, "gluteus_medius", "100 fibres", -75, -4, -51},
        {M::adduction, "gluteus_medius", "lines", -59, -16, -45},
        {M::adduction, "gluteus_medius", "Blemker & Delp 2005", -54, 6, -31},
        {M::rotation, "iliacus", "100 fibres", -2, 9, 3},
        {M::rotation, "iliacus", "lines", 1, 2, 2},
        {M::rotation, "iliacus", "Blemker & Delp 2005", -1, 9, 5},
        {M::rotation, "gluteus_maximus", "100 fibres", -39, 0, -23},
        {M::rotation, "gluteus_maximus", "lines", -41, 1, -28},
        {M::rotation, "gluteus_maximus", "Blemker & Delp 2005", -42, -1, -22},
        {M::rotation, "gluteus_medius", "100 fibres", -35, 31, -4},
        {M::rotation, "gluteus_medius", "lines", -30, 17, -11},
        {M::rotation, "gluteus_medius", "Blemker & Delp 2005", -27, 22, -4},
    };
    return rows;
}

const std::vector<MeasuredArms>& measured_arms() {
    static const std::vector<MeasuredArms> rows{
        {"gluteus_maximus",
         "N\xC3\xA9meth & Ohls\xC3\xA9n 1985",
         {0, 15, 30, 45, 60, 75, 90},
         {-76.8, -71.8, -66.3, -59.5, -51.1, -41.5, -31.2}},
    };
    return rows;
}

const std::vector<PublishedRatio>& published_ratios() {
    static const std::vector<PublishedRatio> rows{
        {"gluteus_maximus", 20, 1.10, 1.06, 1.13},
        {"gluteus_maximus", 40, 1.19, 1.11, 1.24},
        {"gluteus_maximus", 58, 1.26, 1.15, 1.31},
        {"gluteus_medius", 20, 1.04, .96, 1.08},
        {"gluteus_medius", 40, 1.08, .92, 1.17},
        {"gluteus_medius", 58, 1.12, .91, 1.26},
        {"iliacus", 20, .94, .90, .96},
        {"iliacus", 40, .87, .81, .93},
        {"iliacus", 58, .83, .74, .90},
    };
    return rows;
}

const PublishedRest* published_rest(const std::string& muscle) {
    static const PublishedRest rows[] = {
        {"gluteus_maximus", 220, 23}, {"gluteus_medius", 132, 17}, {"iliacus", 182, 24}};
    for (const PublishedRest& row : rows)
        if (muscle == row.muscle)
            return &row;
    return nullptr;
}

} // namespace fascicle::reproduce
