#include "bench/bench.hpp"

#include "bench/bench_cases.hpp"
#include "bench/bullet_body.hpp"
#include "bench/fibre_bench.hpp"
#include "bench/frame_bench.hpp"
#include "bench/machine_limits.hpp"
#include "bench/paint_bench.hpp"
#include "bench/prepare_bench.hpp"
#include "bench/scaling_bench.hpp"
#include "fascicle/io/disk_cache.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle::bench {

namespace {

bool wanted(const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

class Bench {
public:
    Bench(const BenchOptions& options, const JobControl& control) : options_(options), control_(control) {
        settings_.runs = options.runs;
        settings_.frames = options.frames;
    }

    Report run() {
        report_.machine = this_machine(); // first: the load before the bench makes its own
        report_.runs = options_.runs;
        find_variants();
        find_cases();
        if (wanted(options_.parts, "frames"))
            for (const BenchCase& bench_case : cases_)
                measure_case(bench_case);
        if (wanted(options_.parts, "scaling"))
            measure_main("scaling", [this](const BenchCase& c) { measure_scaling_of(c); });
        if (wanted(options_.parts, "prepare"))
            measure_main("prepare", [this](const BenchCase& c) {
                const auto read = [&](int threads) { return load(c, threads); };
                report_.prepare =
                    measure_prepare(c.name, read, main_variant(), options_.threads, options_.runs, control_);
            });
        if (wanted(options_.parts, "fibres"))
            for (const BenchCase& bench_case : cases_)
                measure_fibres_of(bench_case);
        if (wanted(options_.parts, "paint"))
            report_.paint = measure_paint(options_.runs, options_.is_short, control_);
        if (wanted(options_.parts, "limits"))
            report_.limits = measure_limits(report_.machine, options_.threads, options_.runs,
                                            options_.is_short ? 0.001 : 1.0, control_);
        add_ratios(report_);
        add_warnings();
        return std::move(report_);
    }

private:
    void find_variants() {
        for (const Variant& variant : make_variants(parameter_table(), options_.threads))
            if (!wanted(options_.methods, variant.name))
                continue;
            else if (variant.name == "bullet" && !bullet_missing().empty())
                report_.skipped.push_back({"bullet", bullet_missing()});
            else
                variants_.push_back(variant);
        if (wanted(options_.methods, "fast") && !has_kernel(parameter_table(), "fast"))
            report_.skipped.push_back(
                {"fast", "this program has no parameter solver.kernel with choice fast"});
    }

    void find_cases() {
        for (BenchCase& bench_case : bench_cases(options_.data))
            if (!wanted(options_.cases, bench_case.name))
                continue;
            else if (!bench_case.missing.empty())
                report_.skipped.push_back({bench_case.name, bench_case.missing});
            else
                cases_.push_back(std::move(bench_case));
    }

    Scene load(const BenchCase& bench_case, int threads) const {
        SceneRequest request = bench_case.request;
        request.threads = threads;
        JobControl part;
        part.cancel = control_.cancel;
        Scene scene = load_scene(request, part).scene;
        if (options_.is_short) // fine grids take most of the time of everything
            scene.parameters.set("contact.grid_mm", parameter_table().find("contact.grid_mm")->maximum);
        return scene;
    }

    Scene load(const BenchCase& bench_case) const {
        control_.checkpoint(bench_case.name + ": read", 0.0);
        return load(bench_case, options_.threads.back());
    }

    /// The scene and its problems as the method sees them. Passes and kernel change nothing in a preparation.
    PreparedScene prepare(const Scene& scene, const std::string& method) const {
        Scene own = scene;
        set_method(own.parameters, method);
        JobControl part;
        part.cancel = control_.cancel;
        control_.checkpoint(scene.name + ": prepare", 0.0);
        return prepare_scene(own, options_.threads.back(), part, open_cache().get());
    }

    /// Cases whose muscles have attachments: without them there are no fibres.
    void measure_fibres_of(const BenchCase& bench_case) {
        const Scene scene = load(bench_case);
        const PreparedScene prepared = prepare(scene, "xpbd");
        for (const PreparedMuscle& muscle : prepared.muscles)
            if (muscle.attachments.size() < 2)
                return;
        for (LimitRow& row : measure_fibres(scene, prepared, options_.threads.back(), options_.runs,
                                            options_.is_short, control_)) {
            row.name = bench_case.name + ", " + row.name;
            report_.fibres.push_back(std::move(row));
        }
    }

    void measure_case(const BenchCase& bench_case) {
        const Scene scene = load(bench_case);
        CaseInfo info{
            bench_case.name,     static_cast<int>(scene.muscles.size()), 0, 0, frames_of(scene, settings_),
            bench_case.published};
        for (const Muscle& muscle : scene.muscles) {
            info.vertices += muscle.mesh->vertex_count();
            info.triangles += muscle.mesh->triangle_count();
        }
        report_.cases.push_back(info);
        std::map<std::string, PreparedScene> prepared;
        for (const Variant& variant : variants_) {
            const bool own = !variant.method.empty();
            const std::string method = own ? variant.method : "xpbd"; // a rival gets the same fixed vertices
            if (!prepared.contains(method))
                prepared[method] = prepare(scene, method);
            const PreparedScene& problem = prepared[method];
            const MakeBody make =
                own ? scene_body(scene, problem, variant)
                    : MakeBody([&problem, &variant] { return make_bullet_body(problem, variant.passes); });
            const std::string stage = bench_case.name + ": " + variant.name + ", " +
                                      std::to_string(variant.passes) + " passes, threads " +
                                      std::to_string(variant.threads);
            FrameRow row = time_frames(scene, make, variant, settings_, control_, stage);
            row.case_name = bench_case.name;
            report_.frames.push_back(std::move(row));
        }
    }

    /// The case of scaling and prepare: gluteus maximus, or the first that there is with a single muscle.
    template <typename Measure>
    void measure_main(const std::string& part, const Measure& measure) {
        const auto it =
            std::find_if(cases_.begin(), cases_.end(), [](const BenchCase& c) { return c.name != "hip"; });
        if (it == cases_.end()) {
            report_.skipped.push_back({part, "no case with a single muscle"});
            return;
        }
        report_.main_case = it->name;
        measure(*it);
    }

    /// Our best method with 3 substeps, 1 thread.
    Variant main_variant() const {
        const auto all = make_variants(parameter_table(), {1});
        const auto fast =
            std::find_if(all.begin(), all.end(), [](const Variant& v) { return v.name == "fast"; });
        return fast != all.end() ? *fast : all.at(1);
    }

    void measure_scaling_of(const BenchCase& bench_case) {
        std::vector<Variant> variants;
        for (const int threads : options_.threads) {
            variants.push_back(main_variant());
            variants.back().threads = threads;
        }
        const Scene scene = load(bench_case);
        report_.scaling = measure_scaling(scene, prepare(scene, "xpbd"), variants, options_.is_short ? 1 : 3,
                                          settings_, control_);
    }

    void add_warnings() {
        if (options_.is_short)
            report_.warnings.push_back("short form: it shows that the bench works, its figures mean nothing");
        if (report_.machine.busy()) {
            char text[120];
            std::snprintf(text, sizeof text,
                          "other programs were running (load %.2f before the bench): figures undecided",
                          report_.machine.load);
            report_.warnings.emplace_back(text);
        }
        if (report_.machine.build != "Release")
            report_.warnings.push_back("built as " + report_.machine.build + ", not as Release");
        add_spread_warning(report_);
    }

    const BenchOptions& options_;
    const JobControl& control_;
    RunSettings settings_;
    std::vector<Variant> variants_;
    std::vector<BenchCase> cases_;
    Report report_;
};

} // namespace

const std::vector<std::string>& part_names() {
    static const std::vector<std::string> names{"frames", "scaling", "prepare", "fibres", "paint", "limits"};
    return names;
}

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const BenchCase& bench_case : bench_cases(std::nullopt))
        names.push_back(bench_case.name);
    return names;
}

Report run_bench(const BenchOptions& options, const JobControl& control) {
    return Bench(options, control).run();
}

} // namespace fascicle::bench
