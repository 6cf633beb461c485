#include "editor/file_loader.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/dropped_file.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "fascicle/document/actions/import_actions.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/storage_file.hpp"

#include <atomic>
#include <chrono>
#include <future>

namespace fascicle::editor {

namespace fs = std::filesystem;

struct FileLoader::Job {
    std::string what;
    Work work;
    std::atomic<bool> stop{false};
    std::atomic<double> fraction{0};
    std::future<Apply> result;
    bool begun() const { return result.valid(); }
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

namespace {

void say(EditorContext& context, const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
        context.log.add(Severity::note, note);
}

bool same_bones(const Scene& a, const Scene& b) {
    return std::equal(a.bones.begin(), a.bones.end(), b.bones.begin(), b.bones.end(),
                      [](const Bone& x, const Bone& y) { return x.name == y.name && x.mesh == y.mesh; });
}

/// The muscle may have been renamed or removed while its file was read.
int muscle_with_mesh(EditorContext& context, const MeshPtr& mesh, const fs::path& path) {
    const std::vector<Muscle>& muscles = context.document.scene().muscles;
    for (std::size_t i = 0; i < muscles.size(); ++i)
        if (muscles[i].mesh == mesh)
            return static_cast<int>(i);
    context.log.add(Severity::warning, path.filename().string() + ": its muscle is no longer in the scene");
    return -1;
}

void put(EditorContext& context, FileKind kind, const fs::path& path) {
    FileLoader& loader = context.features.loader;
    switch (kind) {
    case FileKind::project:
        open_project(context, path);
        break;
    case FileKind::mesh:
        context.dialogs.mesh.open_with({path});
        break;
    case FileKind::outlines:
        loader.load_outlines(context, path);
        break;
    case FileKind::motion:
        loader.load_motion(context, path);
        break;
    case FileKind::storage:
        loader.load_table(context, path);
        break;
    case FileKind::model:
        loader.load_lines(context, path);
        break;
    case FileKind::fibre_template:
        loader.load_fibre_template(context, path);
        break;
    case FileKind::unknown:
        break;
    }
}

/// A muscle's part of a file: `read` fills a copy of the muscle on a thread, `apply` puts it into the document.
template <class Read, class Put>
void load_for_muscle(FileLoader& loader, EditorContext& context, const fs::path& path, const char* what,
                     Read read, Put put_into) {
    const int index = muscle_for_file(context, path);
    if (index < 0) {
        context.log.add(Severity::error, path.filename().string() + ": " + what +
                                             (context.document.scene().muscles.empty()
                                                  ? " need a muscle; the scene has none"
                                                  : " belong to a muscle; select it first"));
        return;
    }
    const Scene& scene = context.document.scene();
    auto muscle = std::make_shared<Muscle>(scene.muscles[static_cast<std::size_t>(index)]);
    const LengthUnit unit = scene.unit;
    loader.start(path.filename().string(), [=](const JobControl&) -> FileLoader::Apply {
        std::vector<std::string> notes;
        read(*muscle, unit, notes);
        return [=](EditorContext& c) {
            const int now = muscle_with_mesh(c, muscle->mesh, path);
            if (now < 0)
                return;
            put_into(c, now, *muscle);
            say(c, notes);
            const std::string name = c.document.scene().muscles[static_cast<std::size_t>(now)].name;
            c.log.add(Severity::note, path.filename().string() + ": " + what + " of " + name);
        };
    });
}

} // namespace

int muscle_for_file(const EditorContext& context, const fs::path& path) {
    const Scene& scene = context.document.scene();
    if (context.state.selection.kind == Selection::Kind::muscle)
        if (const int selected = scene.muscle_index(context.state.selection.name); selected >= 0)
            return selected;
    const std::string stem = path.stem().string();
    int best = -1;
    for (int i = 0; i < static_cast<int>(scene.muscles.size()); ++i) {
        const std::string& name = scene.muscles[static_cast<std::size_t>(i)].name;
        if (stem.compare(0, name.size(), name) == 0 &&
            (best < 0 || name.size() > scene.muscles[static_cast<std::size_t>(best)].name.size()))
            best = i;
    }
    return best >= 0 ? best : scene.muscles.size() == 1 ? 0 : -1;
}

FileLoader::FileLoader() = default;

FileLoader::~FileLoader() {
    cancel(); // the futures wait
}

void FileLoader::start(std::string what, Work work) {
    auto job = std::make_unique<Job>();
    job->what = std::move(what);
    job->work = std::move(work);
    jobs_.push_back(std::move(job));
    begin_next();
}

void FileLoader::begin_next() {
    if (jobs_.empty() || jobs_.front()->begun())
        return;
    Job* job = jobs_.front().get();
    job->result = std::async(std::launch::async, [job] {
        JobControl control;
        control.cancel = &job->stop;
        control.report = [job](std::string_view, double fraction) { job->fraction = fraction; };
        return job->work(control);
    });
}

const std::string& FileLoader::what() const {
    static const std::string nothing;
    return jobs_.empty() ? nothing : jobs_.front()->what;
}

double FileLoader::progress() const {
    return jobs_.empty() ? 0.0 : jobs_.front()->fraction.load();
}

void FileLoader::cancel() {
    if (!jobs_.empty() && jobs_.front()->begun()) {
        jobs_.front()->stop = true;
        given_up_.push_back(std::move(jobs_.front()));
    }
    jobs_.clear();
}

void FileLoader::finish() {
    if (!jobs_.empty() && jobs_.front()->begun())
        jobs_.front()->result.wait();
}

void FileLoader::update(EditorContext& context) {
    std::erase_if(given_up_, [](const std::unique_ptr<Job>& job) { return job->done(); });
    if (jobs_.empty() || !jobs_.front()->done() || context.document.has_uncommitted_edits())
        return; // not into the middle of a drag
    const std::unique_ptr<Job> job = std::move(jobs_.front());
    jobs_.pop_front();
    try {
        if (const Apply apply = job->result.get())
            apply(context); // may start more
    } catch (const Cancelled&) {
    } catch (const std::exception& problem) {
        context.log.add(Severity::error, problem.what());
    }
    begin_next();
}

void FileLoader::document_replaced(EditorContext&) {
    cancel();
}

std::optional<double> FileLoader::redraw_after() const {
    return jobs_.empty() && given_up_.empty() ? std::nullopt : std::optional<double>(1.0 / 25);
}

void FileLoader::drop(std::vector<fs::path> files) {
    if (files.empty())
        return;
    const std::string what =
        files.size() == 1 ? files.front().filename().string() : std::to_string(files.size()) + " files";
    start(what, [files = std::move(files)](const JobControl& control) -> Apply {
        std::vector<std::pair<fs::path, FileKind>> kinds;
        std::vector<std::string> unknown;
        for (const fs::path& file : files) {
            if (control.cancelled())
                throw Cancelled();
            std::string why;
            kinds.emplace_back(file, kind_of_file(file, why));
            if (!why.empty())
                unknown.push_back(why);
        }
        return [=](EditorContext& context) {
            for (const std::string& why : unknown)
                context.log.add(Severity::error, why);
            std::vector<fs::path> meshes;
            const fs::path* project = nullptr;
            for (const auto& [file, kind] : kinds) {
                if (kind == FileKind::mesh)
                    meshes.push_back(file);
                else if (kind == FileKind::project && project != nullptr)
                    context.log.add(Severity::warning, file.filename().string() +
                                                           ": only one project can be open; " +
                                                           project->filename().string() + " is opened");
                else
                    put(context, kind, file);
                if (kind == FileKind::project && project == nullptr)
                    project = &file;
            }
            context.dialogs.mesh.open_with(meshes);
        };
    });
}

void FileLoader::load_outlines(EditorContext& context, const fs::path& path) {
    load_for_muscle(
        *this, context, path, "attachment outlines",
        [path](Muscle& muscle, LengthUnit unit, std::vector<std::string>&) {
            fascicle::load_attachments(muscle, path, unit);
        },
        [](EditorContext& c, int index, const Muscle& muscle) {
            actions::set_outlines(c.document, index, muscle.outlines, muscle.outline_files.front());
            const Muscle& now = c.document.scene().muscles[static_cast<std::size_t>(index)];
            if (!now.attachments.empty() || has_painted_areas(now))
                c.log.add(Severity::warning,
                          now.name + ": attachments set otherwise stay in force before the outlines");
        });
}

void FileLoader::load_surface_fibres(EditorContext& context, const fs::path& path) {
    load_for_muscle(
        *this, context, path, "surface fibres",
        [path](Muscle& muscle, LengthUnit, std::vector<std::string>& notes) {
            fascicle::load_surface_fibres(muscle, path, notes);
        },
        [](EditorContext& c, int index, const Muscle& muscle) {
            actions::set_surface_fibres(c.document, index, muscle.surface_fibres,
                                        muscle.surface_fibres_source);
        });
}

void FileLoader::load_fibre_template(EditorContext& context, const fs::path& path) {
    load_for_muscle(
        *this, context, path, "the fibre template",
        [path](Muscle& muscle, LengthUnit, std::vector<std::string>&) {
            fascicle::load_fibre_template(muscle, path);
        },
        [](EditorContext& c, int index, const Muscle& muscle) {
            actions::set_fibre_template(c.document, index, muscle.fibre_template,
                                        muscle.fibre_template_source);
        });
}

void FileLoader::load_lines(EditorContext& context, const fs::path& path) {
    start(path.filename().string(), [path, head = context.document.head()](const JobControl&) -> Apply {
        Scene scene = *head;
        std::vector<std::string> notes;
        fascicle::load_line_muscles(scene, path, notes);
        return [=, lines = scene.line_muscles](EditorContext& c) {
            actions::set_line_muscles(c.document, lines);
            say(c, notes);
            c.log.add(Severity::note, path.filename().string() + ": line muscles loaded");
        };
    });
}

void FileLoader::load_motion(EditorContext& context, const fs::path& path) {
    start(path.filename().string(), [path, head = context.document.head()](const JobControl&) -> Apply {
        auto scene = std::make_shared<Scene>(*head);
        std::vector<std::string> notes;
        fascicle::load_motion(*scene, path, notes);
        return [=](EditorContext& c) {
            if (!same_bones(*scene, c.document.scene())) {
                c.log.add(Severity::error,
                          path.filename().string() + ": the bones have changed meanwhile; load it again");
                return;
            }
            actions::set_timeline(c.document, scene->timeline, scene->motion_source, "Load motion");
            say(c, notes);
        };
    });
}

void FileLoader::load_table(EditorContext&, const fs::path& path) {
    start(path.filename().string(), [path](const JobControl&) -> Apply {
        auto table = std::make_shared<const StorageTable>(read_storage_file(path));
        return [table](EditorContext& c) { c.features.motion.show_table(c, table); };
    });
}

} // namespace fascicle::editor
