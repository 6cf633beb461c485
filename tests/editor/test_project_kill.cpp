// Kills a program that edits and saves (this one, started again as its own helper) and looks at what is left.
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "fascicle/document/actions/scene_actions.hpp"
#include "fascicle/io/autosave.hpp"
#include "fascicle/io/project_file.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace fascicle;
using namespace fascicle::test;
namespace fs = std::filesystem;

namespace {

constexpr double step_seconds = 7; ///< of the helper's own clock, between two edits
constexpr const char* helper_test = "Kill helper: edits and saves until it is killed";

/// What the helper tells after each step, in one write: the number of edits, and of those the one saved last.
struct Report {
    int edits = 0, saved = 0;
};

/// Edits are numbered in the name of a bone.
int number_of(const Scene& scene) {
    return std::atoi(scene.bones[0].name.c_str() + 1);
}

struct Helper {
    pid_t pid = -1;
    int reports = -1; ///< to read from
};

Helper start_helper(const fs::path& folder) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t pid = ::fork();
    REQUIRE(pid >= 0);
    if (pid == 0) { // between fork and exec nothing but system calls
        ::setenv("FASCICLE_KILL_FOLDER", folder.c_str(), 1);
        ::dup2(ends[1], 9);
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, 1);
        ::dup2(nowhere, 2);
        ::execl("/proc/self/exe", "tests", helper_test, static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ::close(ends[1]);
    return {pid, ends[0]};
}

/// All that was told before the end; `first`: only the first report.
Report read_reports(int file, bool first) {
    Report last, next;
    while (::read(file, &next, sizeof next) == static_cast<ssize_t>(sizeof next)) {
        last = next;
        if (first)
            break;
    }
    return last;
}

} // namespace

TEST_CASE("Kill helper: edits and saves until it is killed", "[.]") {
    const char* folder = std::getenv("FASCICLE_KILL_FOLDER");
    REQUIRE(folder != nullptr);
    Scene scene = small_scene();
    scene.bones[0].name = "b0";
    Driver d(std::move(scene), 1280, 800, 1, true, fs::path(folder) / "user");
    d.document().mark_saved(fs::path(folder) / "work.fascicle", nullptr);
    Report report;
    for (;;) {
        ++report.edits;
        actions::rename_bone(d.document(), 0, "b" + std::to_string(report.edits));
        if (report.edits % 13 == 0)
            d.editor().run(editor::Command::save_project);
        d.wait(step_seconds);
        // The clock is the helper's own: time stands still while a thread writes, so that the check needs no patience.
        d.editor().features().autosave.finish();
        if (report.edits % 13 == 0) {
            d.editor().features().project.finish();
            d.wait(0.001);
            report.saved = report.edits;
        }
        if (::write(9, &report, sizeof report) < 0)
            return;
    }
}

TEST_CASE("Killed at 50 random moments the saved file is whole and at most a minute is lost",
          "[editor][autosave]") {
    std::mt19937 random(20260101);
    int kills_with_file = 0, kills_with_copies = 0;
    for (int round = 0; round < 50; ++round) {
        const TempDir dir;
        const Helper helper = start_helper(dir.path());
        Report report = read_reports(helper.reports, true); // it works
        REQUIRE(report.edits >= 1);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 90000));
        ::kill(helper.pid, SIGKILL);
        int status = 0;
        REQUIRE(::waitpid(helper.pid, &status, 0) == helper.pid);
        REQUIRE(WIFSIGNALED(status));
        if (const Report more = read_reports(helper.reports, false); more.edits > 0)
            report = more;
        ::close(helper.reports);

        INFO("round " << round << ", " << report.edits << " edits, " << report.saved << " saved");
        int newest = 0;
        const fs::path file = dir.path() / "work.fascicle";
        if (fs::exists(file)) {
            const int saved = number_of(read_project_file(file).scene); // whole, or this throws
            CHECK(saved % 13 == 0);
            CHECK(saved >= report.saved); // told to be saved is saved
            newest = saved;
            ++kills_with_file;
        } else {
            CHECK(report.saved == 0);
        }
        for (const AutosaveSession& session : crashed_sessions(dir.path() / "user")) {
            newest = std::max(newest, number_of(read_project_file(session.file).scene));
            ++kills_with_copies;
        }
        // The first edit that is nowhere was made at most a minute, and the step in which the copy was due, before the end.
        CHECK((report.edits - newest - 1) * step_seconds <= 60 + step_seconds);
    }
    CHECK(kills_with_file > 5);
    CHECK(kills_with_copies > 5);
}
