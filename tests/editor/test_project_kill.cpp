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

constexpr int edits_between_saves = 7;
constexpr double interval = 20;    ///< of the copies: a third of the real one, for short rounds
constexpr double step_seconds = 7; ///< of the helper's own clock, between two edits
constexpr const char* helper_test = "Kill helper: edits and saves until it is killed";

/// What the helper tells after each step, in one write: the number of edits, and of those the one saved last.
struct Report {
    int edits = 0, saved = 0;
    pid_t pid = 0; ///< of the round
};

/// Edits are numbered in the name of a bone.
int number_of(const Scene& scene) {
    return std::atoi(scene.bones[0].name.c_str() + 1);
}

/// The helper makes an editor once and forks it for every round: making one takes longer than many rounds.
struct Helper {
    pid_t pid = -1;
    int orders = -1;  ///< a byte written: start a round
    int reports = -1; ///< to read from
};

Helper start_helper(const fs::path& folder) {
    int orders[2], reports[2];
    REQUIRE(::pipe(orders) == 0);
    REQUIRE(::pipe(reports) == 0);
    const pid_t pid = ::fork();
    REQUIRE(pid >= 0);
    if (pid == 0) { // between fork and exec nothing but system calls
        ::setenv("FASCICLE_KILL_FOLDER", folder.c_str(), 1);
        ::dup2(orders[0], 8);
        ::dup2(reports[1], 9);
        for (const int end : {orders[0], orders[1], reports[0], reports[1]})
            if (end != 8 && end != 9)
                ::close(end);
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, 1);
        ::dup2(nowhere, 2);
        ::execl("/proc/self/exe", "tests", helper_test, static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ::close(orders[0]);
    ::close(reports[1]);
    return {pid, orders[1], reports[0]};
}

/// Edits and saves until it is killed.
void work(Driver& d) {
    Report report;
    report.pid = ::getpid();
    for (;;) {
        ++report.edits;
        actions::rename_bone(d.document(), 0, "b" + std::to_string(report.edits));
        if (report.edits % edits_between_saves == 0)
            d.editor().run(editor::Command::save_project);
        d.wait(step_seconds);
        // The clock is the helper's own: time stands still while a thread writes, so that the check needs no patience.
        d.editor().features().autosave.finish();
        if (report.edits % edits_between_saves == 0) {
            d.editor().features().project.finish();
            d.wait(0.001);
            report.saved = report.edits;
        }
        if (::write(9, &report, sizeof report) < 0)
            return;
    }
}

bool read_report(int file, Report& report) {
    return ::read(file, &report, sizeof report) == static_cast<ssize_t>(sizeof report);
}

} // namespace

TEST_CASE("Kill helper: edits and saves until it is killed", "[.]") {
    const char* folder = std::getenv("FASCICLE_KILL_FOLDER");
    REQUIRE(folder != nullptr);
    Scene scene = small_scene();
    scene.bones[0].name = "b0";
    Driver d(std::move(scene), 1280, 800, 1, true, fs::path(folder) / "user");
    CHECK(d.editor().features().autosave.interval == 60);
    d.editor().features().autosave.interval = interval;
    d.document().mark_saved(fs::path(folder) / "work.fascicle", nullptr);
    char order = 0;
    while (::read(8, &order, 1) == 1) {
        const pid_t round = ::fork();
        if (round == 0)
            work(d);
        if (round <= 0)
            ::_exit(1);
        int status = 0;
        ::waitpid(round, &status, 0);
        const Report end{-1, 0, 0}; // nothing of this round comes after it
        if (::write(9, &end, sizeof end) < 0)
            break;
    }
}

TEST_CASE("Killed at 50 random moments the saved file is whole and at most the interval of copies is lost",
          "[editor][autosave]") {
    const TempDir dir;
    const fs::path file = dir.path() / "work.fascicle", user = dir.path() / "user";
    const Helper helper = start_helper(dir.path());
    std::mt19937 random(20260101);
    int kills_with_file = 0, kills_with_copies = 0;
    for (int round = 0; round < 50; ++round) {
        fs::remove_all(user);
        fs::remove(file);
        REQUIRE(::write(helper.orders, "g", 1) == 1);
        Report report, next;
        REQUIRE(read_report(helper.reports, report)); // it works
        // Some edits on, and then anywhere in the next one.
        for (auto more = random() % 16; more > 0; --more)
            REQUIRE(read_report(helper.reports, report));
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
        REQUIRE(::kill(report.pid, SIGKILL) == 0);
        while (read_report(helper.reports, next) && next.edits >= 0)
            report = next;
        INFO("round " << round << ", " << report.edits << " edits, " << report.saved << " saved");
        int newest = 0;
        if (fs::exists(file)) {
            const int saved = number_of(read_project_file(file).scene); // whole, or this throws
            CHECK(saved % edits_between_saves == 0);
            CHECK(saved >= report.saved); // told to be saved is saved
            newest = saved;
            ++kills_with_file;
        } else {
            CHECK(report.saved == 0);
        }
        for (const AutosaveSession& session : crashed_sessions(user)) {
            newest = std::max(newest, number_of(read_project_file(session.file).scene));
            ++kills_with_copies;
        }
        // The first edit that is nowhere was made at most the interval, and the step in which the copy was due, before the end.
        CHECK((report.edits - newest - 1) * step_seconds <= interval + step_seconds);
    }
    ::close(helper.orders);
    int status = 0;
    ::waitpid(helper.pid, &status, 0);
    ::close(helper.reports);
    CHECK(kills_with_file > 5);
    CHECK(kills_with_copies > 5);
}
